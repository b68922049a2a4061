"""Enumerations by their words."""

from __future__ import annotations

from enum import IntEnum, IntFlag
from typing import Iterable, Type, TypeVar, Union

from . import _core

Choice = TypeVar("Choice", bound=IntEnum)
Bits = TypeVar("Bits", bound=IntFlag)


def _words(kind: type[IntEnum] | type[IntFlag]) -> list[str]:
    return [word.lower() for word in kind.__members__]


def pick(kind: Type[Choice], value: Union[Choice, str, int], what: str) -> Choice:
    """The member that a word or number names.

    >>> from plumb.enums import Motion
    >>> pick(Motion, "static", "motion")
    <Motion.STATIC: 0>
    >>> pick(Motion, "statik", "motion")
    Traceback (most recent call last):
    ValueError: motion "statik" is unknown; did you mean "static"?
    """
    if isinstance(value, str):
        if value.upper() not in kind.__members__:
            raise ValueError(f'{what} "{value}" is unknown{_core.suggestion(value, _words(kind))}')
        return kind[value.upper()]
    try:
        return kind(value)
    except ValueError:
        raise ValueError(f"{what} {value!r} is unknown; known are {', '.join(_words(kind))}") from None


def pick_bits(kind: Type[Bits], value: Union[Bits, str, int, Iterable[Union[Bits, str]]], what: str) -> Bits:
    """The members that a word, words or bits name, as one.

    >>> from plumb.enums import Lock
    >>> int(pick_bits(Lock, ["linear_x", Lock.ANGULAR_Z], "locks"))
    33
    """
    if isinstance(value, str):
        if value.upper() not in kind.__members__:
            raise ValueError(f'{what} "{value}" is unknown{_core.suggestion(value, _words(kind))}')
        return kind[value.upper()]
    if isinstance(value, int):
        known = sum(kind.__members__.values())
        if value & ~known or value < 0:
            raise ValueError(f"{what} {value:#x} has bits beyond {known:#x}; use the members of {kind.__name__}")
        return kind(value)
    together = kind(0)
    for one in value:
        together |= pick_bits(kind, one, what)
    return together
