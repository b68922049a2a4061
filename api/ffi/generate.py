"""Writes what plumb.h declares in other languages: generate.py [--check] [--compiler CC].

plumb.rs and Plumb.cs are kept beside this script, so that whoever takes them needs neither it nor pycparser. --check
writes nothing, and fails where they are not what the headers say.
"""
import argparse
import difflib
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
try:
    import pycparser  # noqa: F401
except ImportError:
    print("skipped: python has no pycparser; install python3-pycparser")
    sys.exit(1)

from generator import csharp, rust  # noqa: E402
from generator.model import Unknown  # noqa: E402
from generator.parse import Parser  # noqa: E402

WRITERS = {"plumb.rs": rust.write, "Plumb.cs": csharp.write}


def differences(name, kept, made):
    """The first lines of what differs."""
    names = f"{name} as kept", f"{name} as generated"
    found = difflib.unified_diff(kept.split("\n"), made.split("\n"), *names, n=0, lineterm="")
    return "\n".join(list(found)[:20])


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--check", action="store_true")
    options.add_argument("--compiler", default="gcc", help="whose preprocessor reads the headers")
    options.add_argument("--include", type=pathlib.Path, default=HERE.parent / "include", help="has plumb/plumb.h")
    options.add_argument("--out", type=pathlib.Path, default=HERE)
    asked = options.parse_args()
    try:
        headers = Parser(asked.include, asked.compiler).parse()
        made = {name: write(headers) for name, write in WRITERS.items()}
    except Unknown as error:
        print(error, file=sys.stderr)
        return 1
    status = 0
    for name, text in made.items():
        file = asked.out / name
        if not asked.check:
            file.write_text(text)
        elif not file.exists() or file.read_text() != text:
            print(differences(name, file.read_text() if file.exists() else "", text))
            print(f"{file} is not what the headers say: run api/ffi/generate.py")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
