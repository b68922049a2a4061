"""plumb.state/1: the engine's own rows of state, lent without a copy.

>>> import plumb
>>> world = plumb.open("impulse").world(needs=["collision", "friction"])
>>> ball = world.create_shape(plumb.Sphere(1))
>>> body = world.create_body(plumb.BodyDesc(ball, flags="no_rotation", position=(0, 5, 0)))
>>> poses = world.state.borrow("pose").numpy()
>>> bool(np.array_equal(poses, world.read("pose")))
True
>>> world.close()
>>> float(poses[0, 1])
5.0
"""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arrays import Floats
from ._words import pick
from .enums import Field

Dtype = Union[np.dtype[np.float64], np.dtype[np.float32]]


class RowMap(NamedTuple):
    """bodies: which body each lent row is, 0 for none. generation: changes whenever the map does."""

    bodies: NDArray[np.uint64]
    generation: int


class LentRows:
    """Rows that the engine lends, a row a body slot. They stay as they are until the next step or change of the world;
    borrow again after it. Whoever looks at them keeps their memory, also after the world is closed.

    On the host they are NumPy's (numpy()); on a GPU whoever speaks DLPack takes them: torch.from_dlpack(rows),
    cupy.from_dlpack(rows). Work that the consumer enqueues on its stream happens after the engine has written them; it
    must be done (synchronised) before the next step. Do not write to rows: consumers of DLPack before 1.0 cannot be
    told that they are read only."""

    def __init__(self, core: _core.LentRows) -> None:
        self._core = core

    @property
    def shape(self) -> Tuple[int, ...]:
        """Rows, columns; worlds before them where the rows are of all worlds (Worlds.borrow)."""
        return self._core.shape

    @property
    def dtype(self) -> Dtype:
        """The engine's own: float64 or float32."""
        return np.dtype(np.float64) if self._core.bits == 64 else np.dtype(np.float32)

    @property
    def read_only(self) -> bool:
        """Whether they may only be read."""
        return bool(self._core.flags & 1)

    @property
    def is_copy(self) -> bool:
        """Whether the engine could not lend them as they lie, and made a copy (copy=True)."""
        return bool(self._core.flags & 2)

    @property
    def address(self) -> int:
        """Of the first number, in the memory of the device."""
        return self._core.address

    @property
    def fence(self) -> Tuple[int, int]:
        """cudaStream_t and cudaEvent_t that tell when the rows may be read; (0, 0): now. By DLPack this is seen to."""
        return self._core.fence

    def numpy(self) -> Floats:
        """A view of the same memory. BufferError for rows on a GPU."""
        if self._core.device[0] != _core.host_device:
            raise BufferError(
                "the rows are on a GPU; take them by DLPack (torch.from_dlpack, cupy.from_dlpack), or "
                'borrow with device="cpu", copy=True'
            )
        return self._core.view()

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]:
        view = self.numpy()
        if dtype is not None and np.dtype(dtype) != view.dtype:
            if copy is False:
                raise ValueError(f"rows of {view.dtype} cannot be seen as {np.dtype(dtype)} without a copy")
            return view.astype(dtype)
        return view.copy() if copy else view

    def __dlpack__(
        self,
        *,
        stream: Optional[int] = None,
        max_version: Optional[Tuple[int, int]] = None,
        dl_device: Optional[Tuple[int, int]] = None,
        copy: Optional[bool] = None,
    ) -> object:
        if dl_device is not None and tuple(dl_device) != self._core.device:
            raise BufferError(f"the rows are on device {self._core.device} and are not moved to {tuple(dl_device)}")
        if copy:
            raise BufferError("rows are lent, not copied: copy what from_dlpack gives")
        return self._core.dlpack(stream, max_version)

    def __dlpack_device__(self) -> Tuple[int, int]:
        return self._core.device

    def __repr__(self) -> str:
        kind, number = self._core.device
        where = "cpu" if kind == _core.host_device else f"cuda:{number}"
        shape = " x ".join(str(length) for length in self.shape)
        return f"<LentRows {shape} {self.dtype} on {where}{', a copy' if self.is_copy else ''}>"


def device_number(device: str) -> int:
    """DLPack's, of the word for a device."""
    devices = {"cpu": _core.host_device, "cuda": _core.cuda_device}
    if device not in devices:
        raise ValueError(f'device "{device}" is unknown; use "cpu" or "cuda"')
    return devices[device]


class State:
    """Rows without a copy: `world.state`."""

    def __init__(self, core: _core.World) -> None:
        self._core = core

    def borrow(self, field: Union[Field, str], device: str = "cpu", copy: bool = False) -> LentRows:
        """Rows of the field pose (7 columns) or velocity (6). device: "cpu" or "cuda". copy: where the engine cannot
        lend them as they lie there, a copy instead of an Error of UNSUPPORTED."""
        return LentRows(_core.borrow(self._core, pick(Field, field, "field"), device_number(device), copy))

    def rows(self) -> RowMap:
        """Which body each lent row is."""
        return RowMap(*_core.row_map(self._core))
