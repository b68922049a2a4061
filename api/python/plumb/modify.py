"""plumb.modify/1: bodies, joints and shapes that become others while they live. Their handles stay what they were.

>>> import plumb
>>> world = plumb.open("impulse").world(needs=["rotation", "collision", "friction"])
>>> ball = world.create_shape(plumb.Sphere(0.5))
>>> body = world.create_body(plumb.BodyDesc(ball, position=(0, 10, 0)))
>>> world.modify.bodies([plumb.BodyChange(body, motion="static", flags="never_sleeps")])
>>> _ = [world.step(1 / 60) for _ in range(60)]
>>> float(world.read("pose", body)[1])
10.0
>>> world.close()
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Iterable, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arrays import Handle, Handles, handle, handles
from ._words import pick, pick_bits
from .bodies import BodyDesc
from .enums import AxisMode, BodyFlag, BodyMember, JointMember, Lock, MassMode, Motion
from .joints import JointDesc, Limit, Motor, Spring, StiffSpring
from .shapes import ShapeDesc, Vec3, described_shapes


@dataclass
class BodyChange:
    """What of a body becomes another; None stays. Members of the mass are changed together: what of them is None is as
    in a new BodyDesc. A body that becomes dynamic and never was needs them."""

    body: Handle
    motion: Union[Motion, str, None] = None
    shape: Optional[Handle] = None
    """0: none. The mass stays as it is unless it is given."""
    mass_mode: Union[MassMode, str, None] = None
    """The mass, from here on, is of dynamic bodies only."""
    density: Optional[float] = None
    mass: Optional[float] = None
    centre_of_mass: Optional[Vec3] = None
    inertia: Optional[Vec3] = None
    inertia_orientation: Optional[Vec3] = None
    flags: Union[BodyFlag, str, Iterable[Union[BodyFlag, str]], None] = None
    """All of them, but asleep."""
    locks: Union[Lock, str, Iterable[Union[Lock, str]], None] = None
    """All of them."""

    def _fill(self, row: NDArray[np.void], name: str) -> None:
        """row: one row of a structured array, as an array of length 1."""
        what = BodyMember(0)
        row["body"] = handle(self.body, f"{name}.body")
        if self.motion is not None:
            what |= BodyMember.MOTION
            row["motion"] = pick(Motion, self.motion, f"{name}.motion")
        if self.shape is not None:
            what |= BodyMember.SHAPE
            row["shape"] = handle(self.shape, f"{name}.shape")
        mass = _given(self, "mass_mode", "density", "mass", "centre_of_mass", "inertia", "inertia_orientation")
        if mass:
            what |= BodyMember.MASS
            _fill_from(
                row,
                BodyDesc(**mass),
                _core.body_desc,
                name,
                ("mass_mode", "density", "mass", "centre_of_mass", "inertia", "inertia_orientation"),
            )
        if self.flags is not None:
            what |= BodyMember.FLAGS
            row["flags"] = int(pick_bits(BodyFlag, self.flags, f"{name}.flags"))
        if self.locks is not None:
            what |= BodyMember.LOCKS
            row["locks"] = int(pick_bits(Lock, self.locks, f"{name}.locks"))
        row["what"] = int(what)


# Members of a joint that are changed together.
_TOGETHER = {
    JointMember.FRAMES: ("position_a", "orientation_a", "position_b", "orientation_b"),
    JointMember.LIMITS: ("limits", "axis_modes", "rest_length"),
    JointMember.MOTORS: ("motors",),
    JointMember.SPRINGS: ("springs",),
    JointMember.STRENGTH: ("break_force", "break_torque"),
}


@dataclass
class JointChange:
    """What of a joint becomes another; None stays. The members of each paragraph are changed together: what of them is
    None, where another is given, is as in a new JointDesc."""

    joint: Handle
    enabled: Optional[bool] = None
    """False: the joint lets its bodies go and touch, and waits for True."""
    collide_connected: Optional[bool] = None

    position_a: Optional[Vec3] = None
    """The joint pulls its bodies to where the new frames are."""
    orientation_a: Optional[Vec3] = None
    position_b: Optional[Vec3] = None
    orientation_b: Optional[Vec3] = None

    limits: Optional[Mapping[int, Limit]] = None
    axis_modes: Optional[Mapping[int, Union[AxisMode, str]]] = None
    rest_length: Optional[float] = None

    motors: Optional[Mapping[int, Motor]] = None

    springs: Optional[Mapping[int, Union[Spring, StiffSpring]]] = None

    break_force: Optional[float] = None
    break_torque: Optional[float] = None

    def _fill(self, row: NDArray[np.void], name: str) -> None:
        """row: one row of a structured array, as an array of length 1."""
        what = JointMember(0)
        row["joint"] = handle(self.joint, f"{name}.joint")
        for member, columns in _TOGETHER.items():
            given = _given(self, *columns)
            if given:
                what |= member
                _fill_from(row, JointDesc("ball", 1, **given), _core.joint_desc, name, columns)
        if self.enabled is not None:
            what |= JointMember.ENABLED
            row["enabled"] = bool(self.enabled)
        if self.collide_connected is not None:
            what |= JointMember.COLLIDE_CONNECTED
            row["collide_connected"] = bool(self.collide_connected)
        row["what"] = int(what)


def _given(change: Union[BodyChange, JointChange], *names: str) -> Dict[str, Any]:
    return {name: getattr(change, name) for name in names if getattr(change, name) is not None}


def _fill_from(
    row: NDArray[np.void],
    desc: Union[BodyDesc, JointDesc],
    dtype: np.dtype[np.void],
    name: str,
    columns: Tuple[str, ...],
) -> None:
    """Columns as a descriptor would have them."""
    whole = np.zeros(1, dtype)
    desc._fill(whole, name)
    for column in columns:
        row[column] = whole[column]


class Modify:
    """`world.modify`. Backend.capability("modify", "bodies", "shape") says what an engine can change. What sleeps and
    is changed, or rested on what is changed, wakes."""

    def __init__(self, core: _core.World) -> None:
        self._core = core

    def bodies(self, changes: Sequence[BodyChange]) -> None:
        """All or none; each body once."""
        rows = np.zeros(len(changes), _core.body_change)
        for i, change in enumerate(changes):
            change._fill(rows[i : i + 1], f"changes[{i}]")
        self._core.modify_bodies(rows)

    def joints(self, changes: Sequence[JointChange]) -> None:
        """All or none; each joint once."""
        rows = np.zeros(len(changes), _core.joint_change)
        for i, change in enumerate(changes):
            change._fill(rows[i : i + 1], f"changes[{i}]")
        self._core.modify_joints(rows)

    def shapes(self, shapes: Union[Handle, Handles], others: Sequence[ShapeDesc]) -> None:
        """shapes[i] becomes others[i], whole and of the type that it has (TriangleMesh, HeightField), for all bodies
        that have it. All or none; each shape once. What sleeps where the surface is another wakes.

        >>> import plumb
        >>> with plumb.open("impulse").world(["rotation", "collision", "friction"]) as world:
        ...     heights = np.zeros((9, 9))
        ...     ground = world.create_shape(plumb.HeightField(heights, (1, 1)))
        ...     _ = world.create_body(plumb.BodyDesc(ground, "static"))
        ...     ball = world.create_body(plumb.BodyDesc(world.create_shape(plumb.Sphere(0.5)), position=(0, 0.5, 0)))
        ...     heights[3:6, 3:6] = -2  # a hole under the ball
        ...     world.modify.shapes(ground, [plumb.HeightField(heights, (1, 1))])
        ...     _ = [world.step(1 / 60) for _ in range(120)]
        ...     print(f"it lies at {world.read('pose', ball)[1]:.1f} m")
        it lies at -1.5 m
        """
        self._core.modify_shapes(handles(shapes, "shapes"), described_shapes(others))
