"""study.sh as a CI job calls it: with and without a baseline, when nothing and when something got worse."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(os.environ["PLUMB_SOURCE"]) / "harness" / "ci" / "study.sh"
BACKEND = os.environ["SAMPLE_BACKEND"]


class Study(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_study(self, out, *more, substeps=4):
        study = {"name": "fall", "sets": [{"scenes": "A1", "repetitions": 1, "settings": {"substeps": substeps}}]}
        (self.folder / "study.json").write_text(json.dumps(study))
        return subprocess.run(
            [SCRIPT, "--study", self.folder / "study.json", "--out", self.folder / out, "--backend", BACKEND, *more],
            text=True, capture_output=True)

    def comment(self, out):
        return (self.folder / out / "comment.md").read_text()

    def test_without_a_baseline_the_comment_is_the_report(self):
        (self.folder / "none").mkdir()
        done = self.run_study("new", "--baseline", self.folder / "none")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("# Plumb report", self.comment("new"))
        self.assertIn("A1", self.comment("new"))
        self.assertIn("</html>", (self.folder / "new" / "report.html").read_text())

    def test_with_a_baseline_it_says_what_got_worse_and_fails(self):
        self.assertEqual(self.run_study("old").returncode, 0)
        same = self.run_study("same", "--baseline", self.folder / "old")
        self.assertEqual(same.returncode, 0, self.comment("same"))
        self.assertIn("# Plumb against a baseline", self.comment("same"))
        self.assertIn("times do not count", self.comment("same"))
        timed = self.run_study("same", "--times", "--baseline", self.folder / "old")
        self.assertIn("intervals do not overlap", self.comment("same"), timed.stderr)
        # A change of the engine, as a baseline sees it: the same cells with larger errors.
        rows = [json.loads(line) for line in (self.folder / "old" / "results.jsonl").read_text().splitlines()]
        for row in rows:
            for metric in row["metrics"].values():
                if metric["error"]:
                    metric["error"] /= 2
        better = self.folder / "better"
        better.mkdir()
        (better / "results.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
        worse = self.run_study("worse", "--baseline", better)
        self.assertEqual(worse.returncode, 1, worse.stderr)
        self.assertIn("## Worse", self.comment("worse"))
        self.assertIn("drop", self.comment("worse"))

    def test_a_long_table_is_cut_at_a_line(self):
        done = self.run_study("long")
        self.assertEqual(done.returncode, 0, done.stderr)
        script = SCRIPT.read_text().replace("most_bytes=60000", "most_bytes=200")
        short = self.folder / "short.sh"
        short.write_text(script)
        short.chmod(0o755)
        whole = self.comment("long")
        cut = subprocess.run([short, "--study", self.folder / "study.json", "--out", self.folder / "long", "--backend",
                              BACKEND], text=True, capture_output=True)
        self.assertEqual(cut.returncode, 0, cut.stderr)
        kept, _, rest = self.comment("long").partition("\nThe rest is cut off here")
        self.assertTrue(rest)
        self.assertTrue(whole.startswith(kept))
        self.assertTrue(kept.endswith("\n"))
        self.assertLessEqual(len(kept.encode()), 200)

    def test_wrong_questions_are_refused(self):
        for arguments, because in ((["--out"], "needs a value"), (["--outt", "x"], '"--outt"'), ([], "--out DIR")):
            done = subprocess.run([SCRIPT, *arguments], text=True, capture_output=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn(because, done.stderr)
        done = self.run_study("out", "--budget", "soon")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertFalse((self.folder / "out" / "comment.md").exists())


if __name__ == "__main__":
    unittest.main()
