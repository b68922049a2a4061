"""plumb.settings/1: an engine's knobs by name.

>>> import plumb
>>> world = plumb.open("impulse").world(needs=["rotation"], settings={"substeps": 4})
>>> world.settings["substeps"]
4
>>> world.settings["solver"] = "xpbd"
>>> world.settings["substep"]
Traceback (most recent call last):
KeyError: 'impulse has no setting "substep"; did you mean "substeps"?'
>>> world.close()
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Mapping, Tuple, Union

from . import _core
from .enums import SettingRole, SettingType

Value = Union[bool, int, float, str]


@dataclass(frozen=True)
class SettingInfo:
    """What a backend says of one of its settings."""

    name: str
    unit: str
    """"m", "1", "m/s"; "" for bool and choice."""
    doc: str
    type: SettingType
    role: SettingRole
    creation_only: bool
    """Only by Backend.world(settings=...)."""
    choices: List[str]
    minimum: float
    """Of int and float, both allowed."""
    maximum: float
    default: Value


class KnownSettings(Dict[str, SettingInfo]):
    """A backend's settings by name, which say so when asked for another."""

    def __init__(self, backend: str, facts: List[Dict[str, Any]]) -> None:
        super().__init__()
        self._backend = backend
        for fact in facts:
            fact = {**fact, "type": SettingType(fact["type"]), "role": SettingRole(fact["role"])}
            self[fact["name"]] = SettingInfo(**fact)

    def __missing__(self, name: str) -> SettingInfo:
        raise KeyError(f'{self._backend} has no setting "{name}"{_core.suggestion(name, list(self))}')

    def encoded(self, name: str, value: Value) -> Tuple[SettingType, float, str]:
        """As PlumbSettingValue; whether it is in range is for the backend to say."""
        info = self[name]
        if info.type == SettingType.CHOICE:
            if not isinstance(value, str):
                raise TypeError(f"the setting {name} must be one of {', '.join(info.choices)}, not {value!r}")
            return info.type, 0.0, value
        whole = info.type in (SettingType.BOOL, SettingType.INT)
        try:
            number = float(value)
            if isinstance(value, str) or (whole and number != int(number)):
                raise ValueError
        except (TypeError, ValueError, OverflowError):
            raise TypeError(f"the setting {name} must be of type {info.type.name.lower()}, not {value!r}") from None
        return info.type, number, ""


class Settings(Mapping[str, Value]):
    """The values in force in a world, by name: `world.settings`. Assigning takes effect in the next step."""

    def __init__(self, core: _core.World, known: KnownSettings) -> None:
        self._core = core
        self._known = known

    def __getitem__(self, name: str) -> Value:
        kind = self._known[name].type
        number, word = self._core.get_setting(name)
        if kind == SettingType.CHOICE:
            return word
        if kind == SettingType.FLOAT:
            return number
        return bool(number) if kind == SettingType.BOOL else int(number)

    def __setitem__(self, name: str, value: Value) -> None:
        self._core.set_setting(name, *self._known.encoded(name, value))

    def __iter__(self) -> Iterator[str]:
        return iter(self._known)

    def __len__(self) -> int:
        return len(self._known)

    def __repr__(self) -> str:
        return f"Settings({dict(self)})"
