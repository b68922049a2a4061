"""What a failed call raises."""

from __future__ import annotations

from enum import IntEnum


class Result(IntEnum):
    """PlumbResult: why a call failed."""

    OK = 0
    TRUNCATED = 1
    GROWN = 2
    COPIED = 3
    INVALID_ARGUMENT = -1
    STALE_HANDLE = -2
    UNSUPPORTED = -3
    NOT_DECLARED = -4
    OUT_OF_MEMORY = -5
    WRONG_PHASE = -6
    WRONG_THREAD = -7
    VERSION = -8
    EXCLUDED = -9
    IN_USE = -10
    CORRUPT = -11
    INTERNAL = -12
    WORLD_LOST = -13
    DEVICE_LOST = -14


class Error(RuntimeError):
    """A call that a backend refused, with the backend's own sentence. Nothing has changed then, except after WORLD_LOST
    and DEVICE_LOST, when the world can only be closed.

    >>> import plumb
    >>> try:
    ...     plumb.open("impulse").world(needs=["collision"]).destroy_bodies(7)
    ... except plumb.Error as error:
    ...     print(error.name)
    STALE_HANDLE
    """

    code: int
    """A Result, below 0."""

    def __init__(self, code: int, text: str) -> None:
        super().__init__(text)
        self.code = Result(code) if code in Result._value2member_map_ else code

    @property
    def name(self) -> str:
        """The code's word: "STALE_HANDLE"."""
        return self.code.name if isinstance(self.code, Result) else f"UNKNOWN_{self.code}"
