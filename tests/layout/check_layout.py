"""The layout of the code, which compilers do not see: check_layout.py ROOT [FLOORS].

Arrows go harness -> api <- backends, and within a part down its floors: a room, which is a folder, includes files of
its own and of rooms on lower floors, as floors.json lists them from the top. Rooms on one floor do not see each other.
A folder within a room belongs to it, unless it is a room of its own.
No folder holds more files than a reader takes in, no class more members, no function more parameters (sizes.py).
Prints what is wrong, a line each; exits with 1 then.
"""
import json
import pathlib
import re
import subprocess
import sys

from sizes import check_sizes

MOST_FILES = 30
SOURCES = {".c", ".h", ".hpp", ".cpp", ".cu", ".cuh"}
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
# Pictures and rows of results, and the frozen interface, are no reading.
NOT_COUNTED = re.compile(r"^(harness/results|tests/abi/frozen|scenes/)")


def includes(path):
    text = path.read_text()
    for found in INCLUDE.finditer(text):
        yield text.count("\n", 0, found.start()) + 1, found.group(1)


def room_of(path, rooms):
    """The innermost room of a path within a part; "." for what lies in none of its folders, None where no room is."""
    if "/" not in path:
        return "." if "." in rooms else None
    inside = [room for room in rooms if path.startswith(f"{room}/")]
    return max(inside, key=len, default=None)


def check_floors(part, floors, files, root):
    """An include points to the own room or down."""
    floor_of = {room: number for number, rooms in enumerate(floors) for room in rooms}
    for file in files:
        path = str(file.relative_to(part))
        if path.startswith("tests/"):
            continue  # they stand on all floors
        room = room_of(path, floor_of)
        if room is None:
            folder = f"room {path.split('/')[0]} is on no floor" if "/" in path else "lies in no room"
            yield f"{file}: {folder} of {part}: see floors.json"
            continue
        for line, target in includes(root / file):
            if target.startswith("plumb/"):
                continue
            other = room_of(target, floor_of)
            if other is None or other == ".":
                yield f'{file}:{line}: "{target}" is in no room of {part}: say the room in which it is'
            elif other != room and floor_of[other] <= floor_of[room]:
                where = "on the same floor as" if floor_of[other] == floor_of[room] else "above"
                yield f'{file}:{line}: "{target}": room {other} is {where} {room}, and includes only point down'


def check_arrows(files, root):
    """The harness and the backends know the interface and not each other."""
    for file in files:
        top = file.parts[0]
        if top not in ("api", "harness", "backends"):
            continue
        for line, target in includes(root / file):
            if re.match(r"(\.\./)*(harness|backends)/", target):
                yield f'{file}:{line}: "{target}": {top} sees api and itself'


def check_folders(files):
    """No folder of more than MOST_FILES files."""
    count = {}
    for file in files:
        count[file.parent] = count.get(file.parent, 0) + 1
    for folder, number in sorted(count.items()):
        if number > MOST_FILES and not NOT_COUNTED.match(f"{folder}/"):
            yield f"{folder}: {number} files, more than {MOST_FILES}: it holds more than one idea"


def main():
    root = pathlib.Path(sys.argv[1])
    floors_file = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else pathlib.Path(__file__).parent / "floors.json"
    floors = json.loads(floors_file.read_text())
    listed = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True)
    if listed.returncode != 0:  # an archive of the sources, without git
        listed = subprocess.run(["find", ".", "-type", "f", "-not", "-path", "./build/*", "-printf", "%P\n"], cwd=root,
                                capture_output=True, text=True, check=True)
    files = [pathlib.Path(name) for name in listed.stdout.splitlines() if (root / name).is_file()]
    sources = [file for file in files if file.suffix in SOURCES]
    wrong = []
    for part, rooms in floors.items():
        wrong += check_floors(part, rooms, [file for file in sources if file.is_relative_to(part)], root)
    wrong += check_arrows(sources, root)
    wrong += check_folders(files)
    wrong += check_sizes(sources, root)
    print("\n".join(wrong) if wrong else f"{len(sources)} sources in {len(floors)} parts")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
