"""plumb.joints/1: joints between two bodies, or between a body and the world.

A pendulum of a metre and its period, about 2 s:

>>> import plumb
>>> with plumb.open("impulse").world(needs=["rotation", "collision", "friction", "joints"]) as world:
...     ball = world.create_shape(plumb.Sphere(0.02))
...     bob = world.create_body(plumb.BodyDesc(ball, position=(0.05, -1, 0)))
...     joint = world.joints.create(plumb.JointDesc("ball", body_b=bob, position_b=(-0.05, 1, 0)))
...     swung = [world.step(1 / 240) and world.read("pose", bob)[0] for _ in range(480)]
>>> round(np.argmin(swung) / 240, 1)
1.0
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Dict, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import (
    Floats,
    Handle,
    Handles,
    fill,
    handle,
    handles,
    is_single,
    number,
    one_row,
    rows,
    rows_for_output,
    unsigned,
)
from ._words import pick
from .enums import AxisMode, JointField, JointType, SpringMode
from .shapes import Vec3


@dataclass
class Limit:
    """m or rad; lower <= upper."""

    lower: float
    upper: float

    def _row(self) -> tuple[float, float, int]:
        return (self.lower, self.upper, 1)


@dataclass
class Motor:
    """target_velocity: m/s or rad/s, of b seen from a. max_force: N or N m, >= 0."""

    target_velocity: float
    max_force: float

    def _row(self) -> tuple[float, float, int]:
        return (self.target_velocity, self.max_force, 1)


@dataclass
class Spring:
    """frequency: Hz, of the undamped spring with the pair's effective mass on this axis. damping_ratio: 1 is critical.
    rest: m or rad; a distance joint uses its rest_length."""

    frequency: float
    damping_ratio: float = 1.0
    rest: float = 0.0

    def _row(self) -> tuple[float, float, float, int, int]:
        return (self.rest, self.frequency, self.damping_ratio, 1, SpringMode.FREQUENCY)


@dataclass
class StiffSpring:
    """A spring of so much force: stiffness in N/m or N m/rad, damping in N s/m or N m s/rad, about rest in m or rad. Of
    stiffness 0 it is a damper; with rest as its target, a PD controller."""

    stiffness: float
    damping: float = 0.0
    rest: float = 0.0

    def _row(self) -> tuple[float, float, float, int, int]:
        return (self.rest, self.stiffness, self.damping, 1, SpringMode.STIFFNESS)


@dataclass
class JointDesc:
    """Joins a frame fixed in body a to a frame fixed in body b. Axes 0 1 2 are translations along x y z of frame a,
    axes 3 4 5 rotations about them; a hinge turns on axis 3, a slider slides on axis 0."""

    type: Union[JointType, str]
    body_b: Handle
    body_a: Handle = 0
    """0: the world; its frame is then in world axes."""
    position_a: Vec3 = (0.0, 0.0, 0.0)
    orientation_a: Vec3 = (0.0, 0.0, 0.0, 1.0)
    position_b: Vec3 = (0.0, 0.0, 0.0)
    orientation_b: Vec3 = (0.0, 0.0, 0.0, 1.0)
    collide_connected: bool = False
    axis_modes: Mapping[int, Union[AxisMode, str]] = field(default_factory=dict)
    """By axis; generic joints only. Axes that are not named are free."""
    limits: Mapping[int, Limit] = field(default_factory=dict)
    """By axis, as motors and springs."""
    motors: Mapping[int, Motor] = field(default_factory=dict)
    springs: Mapping[int, Union[Spring, StiffSpring]] = field(default_factory=dict)
    rest_length: float = 0.0
    """Of a distance joint, m, >= 0."""
    break_force: float = 0.0
    """N; 0: never breaks."""
    break_torque: float = 0.0
    """N m; 0: never breaks."""
    user_data: int = 0
    ratio: float = 0.0
    """Of a gear: turn of a + ratio * turn of b stays; of a rack and pinion: of a's turn by b's way, rad/m. Not 0."""

    def _fill(self, row: NDArray[np.void], name: str) -> None:
        """row: one row of a structured array, as an array of length 1."""
        row["user_data"] = unsigned(self.user_data, f"{name}.user_data")
        row["type"] = pick(JointType, self.type, f"{name}.type")
        row["body_a"] = handle(self.body_a, f"{name}.body_a")
        row["body_b"] = handle(self.body_b, f"{name}.body_b")
        row["collide_connected"] = bool(self.collide_connected)
        fill_axes(row, "axis_modes", self.axis_modes, name)
        for column in ("limits", "motors", "springs"):
            fill_axes(row, column, getattr(self, column), name)
        for column in (
            "position_a",
            "orientation_a",
            "position_b",
            "orientation_b",
            "rest_length",
            "break_force",
            "break_torque",
            "ratio",
        ):
            fill(row, column, getattr(self, column), f"{name}.{column}")


def fill_axes(row: NDArray[np.void], column: str, by_axis: Mapping[int, Any], name: str) -> None:
    """Of modes, limits, motors or springs those that are named, by axis."""
    for axis, part in by_axis.items():
        if axis not in range(6):
            raise ValueError(f"{name}.{column} names the axis {axis!r}; axes are 0 to 5")
        what = f"{name}.{column}[{axis}]"
        row[column][0][axis] = pick(AxisMode, part, what) if column == "axis_modes" else _checked(part, column, what)


def _checked(part: Any, column: str, what: str) -> Any:
    kinds: Dict[str, Tuple[type, ...]] = {"limits": (Limit,), "motors": (Motor,), "springs": (Spring, StiffSpring)}
    if not isinstance(part, kinds[column]):
        raise TypeError(f"{what} must be a {' or a '.join(kind.__name__ for kind in kinds[column])}, not {part!r}")
    return tuple(number(one, what) for one in part._row())


class Joints:
    """The joints of a world: `world.joints`."""

    def __init__(self, core: _core.World) -> None:
        self._core = core

    def create(self, desc: JointDesc) -> int:
        """Makes a joint and gives its handle. Needs joints."""
        return int(self.create_many([desc])[0])

    def create_many(self, descs: Sequence[JointDesc]) -> NDArray[np.uint64]:
        """All or none. Gives their handles."""
        table = np.zeros(len(descs), _core.joint_desc)
        for i, desc in enumerate(descs):
            desc._fill(table[i : i + 1], f"joints[{i}]")
        return self._core.create_joints(table)

    def destroy(self, joints: Union[Handle, Handles]) -> None:
        """One or many; all or none."""
        self._core.destroy_joints(handles(joints, "joints"))

    def read(
        self, field: Union[JointField, str], joints: Union[Handle, Handles], out: Optional[Floats] = None
    ) -> Floats:
        """A row for each joint; of a single handle its row. out: n x columns, float64 or float32, that is filled and
        given back."""
        kind = pick(JointField, field, "field")
        ids = handles(joints, "joints")
        columns = _core.joint_columns_of(kind)
        into = np.empty((len(ids), columns)) if out is None else rows_for_output(out, len(ids), columns, "out")
        self._core.read_joints(kind, ids, into)
        return one_row(into) if out is None and is_single(joints) else into

    def write(self, field: Union[JointField, str], values: ArrayLike, joints: Union[Handle, Handles]) -> None:
        """"motor": target velocity and max force of axis 0, of axis 1 and so on, 12 numbers a joint; or "spring_rest":
        where the springs of the six axes rest. A row for each joint, or one for all."""
        kind = pick(JointField, field, "field")
        ids = handles(joints, "joints")
        self._core.write_joints(kind, ids, rows(values, len(ids), _core.joint_columns_of(kind), "values"))
