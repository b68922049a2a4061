"""check_layout.py finds each kind of mistake in a small tree of sources, and none where there is none."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).parent / "check_layout.py"
FLOORS = {"backends/engine": [["."], ["plugin"], ["left", "right"], ["left/below"], ["math"]]}


class CheckLayout(unittest.TestCase):
    def run_on(self, sources):
        """sources: text by path. Returns the exit status and what was printed."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder) / "tree"
            for path, text in sources.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            floors = pathlib.Path(folder) / "floors.json"
            floors.write_text(json.dumps(FLOORS))
            done = subprocess.run([sys.executable, CHECK, root, floors], capture_output=True, text=True)
            return done.returncode, done.stdout

    def check_one(self, path, text, says):
        status, printed = self.run_on({path: text})
        self.assertEqual(status, 1, printed)
        self.assertIn(says, printed)
        self.assertEqual(len(printed.splitlines()), 1, printed)

    def test_what_points_down_is_right(self):
        status, printed = self.run_on({
            "backends/engine/plugin/world.cpp": '#include "plugin/world.hpp"\n#include "left/a.hpp"\n#include "math/v.hpp"\n',
            "backends/engine/left/a.hpp": '#include "math/v.hpp"\n#include "plumb/types.h"\n#include <vector>\n',
            "backends/engine/tests/test.cpp": '#include "plugin/world.hpp"\n',
            "harness/run.cpp": '#include "plumb/loader.hpp"\n',
        })
        self.assertEqual(status, 0, printed)

    def test_what_points_up(self):
        self.check_one("backends/engine/math/v.hpp", '#pragma once\n#include "left/a.hpp"\n', "math/v.hpp:2")

    def test_what_points_across(self):
        self.check_one("backends/engine/left/a.hpp", '#include "right/b.hpp"\n', "on the same floor")

    def test_rooms_that_no_floor_has(self):
        self.check_one("backends/engine/attic/a.hpp", "", "room attic is on no floor")
        self.check_one("backends/engine/attic/below/a.hpp", "", "room attic is on no floor")

    def test_rooms_within_rooms(self):
        self.check_one("backends/engine/left/below/a.hpp", '#include "left/b.hpp"\n', "room left is above left/below")
        status, printed = self.run_on({
            "backends/engine/main.cpp": '#include "plugin/world.hpp"\n',
            "backends/engine/left/b.hpp": '#include "left/below/a.hpp"\n',
            "backends/engine/left/beside/c.hpp": '#include "left/b.hpp"\n',
        })
        self.assertEqual(status, 0, printed)

    def test_includes_that_name_no_room(self):
        self.check_one("backends/engine/left/a.hpp", '#include "b.hpp"\n', "is in no room")

    def test_arrows_between_parts(self):
        self.check_one("backends/other/a.cpp", '#include "harness/run.hpp"\n', "backends sees api and itself")
        self.check_one("harness/a.cpp", '#include "../backends/other/a.hpp"\n', "harness sees api and itself")

    def test_folders_that_are_too_full(self):
        status, printed = self.run_on({f"api/src/file_{i}.cpp": "" for i in range(31)})
        self.assertEqual(status, 1, printed)
        self.assertIn("api/src: 31 files", printed)


if __name__ == "__main__":
    unittest.main()
