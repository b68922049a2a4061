"""Scenes, studies and reports: the program plumb, whose rows come back as dictionaries.

Keywords are the program's options (`plumb run --help`, or help of the verb), with underscores for hyphens: True gives a
flag, a dictionary NAME=VALUE for each of its items, a list the option for each of its items.

>>> from plumb import harness
>>> rows = harness.run("D1", backend="impulse", param={"H": 3}, seconds=0.5)
>>> [(row["backend"], row["status"], row["metrics"]["stands"]["value"]) for row in rows]
[('impulse', 'ok', 1.0)]
>>> harness.run("D1", backend="impuls")
Traceback (most recent call last):
plumb.harness.Failed: there is no backend "impuls"; did you mean "impulse"?

The program is $PLUMB_PROGRAM, or the one that is installed with this package, or the first on the path.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Union

from . import _core

Row = Dict[str, Any]
"""A line of the program's --json."""
OnRow = Optional[Callable[[Row], object]]
PathLike = Union[str, "os.PathLike[str]"]


class Failed(RuntimeError):
    """The program ended in an error, and this is its sentence."""

    def __init__(self, sentence: str, status: int, command: List[str]) -> None:
        super().__init__(sentence)
        self.status = status
        """The exit status; below 0: the signal that ended it."""
        self.command = command


def program() -> str:
    """Where the program is. Raises FileNotFoundError, which says what to do."""
    named = os.environ.get("PLUMB_PROGRAM")
    if named:
        if not shutil.which(named):
            raise FileNotFoundError(f"PLUMB_PROGRAM is {named}, which is no program; set it to where plumb is")
        return named
    candidates = [Path(__file__).resolve().parents[3] / "bin" / "plumb"]
    if _core.installed_prefix:
        candidates.append(Path(_core.installed_prefix, "bin", "plumb"))
    for candidate in candidates:
        if os.access(candidate, os.X_OK):
            return str(candidate)
    found = shutil.which("plumb")
    if found is None:
        raise FileNotFoundError(
            "the program plumb is not found; set PLUMB_PROGRAM to where it is, or put it on the PATH"
        )
    return found


def run(*scenes: PathLike, on_row: OnRow = None, **options: Any) -> List[Row]:
    """Scenes (ids, slugs, groups, files) on backends: a row a cell. on_row is called with each as it finishes."""
    return _listed(_rows("run", scenes, options), on_row)


def compare(*scenes: PathLike, out: Optional[PathLike] = None, on_row: OnRow = None, **options: Any) -> List[Row]:
    """Scenes on all backends, in turns. out: a folder that keeps the rows, where finished cells are not run again."""
    return _kept("compare", scenes, out, on_row, options)


def study(
    study: Union[PathLike, Mapping[str, Any]], out: Optional[PathLike] = None, on_row: OnRow = None, **options: Any
) -> List[Row]:
    """A whole study: a preset (quick, standard, full, scaling), a study file, or what one holds as a dictionary."""
    if not isinstance(study, Mapping):
        return _kept("study", (study,), out, on_row, options)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "study.json")
        file.write_text(json.dumps(study))
        return _kept("study", (file,), out, on_row, options)


def report(*results: PathLike, **options: Any) -> List[Row]:
    """The rows of folders with results. html="page.html" also writes the page."""
    return list(_rows("report", results, options))


def conform(*backends: PathLike, on_row: OnRow = None, **options: Any) -> List[Row]:
    """What backends claim against what they do: a row a check, with its outcome and failures."""
    return _listed(_rows("conform", backends, options, fine=(0, 1)), on_row)


def scenes(*names: PathLike) -> List[Row]:
    """What there is to run: parameters, needs, truths and thresholds."""
    return list(_rows("scenes", names, {}))


def backends(*names: PathLike) -> List[Row]:
    """What the program can load, with settings and capabilities."""
    return list(_rows("backends", names, {}))


def _kept(
    verb: str, names: tuple[PathLike, ...], out: Optional[PathLike], on_row: OnRow, options: Dict[str, Any]
) -> List[Row]:
    if out is not None:
        return _listed(_rows(verb, names, {**options, "out": out}), on_row)
    with tempfile.TemporaryDirectory() as folder:
        return _listed(_rows(verb, names, {**options, "out": folder}), on_row)


def _listed(rows: Iterator[Row], on_row: OnRow) -> List[Row]:
    listed = []
    for row in rows:
        if on_row is not None:
            on_row(row)
        listed.append(row)
    return listed


def _words(options: Mapping[str, Any]) -> List[str]:
    words: List[str] = []
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(flag)
        elif isinstance(value, Mapping):
            words += [f"{flag}={key}={_text(one)}" for key, one in value.items()]
        elif isinstance(value, (list, tuple)):
            words += [f"{flag}={_text(one)}" for one in value]
        else:
            words.append(f"{flag}={_text(value)}")
    return words


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _rows(
    verb: str, names: tuple[PathLike, ...], options: Mapping[str, Any], fine: tuple[int, ...] = (0,)
) -> Iterator[Row]:
    """The lines of --json, one after another as the program writes them. Ends the program when nobody reads on."""
    command = [program(), verb, *[os.fspath(name) for name in names], "--json", *_words(options)]
    with tempfile.TemporaryFile("w+") as complaints, subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=complaints, text=True
    ) as child:
        assert child.stdout is not None
        try:
            for line in child.stdout:
                yield json.loads(line)
            status = child.wait()
        finally:
            if child.poll() is None:
                child.terminate()
        complaints.seek(0)
        said = complaints.read().strip()
    if status not in fine:
        sentence = (
            said.splitlines()[-1].removeprefix("plumb: ") if said else f"plumb ended with {status} and said nothing"
        )
        raise Failed(sentence, status, command)
