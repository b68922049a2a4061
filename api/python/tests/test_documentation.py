"""What the docstrings show is what happens; the hints are true to mypy; the examples run."""

import doctest
import importlib
import inspect
import os
import pathlib
import pkgutil
import shutil
import subprocess
import sys
import unittest

from support import np, plumb

PACKAGE = pathlib.Path(plumb.__file__).parent
README = pathlib.Path(__file__).resolve().parents[3] / "README.md"
EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"
SHOWN = "impulse"  # the engine of the examples in docstrings
missing = SHOWN not in [name for name, _ in plumb.backends()]


def documented():
    names = ["plumb"] + [
        f"plumb.{found.name}" for found in pkgutil.iter_modules([str(PACKAGE)]) if found.name != "_core"
    ]
    return [importlib.import_module(name) for name in names]


class Documentation(unittest.TestCase):
    @unittest.skipIf(missing, f"the docstrings show {SHOWN}, which is not there")
    def test_docstrings(self):
        tried = 0
        for module in documented():
            if module is plumb.harness and not shutil.which(os.environ.get("PLUMB_PROGRAM", "")):
                try:
                    plumb.harness.program()
                except FileNotFoundError:
                    continue
            with self.subTest(module.__name__):
                failed, of = doctest.testmod(module, extraglobs={"np": np})
                self.assertEqual(failed, 0)
                tried += of
        self.assertGreater(tried, 40)

    def test_everything_public_is_documented(self):
        for name in plumb.__all__:
            thing = getattr(plumb, name)
            if isinstance(thing, type) or inspect.isroutine(thing):
                self.assertTrue((thing.__doc__ or "").strip(), name)
            for part, what in vars(thing).items() if isinstance(thing, type) else ():
                if inspect.isroutine(what) and not part.startswith("_"):
                    self.assertTrue((what.__doc__ or "").strip(), f"{name}.{part}")

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_hints(self):
        script = "import plumb\nworld = plumb.open('x').world(['rotation'])\nworld.read('pose').shape\n"
        script += "world.create_body(3)\n"
        checked = subprocess.run(
            ["mypy", "--strict", "--cache-dir", os.devnull, "-p", "plumb"],
            capture_output=True,
            text=True,
            cwd=PACKAGE.parent,
        )
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        wrong = subprocess.run(
            ["mypy", "--strict", "--cache-dir", os.devnull, "-c", script],
            capture_output=True,
            text=True,
            env={**os.environ, "MYPYPATH": str(PACKAGE.parent)},
        )
        self.assertIn('<string>:4: error: Argument 1 to "create_body"', wrong.stdout)
        self.assertEqual(wrong.stdout.count("error:"), 1, wrong.stdout)

    @unittest.skipUnless(README.is_file(), "the README is not beside the tests")
    def test_the_readme_shows_the_first_host_as_it_is(self):
        shown, host = README.read_text(), (EXAMPLES / "drop.py").read_text()
        if "```python" in shown:
            self.assertIn(host, shown)

    @unittest.skipIf(missing, f"the examples use {SHOWN}, which is not there")
    def test_examples(self):
        for script in sorted(EXAMPLES.glob("*.py")):
            with self.subTest(script.name):
                ran = subprocess.run(
                    [sys.executable, script, "--quick"],
                    capture_output=True,
                    text=True,
                    env={**os.environ, "PYTHONPATH": str(PACKAGE.parent)},
                )
                self.assertEqual(ran.returncode, 0, ran.stderr)
                self.assertTrue(ran.stdout.strip())


if __name__ == "__main__":
    unittest.main()
