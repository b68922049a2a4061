"""same_bits.py PLUMB A B SCENE...: scenes end in the same bits on both backends. A scene is an id and options of plumb run."""
import json
import shlex
import subprocess
import sys

plumb, *names = sys.argv[1:4]
differ = []
for scene in sys.argv[4:]:
    command = [plumb, 'run', *shlex.split(scene), '--json', *(word for name in names for word in ('--backend', name))]
    rows = [json.loads(line) for line in subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()]
    ends = {}
    for row in rows:
        if './dev platforms wasm' in row['reason']:
            sys.exit(f'skipped: {row["reason"]}')
        ends.setdefault(json.dumps(row['params']), []).append((row['status'], row['hash']))
    for params, found in ends.items():
        print(scene, params, found)
        if len(found) != 2 or found[0] != found[1] or not found[0][1]:  # what fails its scene has bits, too
            differ.append(f'{scene} {params}')
if differ:
    sys.exit(f'these differ: {"; ".join(differ)}. After a change of the engine ./dev platforms wasm compiles it anew')
