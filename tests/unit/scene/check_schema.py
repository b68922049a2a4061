"""Holds scene.schema.json against every committed scene, which it must take, and every wrong one, which it must not.

usage: check_schema.py SCENES WRONG_SCENES
"""
import copy
import json
import pathlib
import sys

import jsonschema


def with_value(scene, pointer, value):
    """The scene with the value at a JSON pointer, in place of what is there or beside it."""
    changed = copy.deepcopy(scene)
    *way, last = [part.replace("~1", "/").replace("~0", "~") for part in pointer.split("/")[1:]]
    place = changed
    for part in way:
        place = place[int(part) if isinstance(place, list) else part]
    if not isinstance(place, list):
        place[last] = value
    elif int(last) == len(place):
        place.append(value)
    else:
        place[int(last)] = value
    return changed


def main(scenes, wrong_scenes):
    schema = json.loads((scenes / "scene.schema.json").read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    faults = []
    files = sorted(scenes.glob("*/*.json"))
    for file in files:
        error = jsonschema.exceptions.best_match(validator.iter_errors(json.loads(file.read_text())))
        if error:
            faults.append(f"{file}: {list(error.absolute_path)}: {error.message}")
    listed = json.loads(wrong_scenes.read_text())
    if not validator.is_valid(listed["good"]):
        faults.append("the good scene of the list is refused")
    for wrong in listed["wrong"]:
        if wrong.get("schema", True) and validator.is_valid(with_value(listed["good"], wrong["at"], wrong["value"])):
            faults.append(f"{wrong['at']} = {json.dumps(wrong['value'])} is taken")
    print("\n".join(faults) or f"{len(files)} scenes taken, {len(listed['wrong'])} wrong ones looked at")
    return 1 if faults or not files else 0


sys.exit(main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])))
