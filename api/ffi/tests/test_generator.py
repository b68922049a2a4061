"""What the generator carries over, and that it names what it does not know: test_generator.py [LAYOUT COMPILER]."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

TESTS = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(TESTS), str(TESTS.parent)]
try:
    import pycparser  # noqa: F401
except ImportError:
    print("skipped: python has no pycparser; install python3-pycparser")
    sys.exit(0)

from generator import csharp, model, rust  # noqa: E402
from generator.parse import Parser  # noqa: E402
from layout import records  # noqa: E402

COMPILER = sys.argv.pop() if len(sys.argv) > 2 else "gcc"
LAYOUT = pathlib.Path(sys.argv.pop()) if len(sys.argv) > 1 else TESTS.parents[2] / "tests" / "abi" / "layout.inl"

HEAD = "#ifndef PLUMB_PLUMB_H\n#define PLUMB_PLUMB_H\n#include <stddef.h>\n#include <stdint.h>\n"
LINE = HEAD.count("\n") + 1  # of the first one that a test writes


def parsed(text):
    with tempfile.TemporaryDirectory() as folder:
        header = pathlib.Path(folder) / "plumb" / "plumb.h"
        header.parent.mkdir()
        header.write_text(f"{HEAD}{text}\n#endif\n")
        return Parser(pathlib.Path(folder), COMPILER).parse()


class Unknown(unittest.TestCase):
    """Every construct that has no declaration elsewhere is an error with its line, and nothing is left out."""

    def refused(self, text, words, line=0):
        with self.assertRaisesRegex(model.Unknown, rf"plumb/plumb\.h:{LINE + line}.*{words}"):
            parsed(text)

    def test_types(self):
        for kind in ("int", "long", "unsigned", "long long", "unsigned char", "_Bool", "size", "__int128"):
            with self.subTest(kind):
                self.refused(f"typedef struct A {{\n  {kind} member;\n}} A;", "", 1)
        self.refused("typedef struct A {\n  volatile uint32_t member;\n} A;", "volatile", 1)
        self.refused("typedef struct A {\n  _Alignas(16) uint32_t member;\n} A;", "alignment|C11", 1)
        self.refused("typedef struct A {\n  uint32_t bits : 3;\n} A;", "bit field", 1)
        self.refused("typedef struct A {\n  uint32_t count;\n  uint32_t rows[];\n} A;", "ArrayDecl", 2)
        self.refused("typedef struct A {\n  union { uint32_t a; float b; } either;\n} A;", "Union", 1)
        self.refused("typedef struct A {\n  struct { uint32_t a; };\n} A;", "no name", 1)
        self.refused("typedef union A { uint32_t a; float b; } A;", "Union")
        self.refused("typedef double A;", "neither an integer")
        self.refused("typedef struct B { double x; } A;", "struct B is called A")

    def test_functions(self):
        self.refused("typedef void (*A)(uint32_t count, ...);", "any number of arguments")
        self.refused("typedef void (*A)();", r"\(void\)")
        self.refused("typedef void (*A)(uint32_t);", "no name")
        self.refused("typedef void (*A)(uint32_t rows[3]);", "array")
        self.refused("typedef void A(uint32_t row);", "FuncDecl")
        self.refused("static inline void a(void);", "storage")
        self.refused("inline uint32_t a(void) { return 1; }", "FuncDef")

    def test_declarations(self):
        self.refused("extern uint32_t a;", "")
        self.refused("struct A { uint32_t a; };", "")
        self.refused("enum A { B = 1 };", "enum A")
        self.refused("typedef int8_t A;\nenum {\n  B = 200\n};", "200", 1)
        self.refused("#pragma pack(1)", "Pragma")
        self.refused("_Static_assert(1, \"one\");", "StaticAssert")
        self.refused("typedef struct __attribute__((packed)) A { uint8_t a; } A;", "C11")
        self.refused("typedef struct A {\n  uint32_t a\n} A;", "C11", 2)

    def test_macros(self):
        self.refused("#define A 1.5", "no value")
        self.refused("#define A unknown", "no value")
        self.refused("#define A do {} while (0)", "no value")
        self.refused("#define A", "no value")
        self.refused('#define A "line\\n"', "text")
        self.refused("#define A sizeof(uint32_t)", "no value")
        self.refused("#define A(x) (x)", "cast x")
        self.refused("#define A(x) ((uint32_t)(x) + (uint64_t)(x))", "cast x")
        self.refused("#define A 010", "octal")

    def test_headers(self):
        with self.assertRaisesRegex(model.Unknown, "stdio.h"):
            parsed("#include <stdio.h>")


class Carried(unittest.TestCase):
    def setUp(self):
        self.headers = parsed(
            "/* How fast. */\ntypedef uint32_t Speed;\n"
            "enum {\n  SLOW, /* at most\n           1 m/s */\n  FAST = 1u << 3\n};\n"
            "#define BIT ((Speed)1 << 31) /* the last */\n#define LAST (BIT + BIT - 1)\n#define WORD \"word\"\n"
            "/* A thing. */\ntypedef struct Thing {\n  struct Thing* type; /* [any] null & <none> */\n"
            "  double event[FAST + 1];\n  struct Thing* (*self)(const char* const* in, size_t out);\n} Thing;\n"
            "typedef struct Pair {\n  Speed speeds[2], more;\n  /* m/s */\n  Thing things[2];\n} Pair;\n"
        )

    def test_rust(self):
        text = rust.write(self.headers)
        for line in (
            "/// How fast.\npub type Speed = u32;",
            "/// at most 1 m/s\npub const SLOW: Speed = 0;\npub const FAST: Speed = 1 << 3;",
            "/// the last\npub const BIT: Speed = 1 << 31;",
            "pub const LAST: Speed = 4294967295;",
            "/// A thing.\n#[repr(C)]\n#[derive(Clone, Copy, Debug)]\npub struct Thing {",
            "    /// \\[any\\] null & \\<none>\n    pub r#type: *mut Thing,\n    pub event: [f64; 9],",
            '    pub self_: Option<unsafe extern "C" fn(r#in: *const *const c_char, out: usize) -> *mut Thing>,',
            "    pub speeds: [Speed; 2],\n    pub more: Speed,\n    /// m/s\n    pub things: [Thing; 2],",
        ):
            self.assertIn(line, text)

    def test_csharp(self):
        text = csharp.write(self.headers)
        for line in (
            "    // Speed, uint. How fast.\n    /// <summary>at most 1 m/s</summary>\n    public const uint SLOW = 0u;",
            "    public const uint FAST = 1u << 3;",
            "    public const uint LAST = 4294967295u;\n    public const string WORD = \"word\";",
            "    /// <summary>[any] null &amp; &lt;none&gt;</summary>\n    public Thing* type;\n"
            "    public fixed double @event[9];\n    public IntPtr self;",
            "    public unsafe delegate Thing* Self(byte** @in, UIntPtr @out);",
            "    public fixed uint speeds[2];\n    public uint more;\n"
            "    /// <summary>m/s</summary>\n    public Thing_2 things;",
            "    private Thing at0, at1;",
        ):
            self.assertIn(line, text)


class Recorded(unittest.TestCase):
    """What the headers declare is in layout.inl, so that its checks in every language see all of it."""

    def test_everything_is_recorded(self):
        headers = Parser(TESTS.parents[1] / "include", COMPILER).parse()
        recorded = {(kind, *words[:-1]) for kind, words in records(LAYOUT)}
        # A struct without a name of its own has none in C; the version is another one with every minor version.
        structs = [item for item in model.all_of(headers, model.Struct) if "_" not in item.name]
        declared = {("SIZE", item.name) for item in structs}
        declared |= {("AT", item.name, member.name) for item in structs for member in item.members}
        declared |= {("IS", item.name) for item in model.all_constants(headers)} - {("IS", "PLUMB_VERSION")}
        self.assertEqual(sorted(declared - recorded), [], "not in layout.inl")
        self.assertEqual(sorted(recorded - declared), [], "in layout.inl alone")


class Kept(unittest.TestCase):
    def test_check_sees_what_differs(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, TESTS.parent / "generate.py", "--out", folder, "--compiler", COMPILER]
            subprocess.run(command, check=True)
            subprocess.run([*command, "--check"], check=True)
            file = pathlib.Path(folder) / "plumb.rs"
            file.write_text(file.read_text().replace("pub density: f64", "pub density: f32"))
            checked = subprocess.run([*command, "--check"], text=True, capture_output=True)
            self.assertEqual(checked.returncode, 1)
            self.assertIn("-    pub density: f32,\n+    pub density: f64,", checked.stdout)


if __name__ == "__main__":
    unittest.main()
