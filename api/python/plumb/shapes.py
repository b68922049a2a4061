"""Descriptors of collision shapes, which any number of bodies of a world may share.

>>> import plumb
>>> with plumb.open("impulse").world(needs=["rotation", "collision"]) as world:
...     ball, ramp = world.create_shapes([plumb.Sphere(0.5), plumb.Box((1, 0.1, 1))])
...     ball != ramp
True
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import Handle, fill, handle, number, numbers, unsigned
from .enums import ShapeType


def _shape(kind: ShapeType, desc: ShapeDesc, half_extents: Sequence[float] = (0.0, 0.0, 0.0)) -> _core.Shape:
    name = type(desc).__name__
    return _core.Shape(
        type=kind,
        radius=number(getattr(desc, "radius", 0.0), f"{name}.radius"),
        half_height=number(getattr(desc, "half_height", 0.0), f"{name}.half_height"),
        half_extents=half_extents,
        user_data=unsigned(desc.user_data, f"{name}.user_data"),
    )


def _give_materials(shape: _core.Shape, desc: Union[TriangleMesh, HeightField], triangles: int) -> None:
    name = type(desc).__name__
    given = np.asarray(desc.triangle_materials)
    if not len(desc.materials):
        if given.size:
            raise ValueError(f"{name}.triangle_materials is given, but no materials")
        return
    if given.dtype.kind not in "iu" or given.shape != (triangles,):
        raise ValueError(
            f"{name}.triangle_materials must be {triangles} whole numbers, one a triangle, "
            f"not {given.dtype} of shape {given.shape}"
        )
    if given.size and (given.min() < -1 or given.max() >= len(desc.materials)):
        wrong = given.min() if given.min() < -1 else given.max()
        raise ValueError(f"{name}.triangle_materials has {wrong}; they are -1 to the number of materials less 1")
    rows = np.array([material._row() for material in desc.materials], _core.material)
    shape.set_materials(rows, np.ascontiguousarray(given.astype(np.int64), np.uint32))


Vec3 = Union[Sequence[float], ArrayLike]


@dataclass
class Sphere:
    """radius: m, > 0."""

    radius: float
    user_data: int = field(default=0, kw_only=True)

    def _described(self) -> _core.Shape:
        return _shape(ShapeType.SPHERE, self)


@dataclass
class Box:
    """half_extents: m, > 0 along x, y, z."""

    half_extents: Vec3
    user_data: int = field(default=0, kw_only=True)

    def _described(self) -> _core.Shape:
        half_extents = numbers(self.half_extents, (3,), "Box.half_extents").tolist()
        return _shape(ShapeType.BOX, self, half_extents)


@dataclass
class Capsule:
    """radius: m, > 0. half_height: m, >= 0, of the segment along local y, without the caps."""

    radius: float
    half_height: float
    user_data: int = field(default=0, kw_only=True)

    def _described(self) -> _core.Shape:
        return _shape(ShapeType.CAPSULE, self)


@dataclass
class Cylinder:
    """radius, half_height: m, > 0; along local y."""

    radius: float
    half_height: float
    user_data: int = field(default=0, kw_only=True)

    def _described(self) -> _core.Shape:
        return _shape(ShapeType.CYLINDER, self)


@dataclass
class ConvexHull:
    """The hull of vertices (n x 3, m): at least 4, not all in one plane."""

    vertices: ArrayLike
    user_data: int = field(default=0, kw_only=True)

    def _described(self) -> _core.Shape:
        shape = _shape(ShapeType.CONVEX_HULL, self)
        shape.set_vertices(numbers(self.vertices, (-1, 3), "ConvexHull.vertices"))
        return shape


@dataclass
class TriangleMesh:
    """vertices: n x 3, m. triangles: m x 3 indices of vertices, counter-clockwise seen from outside.
    materials, triangle_materials: for each triangle the number of its material, or -1: that of the body."""

    vertices: ArrayLike
    triangles: ArrayLike
    materials: Sequence[Material] = field(default=(), kw_only=True)
    triangle_materials: ArrayLike = field(default=(), kw_only=True)
    user_data: int = field(default=0, kw_only=True)

    def _described(self) -> _core.Shape:
        corners = np.asarray(self.triangles)
        if corners.dtype.kind not in "iu" or corners.ndim != 2 or corners.shape[1] != 3:
            raise ValueError(
                "TriangleMesh.triangles must be n x 3 whole numbers, not " f"{corners.dtype} of shape {corners.shape}"
            )
        if corners.size and (corners.min() < 0 or corners.max() >= 1 << 32):
            raise ValueError(
                f"TriangleMesh.triangles has the index {corners.min() if corners.min() < 0 else corners.max()}; "
                "indices are 0 to the number of vertices less 1"
            )
        shape = _shape(ShapeType.TRIANGLE_MESH, self)
        shape.set_vertices(numbers(self.vertices, (-1, 3), "TriangleMesh.vertices"))
        shape.set_triangles(np.ascontiguousarray(corners, np.uint32))
        _give_materials(shape, self, len(corners))
        return shape


@dataclass
class HeightField:
    """heights: rows x columns, m: y of the point at x = column * spacing[0], z = row * spacing[1], about the middle.
    spacing: m, > 0, along x and z.
    materials, triangle_materials: for each triangle the number of its material, or -1: that of the body. Two a cell,
    cell by cell along x, row by row; of each cell first the triangle at its corner (row, column)."""

    heights: ArrayLike
    spacing: Tuple[float, float]
    materials: Sequence[Material] = field(default=(), kw_only=True)
    triangle_materials: ArrayLike = field(default=(), kw_only=True)
    user_data: int = field(default=0, kw_only=True)

    def _described(self) -> _core.Shape:
        shape = _shape(ShapeType.HEIGHT_FIELD, self)
        x, z = numbers(self.spacing, (2,), "HeightField.spacing").tolist()
        heights = numbers(self.heights, (-1, -1), "HeightField.heights")
        shape.set_heights(heights, x, z)
        _give_materials(shape, self, 2 * max(0, heights.shape[0] - 1) * max(0, heights.shape[1] - 1))
        return shape


@dataclass
class Plane:
    """The half space y <= 0 of the local frame; static bodies only."""

    user_data: int = field(default=0, kw_only=True)

    def _described(self) -> _core.Shape:
        return _shape(ShapeType.PLANE, self)


@dataclass
class Material:
    """Coulomb friction (>= 0), Newton's restitution (0..1), surface_velocity (m/s in the body's frame, for conveyors).
    A pair of bodies has sqrt(friction_a * friction_b) and max(restitution_a, restitution_b)."""

    friction: float = 0.5
    restitution: float = 0.0
    surface_velocity: Vec3 = (0.0, 0.0, 0.0)

    def _row(self) -> Tuple[float, float, Tuple[float, ...]]:
        return (
            self.friction,
            self.restitution,
            tuple(numbers(self.surface_velocity, (3,), "Material.surface_velocity").tolist()),
        )


@dataclass
class Child:
    """A part of a compound: a shape of the world, not itself a compound, plane, mesh or height field, and where it is.
    material: None is the body's."""

    shape: Handle
    position: Vec3 = (0.0, 0.0, 0.0)
    orientation: Vec3 = (0.0, 0.0, 0.0, 1.0)
    material: Optional[Material] = None


