"""The header as the compiler's preprocessor leaves it, and the macros that it defines, with where they stand."""
import dataclasses
import pathlib
import re
import subprocess
import tempfile

from generator.model import INTEGERS, Unknown

# What a backend says of its one symbol; every other attribute would change what is declared.
EXPORT = '__attribute__((visibility("default")))'
# Of what is no value: how C exports.
NO_VALUES = {"PLUMB_EXPORT"}

# The system's own headers hold extensions of its compiler; the types are all that is used of them.
STANDARD = {
    "stdint.h": "".join(f"typedef int {name};\n" for name in INTEGERS),
    "stddef.h": "typedef int size_t;\n",
}
MARKER = re.compile(r'# (\d+) "([^"]*)"')
DEFINE = re.compile(r"#define (\w+)(?:\(([^)]*)\))? ?(.*)")


@dataclasses.dataclass
class Definition:
    name: str
    parameters: object  # a list of names, or None
    body: str
    file: str
    line: int


def run_compiler(command, header):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        place = re.search(r"^(.*?:\d+):.*error", done.stderr, re.MULTILINE)
        raise Unknown(place.group(1) if place else header, f"{command[0]} says:\n{done.stderr}")
    return done.stdout


def run_preprocessor(header, include, compiler):
    # What is no C at all the compiler says best, with its own headers.
    run_compiler([compiler, "-fsyntax-only", "-x", "c", "-std=c11", f"-I{include}", header], header)
    with tempfile.TemporaryDirectory() as folder:
        for name, text in STANDARD.items():
            (pathlib.Path(folder) / name).write_text(text)
        command = [compiler, "-E", "-dD", "-x", "c", "-std=c11", "-nostdinc", f"-I{folder}", f"-I{include}", header]
        return run_compiler(command, header)


def preprocess(header, include, compiler):
    """Text for the parser, in which line markers stay, and the definitions that are values."""
    lines, definitions = [], []
    file, line = "", 0
    for text in run_preprocessor(header, include, compiler).split("\n"):
        marker = MARKER.match(text)
        found = DEFINE.match(text)
        if marker:
            file, line = marker.group(2), int(marker.group(1)) - 1
        elif found and pathlib.Path(file).is_relative_to(include):
            name, parameters, body = found.groups()
            guard = not body and name.endswith("_H")
            if name not in NO_VALUES and not guard:
                names = None if parameters is None else [word.strip() for word in parameters.split(",")]
                definitions.append(Definition(name, names, body.strip(), file, line))
        elif text.startswith("#undef") and pathlib.Path(file).is_relative_to(include):
            raise Unknown(f"{file}:{line}", "a macro that ends")
        lines.append("" if text.startswith(("#define", "#undef")) else text.replace(EXPORT, ""))
        line += 1
    return "\n".join(lines), definitions
