"""The CI files can be read, say what their services need, and their scripts are shell: test_files.py ROOT."""
import pathlib
import re
import subprocess
import sys
import unittest

try:
    import yaml
except ImportError:
    print("skipped: python has no yaml; install python3-yaml")
    sys.exit(0)

ROOT = pathlib.Path(sys.argv.pop())
CI = ROOT / "harness" / "ci"


def read(name):
    return yaml.safe_load((CI / name).read_text())


def assert_shell(test, script):
    # What GitHub puts in before a shell sees it stands for some word.
    script = re.sub(r"\$\{\{.*?\}\}", "word", script)
    parsed = subprocess.run(["bash", "-n"], input=script, text=True, capture_output=True)
    test.assertEqual(parsed.returncode, 0, f"{script}\n{parsed.stderr}")


class Files(unittest.TestCase):
    def test_every_file_is_looked_at(self):
        self.assertEqual({file.name for file in CI.iterdir()}, {"github.yml", "gitlab.yml", "study.sh"})

    def test_github(self):
        workflow = read("github.yml")
        # YAML 1.1 takes the key "on" for a truth.
        self.assertEqual(set(workflow[True]), {"push", "pull_request"})
        self.assertIn("pull-requests", workflow["permissions"])
        steps = workflow["jobs"]["study"]["steps"]
        for step in steps:
            self.assertEqual(1, ("run" in step) + ("uses" in step), step)
            if "run" in step:
                assert_shell(self, step["run"])
            else:
                self.assertRegex(step["uses"], r"^actions/[a-z-]+(/[a-z]+)?@v\d+$")
        ids = {step["id"] for step in steps if "id" in step}
        text = (CI / "github.yml").read_text()
        self.assertLessEqual(set(re.findall(r"steps\.(\w+)\.", text)), ids)
        self.assertLessEqual(set(re.findall(r"env\.(\w+)", text)), set(workflow["env"]))

    def test_gitlab(self):
        file = read("gitlab.yml")
        job = file["plumb"]
        for line in job["script"]:
            self.assertIsInstance(line, str, "a line with a colon is taken for a mapping")
        assert_shell(self, "\n".join(job["script"]))
        policies = {rule["variables"]["BASELINE"] for rule in job["rules"]}
        self.assertEqual(policies, {"pull", "pull-push"})
        for cache in job["cache"]:
            self.assertLessEqual({"key", "paths"}, set(cache))

    def test_what_they_call_is_there(self):
        for name in ("github.yml", "gitlab.yml"):
            text = (CI / name).read_text()
            for called in set(re.findall(r"\bplumb/((?:harness|dev)[\w./]*)", text)):
                self.assertTrue((ROOT / called).is_file(), f"{name}: {called}")
            for preset in set(re.findall(r"--preset (\w+)", text)):
                self.assertIn(f'"name": "{preset}"', (ROOT / "CMakePresets.json").read_text())

    def test_study_is_shell(self):
        assert_shell(self, (CI / "study.sh").read_text())
        self.assertTrue((CI / "study.sh").stat().st_mode & 0o100, "it can be run")


if __name__ == "__main__":
    unittest.main()
