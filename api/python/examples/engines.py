"""One scene on every engine, side by side: what the harness measures, as a table of text.

python3 engines.py [--scene D1] [--param H=10] [--quick]
"""

import argparse

from plumb import harness


def table(rows, names):
    """Rows of the harness as lines: an engine each."""
    head = ["engine", "of", "status", *names, "ms a step"]
    lines = [
        [row["backend"], variant(row), row["status"], *[value(row, name) for name in names], time(row)] for row in rows
    ]
    wide = [max(len(line[column]) for line in [head, *lines]) for column in range(len(head))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, wide)) for line in [head, *lines])


def variant(row):
    return " ".join(f"{name}={number:g}" for name, number in row["params"].items())


def value(row, name):
    """A metric with its verdict."""
    metric = row.get("metrics", {}).get(name)
    if metric is None or metric["value"] is None:
        return "-"
    return f"{metric['value']:.3g} {metric['unit'] if metric['unit'] != '1' else ''}".strip() + (
        "" if metric["pass"] is not False else " (fails)"
    )


def time(row):
    measured = row.get("time", {}).get("ms_per_step", {}).get("median")
    return "-" if measured is None else f"{measured:.3f}"


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--scene", default="D1")
    options.add_argument("--param", action="append", default=[], metavar="NAME=VALUE")
    options.add_argument("--quick", action="store_true", help="half a second of a small tower")
    asked = options.parse_args()
    more = {"param": ["H=3"], "seconds": 0.5} if asked.quick else {"param": asked.param}
    (scene,) = harness.scenes(asked.scene)
    print(f"{scene['name']} {scene['title']}: {scene['doc']}\n")
    rows = harness.run(asked.scene, on_row=lambda row: print(f"... {row['backend']}", flush=True), **more)
    scored = [truth["name"] for truth in scene["truths"] if truth["threshold"] is not None]
    print("\n" + table(rows, scored))


if __name__ == "__main__":
    main()
