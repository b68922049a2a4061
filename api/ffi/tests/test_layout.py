"""What does not hold is found: test_layout.py LANGUAGE LAYOUT SOURCE WORK COMPILER..., as layout.py."""
import pathlib
import subprocess
import sys
import unittest

TESTS = pathlib.Path(__file__).resolve().parent
LANGUAGE, LAYOUT, SOURCE, WORK, *COMPILER = sys.argv[1:]
del sys.argv[1:]
# Of PlumbPairResult: what follows the number has no need to lie at a multiple of 8.
FLOAT = {"rust": ("f64,\n    /// into points", "f32,\n    /// into points"),
         "csharp": ("double distance;\n    /// <summary>into points", "float distance;\n    /// <summary>into points")}
STRUCT = {"rust": "pub struct PlumbFence {", "csharp": "public unsafe struct PlumbFence\n"}
VALUE = {"rust": "PLUMB_KINEMATIC: PlumbMotion = 1", "csharp": "PLUMB_KINEMATIC = 1"}


class Layout(unittest.TestCase):
    def setUp(self):
        self.layout, self.source = pathlib.Path(LAYOUT).read_text(), pathlib.Path(SOURCE).read_text()

    def check(self):
        work = pathlib.Path(WORK)
        work.mkdir(parents=True, exist_ok=True)
        layout, source = work / "changed.inl", work / pathlib.Path(SOURCE).name
        layout.write_text(self.layout)
        source.write_text(self.source)
        command = [sys.executable, TESTS / "layout.py", LANGUAGE, layout, source, work, *COMPILER]
        return subprocess.run(command, text=True, capture_output=True)

    def change(self, text, old, new):
        self.assertIn(old, text)
        return text.replace(old, new, 1)

    def test_other_records(self):
        self.layout = self.change(self.layout, "SIZE(PlumbVec3, 24)", "SIZE(PlumbVec3, 32)")
        self.layout = self.change(self.layout, "AT(PlumbBodyDesc, density, 136)", "AT(PlumbBodyDesc, density, 128)")
        self.layout = self.change(self.layout, "IS(PLUMB_E_CORRUPT, -11)", "IS(PLUMB_E_CORRUPT, -12)")
        checked = self.check()
        self.assertEqual(checked.returncode, 1, checked.stderr)
        for line in ("size of PlumbVec3: 32 is recorded, and it is 24",
                     "place of PlumbBodyDesc.density: 128 is recorded, and it is 136",
                     "PLUMB_E_CORRUPT: -12 is recorded, and it is -11"):
            self.assertIn(line, checked.stdout)

    def test_other_declarations(self):
        self.source = self.change(self.source, *FLOAT[LANGUAGE])
        self.source = self.change(self.source, VALUE[LANGUAGE], VALUE[LANGUAGE].replace("= 1", "= 3"))
        checked = self.check()
        self.assertEqual(checked.returncode, 1, checked.stderr)
        self.assertIn("place of PlumbPairResult.first_point: 8 is recorded, and it is 4", checked.stdout)
        self.assertIn("PLUMB_KINEMATIC: 1 is recorded, and it is 3", checked.stdout)

    def test_missing_struct(self):
        self.source = self.change(self.source, STRUCT[LANGUAGE], STRUCT[LANGUAGE].replace("Fence", "Hedge"))
        checked = self.check()
        self.assertNotEqual(checked.returncode, 0)
        self.assertIn("PlumbFence", checked.stderr)


if __name__ == "__main__":
    unittest.main()
