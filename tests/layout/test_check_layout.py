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

    def check_all(self, path, texts, says):
        """Each is wrong where all are in one file, in the order of its lines; says "" for those that are right."""
        status, printed = self.run_on({path: "".join(texts)})
        self.assertEqual(status, 1 if any(says) else 0, printed)
        first, expected = 1, []
        for text, what in zip(texts, says):
            if what:
                expected.append(f"{path}:{first}: {what}")
            first += text.count("\n")
        self.assertEqual(sorted(printed.splitlines()) if expected else [], sorted(expected), printed)

    def test_classes_that_hold_too_much(self):
        members = "".join(f"  int m{i} = f({{1, 2}});\n" for i in range(20))
        others = "  static constexpr int kMost = 2;\n  static int count;\n  void f(int a);\n  using T = int;\n"
        full = f"namespace {{ class Full {{\n{others}{members}}}; }}\n"
        holder = f"struct Holder {{\n  struct Within {{\n{members}  }};\n  Within within[2];\n}};\n"
        specializations = [f"template <> struct S<{type}> {{\n{members}}};\n" for type in ("int", "char")]
        more = ("int x", "int bits : 3", "std::array<int, 2> x{}", "enum class E { a, b } x = E::a", "void (*f)(int)",
                "std::function<void(int, int)> f", "struct { int a, b; } x", "Buffer<int>& x", "mutable Mutex x")
        wrong = [f"template <class T> class C{i} {{\n{members}  {one};\n}};\n" for i, one in enumerate(more)]
        self.check_all("backends/engine/main.hpp", [full, holder, *specializations, *wrong],
                       ["", "", "", "", *(f"C{i} has 21 data members, more than 20" for i in range(len(more)))])
        two = f"struct Full {{\n{members}  PLUMB_UNSEEN float x[3], y;\n}};\n"
        self.check_all("backends/engine/main.cu", [two], ["Full has 22 data members, more than 20"])
        self.check_all("api/include/plumb/a.h", [two], [""])

    def test_functions_that_take_too_much(self):
        eight = "int a, std::pair<int, int> b, int c = f(1, 2), void (*d)(int, int), int e, int f, int g, int h"
        right = [f"namespace {{ void f({eight}) {{}} }}\n",
                 "void g() { call(1, 2, 3, 4, 5, 6, 7, 8, 9); }\n",
                 f"void call(CallTag<call>, {eight}, int i) {{}}\n"]
        nine = [f"void f({eight}, int i);\n",
                f"PLUMB_HD inline void f({eight}, int i) {{}}\n",
                f"template <class T> [[nodiscard]] auto f({eight}, const T& i) -> T {{ return i; }}\n",
                f"struct S {{ void f({eight}, int i) const; }};\n",
                f"void S::f({eight}, int i) const {{}}\n"]
        self.check_all("backends/engine/main.cu", right + nine,
                       ["", "", "", *["f takes 9 parameters, more than 8"] * len(nine)])
        self.check_all("api/include/plumb/a.h", nine, [""] * len(nine))
        status, printed = self.run_on({"harness/a.cpp": f"const auto f = []({eight}, int i) {{ return 1; }};\n"})
        self.assertIn("takes 9 parameters", printed)


if __name__ == "__main__":
    unittest.main()
