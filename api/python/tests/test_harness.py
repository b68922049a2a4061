"""Scenes, studies and reports by the program: a stand-in shows how it is called and heard, the real one what comes
back."""

import os
import pathlib
import stat
import sys
import tempfile
import time
import unittest
from unittest import mock

from support import plumb

harness = plumb.harness


class StandIn(unittest.TestCase):
    """Against a program that does as each test says."""

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def be(self, body):
        program = pathlib.Path(self.folder, "plumb")
        program.write_text(f"#!{sys.executable}\nimport json, os, sys, time\n{body}\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        self.enterContext(mock.patch.dict(os.environ, {"PLUMB_PROGRAM": str(program)}))

    def test_options(self):
        self.be("print(json.dumps({'line': sys.argv[1:]}))")
        (row,) = harness.run(
            "D1",
            pathlib.Path("x.json"),
            backend=["ode", "bullet"],
            param={"H": 10, "on": True},
            dt=1 / 240,
            judge_timeout=9,
            record=True,
            layers=False,
            profile=None,
        )
        self.assertEqual(
            row["line"],
            [
                "run",
                "D1",
                "x.json",
                "--json",
                "--backend=ode",
                "--backend=bullet",
                "--param=H=10",
                "--param=on=true",
                f"--dt={1 / 240}",
                "--judge-timeout=9",
                "--record",
            ],
        )

    def test_rows_come_as_they_are_written(self):
        self.be(
            f"""print('{{"n": 1}}', flush=True)
while not os.path.exists({self.folder + "/go"!r}): time.sleep(0.01)
print('{{"n": 2}}')"""
        )
        seen = []

        def on_row(row):
            seen.append(row["n"])
            pathlib.Path(self.folder, "go").touch()  # the program goes on only when its first row was heard

        self.assertEqual(harness.run("D1", on_row=on_row), [{"n": 1}, {"n": 2}])
        self.assertEqual(seen, [1, 2])

    def test_errors_have_the_programs_sentence(self):
        self.be("sys.stderr.write('running\\nplumb: unknown scene \"D\"\\n'); sys.exit(2)")
        with self.assertRaisesRegex(harness.Failed, '^unknown scene "D"$') as raised:
            harness.run("D")
        self.assertEqual((raised.exception.status, raised.exception.command[1:3]), (2, ["run", "D"]))
        self.be("os.kill(os.getpid(), 9)")
        with self.assertRaisesRegex(harness.Failed, "ended with -9 and said nothing"):
            harness.run("D")

    def test_much_on_both_sides_does_not_block(self):
        self.be(
            """for i in range(3000):
    sys.stderr.write('x' * 100 + '\\n'); print(json.dumps({'i': i}))"""
        )
        self.assertEqual(len(harness.run("D1")), 3000)

    def test_who_stops_listening_ends_the_program(self):
        self.be("""print(json.dumps({'pid': os.getpid()}), flush=True); time.sleep(600)""")
        pids = []

        def on_row(row):
            pids.append(row["pid"])
            raise KeyboardInterrupt

        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            harness.run("D1", on_row=on_row)
        self.assertLess(time.monotonic() - began, 60)
        with self.assertRaises(ProcessLookupError):
            os.kill(pids[0], 0)

    def test_studies_as_dictionaries(self):
        self.be("print(json.dumps({'study': json.load(open(sys.argv[2])), 'out': sys.argv[-1]}))")
        (row,) = harness.study({"scenes": ["D1"]}, budget="9s")
        self.assertEqual(row["study"], {"scenes": ["D1"]})
        self.assertTrue(row["out"].startswith("--out="))

    def test_a_missing_program_is_said(self):
        with mock.patch.dict(os.environ, {"PLUMB_PROGRAM": "/nonesuch/plumb"}):
            with self.assertRaisesRegex(FileNotFoundError, "PLUMB_PROGRAM is /nonesuch/plumb"):
                harness.run("D1")


def is_there():
    try:
        return bool(harness.program() and harness.backends())
    except (FileNotFoundError, harness.Failed):
        return False


@unittest.skipUnless(is_there(), "the program plumb is not there, or finds no backend")
class Program(unittest.TestCase):
    def test_run_compare_and_report(self):
        names = [row["name"] for row in harness.backends() if row["status"] == "ok"][:2]
        with tempfile.TemporaryDirectory() as out:
            rows = harness.compare("A1", backend=names, seconds=0.2, repeat=1, out=out)
            self.assertEqual([row["backend"] for row in rows], names)
            self.assertTrue(all(row["status"] == "ok" for row in rows), rows)
            again = harness.report(out, html=pathlib.Path(out, "page.html"))
            self.assertEqual({row["cell"] for row in again}, {row["cell"] for row in rows})
            self.assertGreater(pathlib.Path(out, "page.html").stat().st_size, 10_000)

    def test_scenes_and_claims(self):
        (scene,) = harness.scenes("D1")
        self.assertEqual((scene["slug"], [one["name"] for one in scene["parameters"]]), ("tower", ["H"]))
        name = next(row["name"] for row in harness.backends() if row["status"] == "ok")
        checks = harness.conform(name, check="settings")
        self.assertTrue(checks)
        self.assertTrue(all({"check", "outcome"} <= set(check) for check in checks))

    def test_what_there_is_not(self):
        with self.assertRaisesRegex(harness.Failed, 'unknown scene "D1x"; did you mean "D1"') as raised:
            harness.run("D1x")
        self.assertEqual(raised.exception.status, 2)


if __name__ == "__main__":
    unittest.main()
