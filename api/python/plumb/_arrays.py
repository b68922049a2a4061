"""What callers give, as the arrays that plumb._core takes, or errors that name the thing, its value and the remedy."""

from __future__ import annotations

import operator
from typing import Any, Iterable, Optional, SupportsIndex, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

Handle = SupportsIndex
"""A shape, body or joint: a number that its world gave; 0 is none. An int or a NumPy integer."""
Handles = Union[NDArray[np.uint64], Iterable[Handle]]

Floats = NDArray[np.floating[Any]]


def unsigned(value: SupportsIndex, what: str, bits: int = 64) -> int:
    """A whole number of so many bits."""
    try:
        whole = operator.index(value)
    except TypeError:
        raise TypeError(f"{what} must be a whole number, not {value!r}") from None
    if not 0 <= whole < 1 << bits:
        raise ValueError(f"{what} must be 0 to 2**{bits} - 1, not {whole}")
    return whole


def handle(value: Handle, what: str) -> int:
    """One handle."""
    try:
        return unsigned(value, what)
    except TypeError:
        raise TypeError(f"{what} must be a handle, a whole number that the world gave, not {value!r}") from None


def number(value: Any, what: str) -> float:
    """One real number."""
    if isinstance(value, (str, bytes)):
        raise TypeError(f"{what} must be a number, not {value!r}")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{what} must be a number, not {value!r}") from None


def handles(value: Union[Handle, Handles], what: str) -> NDArray[np.uint64]:
    """Handles as one row; of a single one, a row of length 1."""
    if isinstance(value, np.ndarray):
        if value.dtype != np.uint64 or value.ndim > 1:
            raise TypeError(
                f"{what} must be a row of uint64 handles, not {value.dtype} of shape {value.shape}; "
                "use the arrays that the world gave"
            )
        return np.ascontiguousarray(value).reshape(-1)
    if isinstance(value, SupportsIndex):
        return np.array([handle(value, what)], np.uint64)
    try:
        each = list(value)
    except TypeError:
        raise TypeError(f"{what} must be a handle or handles, not {value!r}") from None
    return np.array([handle(one, what) for one in each], np.uint64)


def is_single(value: object) -> bool:
    """Whether it is one handle and not a row of them."""
    return isinstance(value, SupportsIndex) and not (isinstance(value, np.ndarray) and value.ndim == 1)


def one_row(table: Floats) -> Floats:
    """The only row of a table."""
    return table.reshape(-1)


def numbers(value: ArrayLike, shape: Tuple[int, ...], what: str) -> NDArray[np.float64]:
    """Float64 numbers of a shape, -1 standing for any length, without gaps."""
    array = as_floats(value, what)
    if array.ndim != len(shape) or any(want not in (-1, have) for want, have in zip(shape, array.shape)):
        wanted = " x ".join("n" if length == -1 else str(length) for length in shape)
        raise ValueError(f"{what} must be {wanted} numbers, not an array of shape {array.shape}")
    return np.ascontiguousarray(array, np.float64)


def as_floats(value: ArrayLike, what: str) -> Floats:
    """Float32 stays as it is; whatever else has real numbers becomes float64."""
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiub":
            raise TypeError
        return array if array.dtype == np.float32 else np.asarray(array, np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"{what} must be real numbers, not {value!r}") from None


def rows(value: ArrayLike, count: Optional[int], columns: int, what: str) -> Floats:
    """So many rows of numbers; one row stands for all."""
    array = as_floats(value, what)
    if array.ndim == 1 and count is not None:
        array = array[np.newaxis]
    if array.ndim != 2 or array.shape[1] != columns or (count is not None and array.shape[0] not in (1, count)):
        wanted = "n" if count is None else str(count)
        raise ValueError(f"{what} must be {wanted} x {columns} numbers, not an array of shape {np.shape(value)}")
    if count is not None and array.shape[0] != count:
        array = np.broadcast_to(array, (count, columns))
    return np.ascontiguousarray(array)


def rows_for_output(out: Floats, count: Optional[int], columns: int, what: str) -> Floats:
    """An array of the caller's that is written to in place: no copy may stand in for it."""
    if not isinstance(out, np.ndarray) or out.dtype not in (np.float64, np.float32):
        raise TypeError(f"{what} must be a NumPy array of float64 or float32, not {getattr(out, 'dtype', out)!r}")
    if out.ndim != 2 or out.shape[1] != columns or (count is not None and out.shape[0] != count):
        wanted = "n" if count is None else str(count)
        raise ValueError(f"{what} must be of shape ({wanted}, {columns}), not {out.shape}")
    if not out.flags.writeable:
        raise ValueError(f"{what} is read only; give an array that may be written")
    return out


def fill(table: NDArray[np.void], column: str, values: Any, what: str) -> None:
    """Writes a column of a structured array: one value for all rows, or one for each."""
    try:
        table[column] = values
    except (TypeError, ValueError, OverflowError) as error:
        takes = table.dtype[column].shape
        wanted = f"{takes[0]} numbers" if takes else "one number"
        raise ValueError(
            f"{what} must be {wanted}, or as many for each of {len(table)}, not {values!r}: {error}"
        ) from None
