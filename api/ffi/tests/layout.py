"""Whether what tests/abi/layout.inl records holds elsewhere: layout.py LANGUAGE LAYOUT SOURCE WORK COMPILER...

LANGUAGE is rust or csharp, SOURCE its plumb.rs or Plumb.cs. Writes a program with a check for each record to the folder
WORK, compiles and runs it. For C# the last word of COMPILER is what runs the program.
"""
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from generator.words import rust_name  # noqa: E402

RUST = """#[path = "{source}"]
mod plumb;
use plumb::*;

fn check(what: &str, is: i64, recorded: i64) -> u32 {{
    if is != recorded {{
        println!("{{}}: {{}} is recorded, and it is {{}}", what, recorded, is);
    }}
    (is != recorded) as u32
}}
macro_rules! SIZE {{
    ($kind:ident, $size:expr) => {{
        check(concat!("size of ", stringify!($kind)), std::mem::size_of::<$kind>() as i64, $size)
    }};
}}
macro_rules! AT {{
    ($kind:ident, $member:ident, $offset:expr) => {{{{
        let value = std::mem::MaybeUninit::<$kind>::uninit();
        let member = unsafe {{ std::ptr::addr_of!((*value.as_ptr()).$member) }};
        let offset = member as usize - value.as_ptr() as usize;
        check(concat!("place of ", stringify!($kind), ".", stringify!($member)), offset as i64, $offset)
    }}}};
}}
macro_rules! IS {{
    ($name:ident, $value:expr) => {{ check(stringify!($name), $name as i64, $value) }};
}}

fn main() {{
    let mut wrong = 0;
{checks}
    let version = PLUMB_MAKE_VERSION(PLUMB_VERSION_MAJOR(PLUMB_VERSION), PLUMB_VERSION_MINOR(PLUMB_VERSION));
    wrong += check("the version of its parts", version as i64, PLUMB_VERSION as i64);
    std::process::exit(if wrong == 0 {{ 0 }} else {{ 1 }});
}}
"""

CSHARP = """using System;
using System.Runtime.InteropServices;
using Plumb.Ffi;
using static Plumb.Ffi.Constants;

public static unsafe class Layout
{{
    private static int Check(string what, long value, long recorded)
    {{
        if (value != recorded) Console.WriteLine($"{{what}}: {{recorded}} is recorded, and it is {{value}}");
        return value == recorded ? 0 : 1;
    }}
    // In memory, and as it is given to C: the same, as nothing is a reference.
    private static int SIZE<T>(int size, long recorded)
    {{
        string what = $"size of {{typeof(T).Name}}";
        return Check(what, size, recorded) + Check($"{{what}} in C", Marshal.SizeOf(typeof(T)), recorded);
    }}
    private static int AT<T>(string member, long recorded)
    {{
        return Check($"place of {{typeof(T).Name}}.{{member}}", (long)Marshal.OffsetOf(typeof(T), member), recorded);
    }}

    public static int Main()
    {{
        int wrong = 0;
{checks}
        uint version = PLUMB_MAKE_VERSION(PLUMB_VERSION_MAJOR(PLUMB_VERSION), PLUMB_VERSION_MINOR(PLUMB_VERSION));
        wrong += Check("the version of its parts", version, PLUMB_VERSION);
        fixed (byte* name = Calls.Bytes(PLUMB_EXT_STATE))
            wrong += Check("a text there and back", Calls.Text(name) == "plumb.state/1" ? 1 : 0, 1);
        return wrong == 0 ? 0 : 1;
    }}
}}
"""


def rust_check(kind, words):
    return f"    wrong += {kind}!({', '.join([words[0], *map(rust_name, words[1:])])});"


def csharp_check(kind, words):
    name, last = words[0], words[-1]
    arguments = {"SIZE": f"SIZE<{name}>(sizeof({name}), {last})", "AT": f'AT<{name}>("{words[1]}", {last})',
                 "IS": f'Check("{name}", (long){name}, {last})'}
    return f"        wrong += {arguments[kind]};"


def records(layout):
    """(kind, words) of each line, as the macros of C would see them."""
    text = re.sub(r"/\*.*?\*/", "", layout.read_text(), flags=re.DOTALL)
    found = [(kind, re.split(r"\s*,\s*", words)) for kind, words in re.findall(r"(\w+)\(([^)]*)\)", text)]
    if {kind for kind, _ in found} != {"SIZE", "AT", "IS"}:
        raise SystemExit(f"{layout} does not hold SIZE, AT and IS alone")
    return found


def main():
    language, layout, source, work = sys.argv[1], *map(pathlib.Path, sys.argv[2:5])
    compiler = sys.argv[5:]
    found = records(layout)
    work.mkdir(parents=True, exist_ok=True)
    template, check, name = CSHARP, csharp_check, "Layout.cs"
    if language == "rust":
        template, check, name = RUST, rust_check, "layout.rs"
    checks = "\n".join(check(kind, words) for kind, words in found)
    (work / name).write_text(template.format(source=source.resolve(), checks=checks))
    if language == "rust":
        subprocess.run([*compiler, "-o", work / "layout", work / name], check=True)
        command = [work / "layout"]
    else:
        subprocess.run([*compiler[:-1], f"-out:{work / 'layout.exe'}", source, work / name], check=True)
        command = [compiler[-1], work / "layout.exe"]
    status = subprocess.run(command).returncode
    if status == 0:
        print(f"{len(found)} records hold")
    return status


if __name__ == "__main__":
    sys.exit(main())
