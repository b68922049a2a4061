"""plumb.queries/1, plumb.closest/1 and plumb.collide/1: rays, shape casts, overlaps, the closest bodies and pairs of
posed shapes, always in batches.

>>> import plumb
>>> world = plumb.open("impulse").world(needs=["collision", "friction", "queries"])
>>> wall = world.create_body(plumb.BodyDesc(world.create_shape(plumb.Box((1, 9, 9))), "static", position=(6, 0, 0)))
>>> hits = world.queries.rays([(0, 0, 0), (0, 0, 0)], [(10, 0, 0), (-10, 0, 0)])
>>> float(hits["fraction"][0]), bool(hits["body"][0] == wall), int(hits["body"][1])
(0.5, True, 0)
>>> near = world.queries.closest(world.create_shape(plumb.Sphere(0.5)), [(0, 0, 0), (0, 30, 0)], 10)
>>> float(near["distance"][0]), bool(near["body"][0] == wall), int(near["body"][1])
(4.5, True, 0)
>>> inside = world.queries.penetrations(world.create_shape(plumb.Sphere(0.5)), (4.75, 0, 0))
>>> round(float(inside["depth"][0]), 6), round(float(inside["normal"][0, 0]), 6)
(0.25, -1.0)
>>> world.close()
"""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Handle, Handles, fill, handles
from ._words import pick
from .bodies import Filter
from .enums import HitMode

Shapes = Union[Handle, Handles]
IDENTITY = (0.0, 0.0, 0.0, 1.0)


def _table(dtype: np.dtype[np.void], **columns: Any) -> NDArray[np.void]:
    """A structured array of as many rows as the longest column; a single value stands for all rows."""
    arrays = {name: np.asarray(values) for name, values in columns.items()}
    lengths = {name: array.shape[0] for name, array in arrays.items() if array.ndim > len(dtype[name].shape)}
    count = max(lengths.values(), default=1)
    for name, length in lengths.items():
        if length not in (1, count):
            raise ValueError(
                f"{name} has {length} rows, where {max(lengths, key=lambda one: lengths[one])} has {count}"
            )
    table = np.zeros(count, dtype)
    for name, array in arrays.items():
        fill(table, name, array, name)
    return table


def _filtered(table: NDArray[np.void], which: Optional[Filter]) -> NDArray[np.void]:
    fill(table, "filter", (which or Filter())._row(), "filter")
    return table


