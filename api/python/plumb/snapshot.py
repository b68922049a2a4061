"""plumb.snapshot/1 and plumb.exceptions/1: a world's state as bytes and as a hash, and pairs that do not touch.

>>> import plumb
>>> world = plumb.open("impulse").world(needs=["snapshot"])
>>> body = world.create_body(plumb.BodyDesc(mass=1, flags="no_rotation", material=plumb.Material(friction=0)))
>>> saved, before = world.snapshot.save(), world.snapshot.hash()
>>> _ = world.step(1 / 60)
>>> world.snapshot.hash() == before
False
>>> world.snapshot.restore(saved)
>>> world.snapshot.hash() == before
True

Of the whole world, bodies and joints that come and go:

>>> whole = world.snapshot.save_world()
>>> world.destroy_bodies(body)
>>> other = world.create_body(plumb.BodyDesc(mass=2, flags="no_rotation", material=plumb.Material(friction=0)))
>>> world.snapshot.restore(whole)
>>> world.bodies.tolist() == [body], world.snapshot.hash() == before
(True, True)
>>> world.close()
"""

from __future__ import annotations

from typing import Iterable, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arrays import Handle, handles


class Snapshot:
    """What moves, or the whole world, saved and restored: `world.snapshot`."""

    def __init__(self, core: _core.World) -> None:
        self._core = core

    def save(self) -> bytes:
        """Poses, velocities, sleep, warm-start data and excluded pairs, for the world that saved them. Needs
        snapshot."""
        return self._core.save(whole=False)

    def save_world(self) -> bytes:
        """Also who lives, and of what: bodies and joints that come, go or become others later are undone by restore,
        which also takes these bytes into another world of the same needs and the same shapes. Needs snapshot."""
        return self._core.save(whole=True)

    def restore(self, data: bytes) -> None:
        """Of either kind; an Error of CORRUPT for other bytes, and for what save gave when other bodies lived."""
        if not isinstance(data, bytes):
            raise TypeError(f"restore takes the bytes that save gave, not {type(data).__name__}")
        self._core.restore(data)

    def hash(self) -> int:
        """64 bits over all poses and velocities in order of creation."""
        return self._core.hash()


Pairs = Union[NDArray[np.uint64], Iterable[Tuple[Handle, Handle]]]


class Exceptions:
    """Excluded pairs, bodies that do not touch whatever their filters say: `world.exceptions`."""

    def __init__(self, core: _core.World) -> None:
        self._core = core

    def exclude(self, pairs: Pairs) -> None:
        """From the next step on each two do not touch. All or none."""
        self._core.set_exceptions(_pair_rows(pairs), False)

    def allow(self, pairs: Pairs) -> None:
        """They touch again as their filters say."""
        self._core.set_exceptions(_pair_rows(pairs), True)

    def list(self) -> NDArray[np.uint64]:
        """n x 2 handles, the lower slot of each first."""
        rows = self._core.list_exceptions()
        return np.stack([rows["body_a"], rows["body_b"]], axis=1)


def _pair_rows(pairs: Pairs) -> NDArray[np.void]:
    flat = []
    for i, pair in enumerate(pairs):
        two = handles(pair, f"pairs[{i}]")
        if len(two) != 2:
            raise ValueError(f"pairs[{i}] must be two bodies, not {pair!r}")
        flat.append(tuple(two))
    return np.array(flat, _core.body_pair)
