"""Many worlds stepped together: the environments of a learner, the variants of a design.

Four worlds, in each of which a ball falls; two of them start anew:

>>> import plumb
>>> engine = plumb.open("impulse")
>>> def make(height):
...     world = engine.world(["snapshot"])
...     body = plumb.BodyDesc(position=(0, height, 0), mass=1, flags="no_rotation", material=plumb.Material(friction=0))
...     _ = world.create_body(body)
...     return world
>>> worlds = plumb.Worlds(make(height) for height in (1, 2, 3, 4))
>>> worlds.mark()
>>> for _ in range(60):
...     worlds.step(1 / 60)
>>> fallen = worlds.read("pose")[:, 0, 1] < -2  # worlds x bodies x columns
>>> fallen.tolist()
[True, True, False, False]
>>> worlds.reset(fallen)
>>> worlds.read("pose", 0)[:, 1].round(1).tolist()
[1.0, 2.0, -1.9, -0.9]
>>> worlds.borrow("pose").numpy().shape
(4, 1, 7)
>>> worlds.close()
"""

from __future__ import annotations

import operator
from collections.abc import Iterable as AnyIterable
from types import TracebackType
from typing import Any, Dict, Iterable, Iterator, List, Optional, Sequence, SupportsIndex, Tuple, Type, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Floats, Handle, Handles, as_floats, handles, is_single, number, unsigned
from ._words import pick
from .enums import Field, JointField
from .report import StepReport
from .state import LentRows, device_number
from .world import World

Places = Union[SupportsIndex, Sequence[SupportsIndex], NDArray[np.integer[Any]]]
"""Bodies by their place in the order of creation, the same in every world: 0 is the first."""
Mask = Union[NDArray[np.bool_], Sequence[bool]]
"""A bool for each world."""