@dataclass
class Compound:
    """children: shapes that move as one."""

    children: Sequence[Child]
    user_data: int = field(default=0, kw_only=True)

    def _described(self) -> _core.Shape:
        rows = np.zeros(len(self.children), _core.compound_child)
        for i, child in enumerate(self.children):
            one = rows[i : i + 1]
            one["shape"] = handle(child.shape, f"Compound.children[{i}].shape")
            fill(one, "position", child.position, f"Compound.children[{i}].position")
            fill(one, "orientation", child.orientation, f"Compound.children[{i}].orientation")
            if child.material is not None:
                one["has_material"] = 1
                one["material"] = child.material._row()
        shape = _shape(ShapeType.COMPOUND, self)
        shape.set_children(rows)
        return shape


ShapeDesc = Union[Sphere, Box, Capsule, Cylinder, ConvexHull, TriangleMesh, HeightField, Plane, Compound]
"""What World.create_shape takes."""


def described_shapes(shapes: Sequence[ShapeDesc]) -> List[_core.Shape]:
    """What World.create_shapes hands to the backend."""
    for i, shape in enumerate(shapes):
        if not hasattr(shape, "_described"):
            raise TypeError(f"shapes[{i}] must be a Sphere, Box or another shape, not {shape!r}")
    return [shape._described() for shape in shapes]
