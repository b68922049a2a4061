"""How much a class holds and a function takes: no more than a reader keeps in mind. What universal-ctags reads of C++.

Of 537 classes clang counts more members in three, by one: of #if it reads one branch, and it does not see x of
"struct X { ... } x{}", of "std::array<T, n()> x{}" or behind alignas.
"""
import json
import shutil
import subprocess

MOST_MEMBERS = 20
MOST_PARAMETERS = 8
# The interface's headers of C (.h) are free: their structs and tables only grow by appending.
CPP = {".hpp", ".cpp", ".cu", ".cuh"}
PARTS = ("api", "backends", "harness")
CTAGS = ("ctags", "--quiet", "--options=NONE", "--output-format=json", "--langmap=CUDA:", "--langmap=C++:+.cu.cuh",
         "--languages=C++", "--kinds-C++=cfmpsu", "--fields=NFneKSZ", "--fields-C++={properties}", "-f", "-", "-L", "-")


def tags_of(files, root):
    read = subprocess.run(CTAGS, input="\n".join(map(str, files)), cwd=root, capture_output=True, text=True, check=True)
    return [json.loads(line) for line in read.stdout.splitlines()]


def full_name(tag):
    return f"{tag['scope']}::{tag['name']}" if "scope" in tag else tag["name"]


def parameters(signature):
    """Those of "(std::pair<int, int> a, int b = f(1, 2)) const"."""
    depth, texts = 0, [""]
    for letter in signature:
        depth += (letter in "(<[{") - (letter in ")>]}")
        if depth == 0:
            break
        if letter == "," and depth == 1:
            texts.append("")
        else:
            texts[-1] += letter
    first = texts[0].lstrip("( ")
    return [] if first in ("", "void") else [first, *texts[1:]]


def check_members(tags):
    """Of specializations, which share a name, each is a class of its own."""
    classes = [tag for tag in tags if tag["kind"] in ("class", "struct", "union") and "end" in tag]
    count = [0] * len(classes)
    by_name = {}
    for i, tag in enumerate(classes):
        by_name.setdefault((tag["path"], full_name(tag)), []).append(i)
    for member in tags:
        if member["kind"] != "member" or "static" in member.get("properties", ""):
            continue
        for i in by_name.get((member["path"], member.get("scope")), []):
            count[i] += classes[i]["line"] <= member["line"] <= classes[i]["end"]
    for tag, number in zip(classes, count):
        if number > MOST_MEMBERS:
            yield f"{tag['path']}:{tag['line']}: {tag['name']} has {number} data members, more than {MOST_MEMBERS}"


def check_parameters(tags):
    for tag in tags:
        if tag["kind"] not in ("function", "prototype") or "signature" not in tag:
            continue
        taken = parameters(tag["signature"])
        if taken and taken[0].startswith("CallTag<"):
            continue  # a call of the interface of C, of which this one repeats the parameters
        if len(taken) > MOST_PARAMETERS:
            where, name = f"{tag['path']}:{tag['line']}", tag["name"]
            yield f"{where}: {name} takes {len(taken)} parameters, more than {MOST_PARAMETERS}"


def check_sizes(files, root):
    """No class of more than MOST_MEMBERS, and no function of more than MOST_PARAMETERS."""
    if shutil.which("ctags") is None:
        yield "there is no ctags to look at sizes with: apt install universal-ctags"
        return
    tags = tags_of([file for file in files if file.suffix in CPP and file.parts[0] in PARTS], root)
    yield from check_members(tags)
    yield from check_parameters(tags)