class Queries:
    """Questions to a world as the last step left it: `world.queries`. Any number of threads may ask at once, while none
    steps. Answers are structured arrays with columns body (0: nothing), query (index into the batch), child, fraction
    (of the translation), position, normal. Sensors are not seen."""

    def __init__(self, core: _core.World) -> None:
        self._core = core

    def rays(
        self,
        origins: ArrayLike,
        translations: ArrayLike,
        mode: Union[HitMode, str] = HitMode.CLOSEST,
        filter: Optional[Filter] = None,
    ) -> NDArray[np.void]:
        """origins, translations: n x 3, m; a single row stands for all. mode closest: one row a ray; all: all hits, by
        ray, then fraction."""
        table = _filtered(_table(_core.ray, origin=origins, translation=translations), filter)
        return self._core.cast_rays(pick(HitMode, mode, "mode"), table)

    def casts(
        self,
        shapes: Shapes,
        positions: ArrayLike,
        translations: ArrayLike,
        orientations: ArrayLike = IDENTITY,
        mode: Union[HitMode, str] = HitMode.CLOSEST,
        filter: Optional[Filter] = None,
    ) -> NDArray[np.void]:
        """Convex shapes moved without turning. One that overlaps at its start hits at fraction 0."""
        table = _table(
            _core.cast,
            shape=handles(shapes, "shapes"),
            position=positions,
            orientation=orientations,
            translation=translations,
        )
        return self._core.cast_shapes(pick(HitMode, mode, "mode"), _filtered(table, filter))

    def turning_casts(
        self,
        shapes: Shapes,
        positions: ArrayLike,
        translations: ArrayLike,
        rotations: ArrayLike,
        orientations: ArrayLike = IDENTITY,
        mode: Union[HitMode, str] = HitMode.CLOSEST,
        filter: Optional[Filter] = None,
    ) -> NDArray[np.void]:
        """Convex shapes that turn on their way, about their positions. rotations: n x 3, rad, world axes, each at most
        2 pi long; fraction is that of translation and rotation alike, of which one may be 0."""
        table = _table(
            _core.turning_cast,
            shape=handles(shapes, "shapes"),
            position=positions,
            orientation=orientations,
            translation=translations,
            rotation=rotations,
        )
        return self._core.turning_casts(pick(HitMode, mode, "mode"), _filtered(table, filter))

    def overlaps(
        self, shapes: Shapes, positions: ArrayLike, orientations: ArrayLike = IDENTITY, filter: Optional[Filter] = None
    ) -> NDArray[np.void]:
        """All bodies that each shape overlaps."""
        table = _table(_core.overlap, shape=handles(shapes, "shapes"), position=positions, orientation=orientations)
        return self._core.overlap_shapes(_filtered(table, filter))

    def penetrations(
        self, shapes: Shapes, positions: ArrayLike, orientations: ArrayLike = IDENTITY, filter: Optional[Filter] = None
    ) -> NDArray[np.void]:
        """All bodies that each shape overlaps, by shape, then depth, the deepest first. Columns body, query, child, depth
        (m: how far the shape moves along normal until it only touches), position (of the deepest contact), normal (from
        the body to the shape: the way out)."""
        table = _table(_core.overlap, shape=handles(shapes, "shapes"), position=positions, orientation=orientations)
        return self._core.penetrations(_filtered(table, filter))

    def closest(
        self,
        shapes: Shapes,
        positions: ArrayLike,
        most_distance: ArrayLike,
        orientations: ArrayLike = IDENTITY,
        mode: Union[HitMode, str] = HitMode.CLOSEST,
        filter: Optional[Filter] = None,
    ) -> NDArray[np.void]:
        """Bodies near convex shapes: plumb.closest/1. most_distance: m, above 0; what is further away is not looked
        for. mode closest: one row a shape; all: a row for each body, by shape, then distance. Columns body (0: nothing
        is near), probe (index into the batch), child, distance (m; 0 where they touch or overlap), on_probe and on_body
        (the points of both surfaces, m), normal (from the shape to the body); the last three are NaN where distance is
        0."""
        table = _table(
            _core.probe,
            shape=handles(shapes, "shapes"),
            position=positions,
            orientation=orientations,
            most_distance=most_distance,
        )
        return self._core.closest_bodies(pick(HitMode, mode, "mode"), _filtered(table, filter))


class Collided(NamedTuple):
    """results: distance (m; negative: depth; NaN where apart and not told), first_point, point_count of each pair.
    points: position, normal (from a to b), depth, feature."""

    results: NDArray[np.void]
    points: NDArray[np.void]


class Collide:
    """Collision without a step: `world.collide`."""

    def __init__(self, core: _core.World) -> None:
        self._core = core

    def pairs(
        self,
        shapes_a: Shapes,
        shapes_b: Shapes,
        positions_a: ArrayLike,
        positions_b: ArrayLike,
        orientations_a: ArrayLike = IDENTITY,
        orientations_b: ArrayLike = IDENTITY,
    ) -> Collided:
        """Contacts and distances of posed shapes, pair by pair; a single row stands for all."""
        table = _table(
            _core.posed_pair,
            shape_a=handles(shapes_a, "shapes_a"),
            shape_b=handles(shapes_b, "shapes_b"),
            position_a=positions_a,
            position_b=positions_b,
            orientation_a=orientations_a,
            orientation_b=orientations_b,
        )
        return Collided(*self._core.collide_pairs(table))


class Debug:
    """plumb.debug/1, what the engine saw in the last step: `world.debug`. Structured arrays; an Error of UNSUPPORTED
    where the engine cannot show it."""

    def __init__(self, core: _core.World) -> None:
        self._core = core

    def pairs(self) -> NDArray[np.void]:
        """Candidates of the broad phase: body_a, body_b."""
        return self._core.debug_pairs()

    def boxes(self) -> NDArray[np.void]:
        """Of the broad phase's trees: lower, upper, body (0: inner node), depth, tree."""
        return self._core.debug_boxes()

    def axes(self) -> NDArray[np.void]:
        """Of least overlap, or separating: body_a, body_b, axis, separation."""
        return self._core.debug_axes()

    def bodies(self) -> NDArray[np.void]:
        """Every body once: body, island (-1: none), asleep."""
        return self._core.debug_bodies()

    def constraints(self) -> NDArray[np.void]:
        """What the solver had to satisfy: body_a, body_b, joint (0: contacts), colour (-1: one by one)."""
        return self._core.debug_constraints()