class Worlds:
    """Worlds of one backend that hold equally many bodies, and calls on all of them: spread over threads, while other
    threads of Python run. What a world comes to does not depend on those beside it. Where the backend has
    plumb.worlds/1, it takes their steps together. Each is an ordinary World as before (worlds[i]), kept by these.

    A call that one world refuses is an Error of which the sentence begins with that world's number; the others have
    done it then, unless the call says otherwise. ValueError and TypeError, and an Error where a world may not be called
    now (a step is under way, another thread is in a call), come before anything is done."""

    bodies: NDArray[np.uint64]
    """Handles, worlds x bodies, in order of creation: those that lived when the worlds came together."""

    def __init__(self, worlds: Iterable[World], threads: int = 0) -> None:
        """worlds: at least one, all different. threads: over which they are spread, the caller's included; 0: as many
        as the machine has processors. It makes no difference to results; worlds made with threads=1 leave the threads
        to these. A World that was in other Worlds works in these; the others cannot borrow its rows any more. A
        process that is forked has none of the threads: make Worlds behind the fork."""
        if not isinstance(worlds, AnyIterable):
            raise TypeError(f"worlds must be Worlds that a backend made, as in [make(0), make(1)], not {worlds!r}")
        self._worlds: Tuple[World, ...] = tuple(worlds)
        seen: Dict[int, int] = {}
        for i, world in enumerate(self._worlds):
            if not isinstance(world, World):
                raise TypeError(f"worlds[{i}] must be a World, not {world!r}")
            if seen.setdefault(id(world), i) != i:
                raise ValueError(f"worlds[{i}] is worlds[{seen[id(world)]}] again; name each once")
        self._core = _core.Worlds(tuple(world._core for world in self._worlds), unsigned(threads, "threads", 32))
        self.bodies = self._core.bodies()
        self.bodies.flags.writeable = False

    # --- each by itself -----------------------------------------------------------------------------------------------

    def __len__(self) -> int:
        return len(self._worlds)

    def __getitem__(self, index: SupportsIndex) -> World:
        try:
            return self._worlds[operator.index(index)]
        except IndexError:
            raise IndexError(f"there is no world {index}: there are {len(self)}, counted from 0") from None

    def __iter__(self) -> Iterator[World]:
        return iter(self._worlds)

    def close(self) -> None:
        """Closes each world; rows that are lent live on. May be called again."""
        for world in self._worlds:
            world.close()

    def __enter__(self) -> Worlds:
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<Worlds of {self[0].backend.info.name}, {len(self)} with {self.bodies.shape[1]} bodies each>"

    # --- steps --------------------------------------------------------------------------------------------------------

    def step(self, dt: float) -> None:
        """A step of dt seconds of every world, from begin to end. Where one fails, the others are stepped all the same,
        and none is left within a step."""
        self._core.step(number(dt, "dt"))

    @property
    def reports(self) -> List[StepReport]:
        """Of the last step, by world; one that was not stepped, as it failed, has a report of step 0. Empty before the
        first step."""
        return [StepReport(report) for report in self._core.reports()]

    # --- there and back -----------------------------------------------------------------------------------------------

    def mark(self) -> None:
        """From now on reset() goes back to how the worlds are now. Needs snapshot. Where a world refuses, the last mark
        stays."""
        self._core.mark()

    def reset(self, mask: Optional[Mask] = None) -> None:
        """Takes each world whose entry of mask is True (None: all) back to the last mark, as World.snapshot.restore
        does: to the bit where the backend's snapshots are native. The same bodies and joints must live in it as
        then."""
        self._core.reset(self._mask(mask))

    # --- rows ---------------------------------------------------------------------------------------------------------

    def read(self, field: Union[Field, str], bodies: Optional[Places] = None, out: Optional[Floats] = None) -> Floats:
        """Rows of a field of all worlds: worlds x bodies x columns. bodies: by their place in the order of creation;
        None is all; of a single one worlds x columns come back. out: an array of float64 or float32 that is filled and
        given back, its rows any distance apart: nothing is allocated then."""
        kind = pick(Field, field, "field")
        places = self._places(bodies)
        shape = self._shape(places, kind)
        into = np.empty(shape) if out is None else _for_output(out, shape)
        self._core.read(kind, places, into)
        return into[:, 0] if out is None and is_single(bodies) else into

    def write(
        self,
        field: Union[Field, str],
        values: ArrayLike,
        bodies: Optional[Places] = None,
        mask: Optional[Mask] = None,
    ) -> None:
        """values: worlds x bodies x columns, or bodies x columns for every world, or one row for every body; as read
        gives them. A world whose entry of mask is False is left alone, whatever stands in its rows. Poses and
        velocities are set; forces, torques and impulses add to what acts on the bodies."""
        kind = pick(Field, field, "field")
        places = self._places(bodies)
        rows = _rows_for_all(values, self._shape(places, kind), is_single(bodies))
        self._core.write(kind, places, rows, self._mask(mask))

    def read_joints(
        self, field: Union[JointField, str], joints: Union[Handle, Handles], out: Optional[Floats] = None
    ) -> Floats:
        """Rows of joints of all worlds: worlds x joints x columns. joints: handles, the same in every world, as worlds
        that were made by the same calls have them; of a single one worlds x columns come back. out: as of read."""
        kind = pick(JointField, field, "field")
        ids = handles(joints, "joints")
        shape = (len(self), len(ids), _core.joint_columns_of(kind))
        into = np.empty(shape) if out is None else _for_output(out, shape)
        self._core.read_joints(kind, ids, into)
        return into[:, 0] if out is None and is_single(joints) else into

    def write_joints(
        self,
        field: Union[JointField, str],
        values: ArrayLike,
        joints: Union[Handle, Handles],
        mask: Optional[Mask] = None,
    ) -> None:
        """Motors alone are written: target velocity and max force of axis 0, of axis 1 and so on, 12 numbers a joint.
        values: worlds x joints x 12, or joints x 12 for every world, or one row for every joint. A world whose entry of
        mask is False is left alone."""
        kind = pick(JointField, field, "field")
        ids = handles(joints, "joints")
        shape = (len(self), len(ids), _core.joint_columns_of(kind))
        rows = _rows_for_all(values, shape, is_single(joints))
        self._core.write_joints(kind, ids, rows, self._mask(mask))

    def borrow(self, field: Union[Field, str], device: str = "cpu", copy: bool = False) -> LentRows:
        """Rows of the field pose (7 columns) or velocity (6) of all worlds where the engine keeps them: worlds x rows x
        columns. Which bodies the rows of worlds[i] are tells worlds[i].state.rows(); all must have as many rows. device
        and copy: as of World.state.borrow. Of a backend without plumb.worlds/1 an Error of UNSUPPORTED: read() then."""
        return LentRows(self._core.borrow(pick(Field, field, "field"), device_number(device), copy))

    # --- what callers give --------------------------------------------------------------------------------------------

    def _mask(self, mask: Optional[Mask]) -> NDArray[np.bool_]:
        if mask is None:
            return np.ones(len(self), np.bool_)
        entries = np.asarray(mask)
        if entries.dtype != np.bool_ or entries.shape != (len(self),):
            raise ValueError(
                f"mask must be a bool for each of {len(self)} worlds, not an array of {entries.dtype} of shape "
                f"{entries.shape}; a comparison such as heights < 0 gives one"
            )
        return np.ascontiguousarray(entries)

    def _places(self, bodies: Optional[Places]) -> Optional[NDArray[np.uint32]]:
        if bodies is None:
            return None
        places = np.atleast_1d(np.asarray(bodies))
        if places.ndim != 1 or (places.size and places.dtype.kind not in "iu"):
            raise TypeError(f"bodies must be whole numbers, places in the order of creation, not {bodies!r}")
        each = self.bodies.shape[1]
        for wrong in places[(places < 0) | (places >= each)][:1]:
            raise ValueError(
                f"bodies: there is no body {wrong}: each world has {each}, counted from 0 in order of creation "
                "(places, not handles)"
            )
        return np.ascontiguousarray(places, np.uint32)

    def _shape(self, places: Optional[NDArray[np.uint32]], field: Field) -> Tuple[int, int, int]:
        return (len(self), self.bodies.shape[1] if places is None else len(places), _core.columns_of(field))


def _for_output(out: Floats, shape: Tuple[int, int, int]) -> Floats:
    """An array of the caller's that is written to in place: no copy may stand in for it."""
    if not isinstance(out, np.ndarray) or out.dtype not in (np.float64, np.float32):
        raise TypeError(f"out must be a NumPy array of float64 or float32, not {getattr(out, 'dtype', out)!r}")
    if out.shape != shape:
        raise ValueError(f"out must be of shape {shape}, worlds x bodies x columns, not {out.shape}")
    if not out.flags.writeable:
        raise ValueError("out is read only; give an array that may be written")
    return out


def _rows_for_all(values: ArrayLike, shape: Tuple[int, int, int], single: bool) -> Floats:
    """What is written, spread over worlds and bodies where it is one row or one world's rows."""
    given = array = as_floats(values, "values")
    worlds, bodies, columns = shape
    if single and array.ndim == 2:
        array = array[:, np.newaxis]
    if array.shape not in (shape, (bodies, columns), (columns,)):
        wanted = f"{worlds} x {columns}" if single else f"{worlds} x {bodies} x {columns} or {bodies} x {columns}"
        raise ValueError(f"values must be {wanted} or {columns} numbers, not an array of shape {given.shape}")
    return np.ascontiguousarray(np.broadcast_to(array, shape))
