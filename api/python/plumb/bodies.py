"""Descriptors of bodies: one by one with names and defaults, or many as columns of a structured array.

>>> import plumb
>>> rows = plumb.body_rows(1000)
>>> rows["position"][:, 1] = np.arange(1000) * 1.1
>>> rows["material"]["friction"] = 0.8
>>> with plumb.open("impulse").world(needs=["rotation", "collision", "friction"]) as world:
...     rows["shape"] = world.create_shape(plumb.Box((0.5, 0.5, 0.5)))
...     world.create_bodies(rows).shape
(1000,)
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Iterable, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arrays import Handle, fill, handle, unsigned
from ._words import pick, pick_bits
from .enums import BodyFlag, Lock, MassMode, Motion
from .shapes import Material, Vec3


@dataclass
class Filter:
    """Whether two bodies may touch: equal groups that are not 0 decide (positive: always, negative: never); otherwise
    each one's category must be in the other's mask."""

    category: int = 1
    mask: int = 0xFFFFFFFF
    group: int = 0

    def _row(self) -> tuple[int, int, int]:
        return (self.category, self.mask, self.group)


@dataclass
class BodyDesc:
    """A body that World.create_body makes: dynamic, at rest at the origin, of 1000 kg/m3, touching everything."""

    shape: Handle = 0
    """Of the same world; 0: none, touches nothing."""
    motion: Union[Motion, str] = Motion.DYNAMIC
    position: Vec3 = (0.0, 0.0, 0.0)
    """m, of the body's frame, in which its shape is placed; the centre of mass may be elsewhere."""
    orientation: Vec3 = (0.0, 0.0, 0.0, 1.0)
    """x y z w, unit."""
    linear_velocity: Vec3 = (0.0, 0.0, 0.0)
    """m/s, of the centre of mass."""
    angular_velocity: Vec3 = (0.0, 0.0, 0.0)
    """rad/s, world axes."""
    mass_mode: Union[MassMode, str, None] = None
    """None: explicit where an inertia is given, else from the total mass where that is given, else from density."""
    density: float = 1000.0
    """kg/m3, > 0."""
    mass: float = 0.0
    """kg, > 0 where it is used."""
    centre_of_mass: Vec3 = (0.0, 0.0, 0.0)
    """Body frame, m; used with mass_mode explicit."""
    inertia: Vec3 = (0.0, 0.0, 0.0)
    """Principal moments about the centre of mass, kg m2."""
    inertia_orientation: Vec3 = (0.0, 0.0, 0.0, 1.0)
    """From principal axes to the body's frame."""
    material: Material = field(default_factory=Material)
    gravity_scale: float = 1.0
    linear_damping: float = 0.0
    """c in dv/dt = -c v, 1/s, >= 0; needs damping when not 0."""
    angular_damping: float = 0.0
    filter: Filter = field(default_factory=Filter)
    flags: Union[BodyFlag, str, Iterable[Union[BodyFlag, str]]] = BodyFlag(0)
    locks: Union[Lock, str, Iterable[Union[Lock, str]]] = Lock(0)
    user_data: int = 0
    """64 bits of the host's."""
    rolling_friction: float = 0.0
    """m, >= 0: the greatest moment along a contact, relative to its normal force; needs rolling_friction when not 0."""
    spinning_friction: float = 0.0
    """Likewise about its normal."""

    def _mass_mode(self) -> MassMode:
        if self.mass_mode is not None:
            return pick(MassMode, self.mass_mode, "BodyDesc.mass_mode")
        if np.any(self.inertia):
            return MassMode.EXPLICIT
        return MassMode.FROM_TOTAL if self.mass else MassMode.FROM_DENSITY

    def _fill(self, row: NDArray[np.void], name: str) -> None:
        """row: one row of a structured array, as an array of length 1."""
        row["user_data"] = unsigned(self.user_data, f"{name}.user_data")
        row["shape"] = handle(self.shape, f"{name}.shape")
        row["motion"] = pick(Motion, self.motion, f"{name}.motion")
        row["mass_mode"] = self._mass_mode()
        row["flags"] = int(pick_bits(BodyFlag, self.flags, f"{name}.flags"))
        row["locks"] = int(pick_bits(Lock, self.locks, f"{name}.locks"))
        fill(row, "material", self.material._row(), f"{name}.material")
        fill(row, "filter", self.filter._row(), f"{name}.filter")
        for column in (
            "position",
            "orientation",
            "linear_velocity",
            "angular_velocity",
            "density",
            "mass",
            "centre_of_mass",
            "inertia",
            "inertia_orientation",
            "gravity_scale",
            "linear_damping",
            "angular_damping",
            "rolling_friction",
            "spinning_friction",
        ):
            fill(row, column, getattr(self, column), f"{name}.{column}")


def body_rows(count: int, desc: Optional[BodyDesc] = None) -> NDArray[np.void]:
    """count rows of what desc says (BodyDesc(): the defaults), to be changed column by column: a row for each body, and
    columns of the names of BodyDesc. Motions, flags, locks and mass_mode are numbers here."""
    rows = np.zeros(1, _core.body_desc)
    (desc if desc is not None else BodyDesc())._fill(rows, "BodyDesc")
    return np.repeat(rows, count)


def described_bodies(descs: Union[NDArray[np.void], Sequence[BodyDesc]]) -> NDArray[np.void]:
    """What World.create_bodies hands to the backend."""
    if isinstance(descs, np.ndarray):
        if descs.dtype != _core.body_desc or descs.ndim != 1:
            raise TypeError(
                f"bodies must be rows that plumb.body_rows made, or BodyDescs, not {descs.dtype} of shape "
                f"{descs.shape}"
            )
        return np.ascontiguousarray(descs)
    rows = np.zeros(len(descs), _core.body_desc)
    for i, desc in enumerate(descs):
        if not isinstance(desc, BodyDesc):
            raise TypeError(f"bodies[{i}] must be a BodyDesc, not {desc!r}")
        desc._fill(rows[i : i + 1], f"bodies[{i}]")
    return rows
