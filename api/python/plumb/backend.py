"""Backends: which there are, what each is and can, and worlds of them.

>>> import plumb
>>> impulse = plumb.open("impulse")
>>> impulse.info.precision
'f32'
>>> impulse.capability("joint", "hinge").degree.name
'NATIVE'
>>> impulse.capability("pair", "triangle_mesh", "triangle_mesh").degree.name
'NONE'
>>> plumb.open("impuls")
Traceback (most recent call last):
plumb._errors.Error: no backend is called "impuls"; did you mean "impulse"?
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from enum import IntEnum, IntFlag
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, Mapping, NamedTuple, Optional, Tuple, Type, Union, cast

from . import _core
from ._arrays import numbers, unsigned
from ._errors import Error, Result
from ._words import pick, pick_bits
from .enums import (
    BodyMember,
    CapabilityKind,
    ContactChange,
    Degree,
    Determinism,
    EventType,
    Field,
    JointFeature,
    JointMember,
    JointType,
    Motion,
    Need,
    Phase,
    QueryKind,
    ShapeType,
)
from .settings import KnownSettings, Value
from .shapes import ShapeDesc, Vec3, described_shapes
from .world import World

EXTENSIONS = (
    "plumb.joints/1",
    "plumb.queries/1",
    "plumb.collide/1",
    "plumb.debug/1",
    "plumb.settings/1",
    "plumb.snapshot/1",
    "plumb.state/1",
    "plumb.exceptions/1",
    "plumb.modify/1",
    "plumb.manifolds/1",
    "plumb.worlds/1",
    "plumb.closest/1",
    "plumb.cooking/1",
)


class Modifiable(IntEnum):
    """What plumb.modify/1 changes."""

    BODIES = 0
    JOINTS = 1
    SHAPES = 2


def _by_index(bits: Type[IntFlag]) -> Type[IntEnum]:
    """The words of bits, numbered from 0: so capabilities are asked for them."""
    enumeration: Any = IntEnum
    return cast(Type[IntEnum], enumeration(bits.__name__, list(bits.__members__), start=0))


_ARGUMENTS: Dict[CapabilityKind, Tuple[Type[IntEnum], ...]] = {
    CapabilityKind.SHAPE: (ShapeType, Motion),
    CapabilityKind.PAIR: (ShapeType, ShapeType),
    CapabilityKind.JOINT: (JointType,),
    CapabilityKind.JOINT_FEATURE: (JointType, JointFeature),
    CapabilityKind.QUERY: (QueryKind, ShapeType),
    CapabilityKind.FIELD_READ: (Field,),
    CapabilityKind.FIELD_WRITE: (Field,),
    CapabilityKind.NEED: (_by_index(Need),),
    CapabilityKind.EVENT: (EventType,),
    CapabilityKind.PHASE_TIME: (Phase,),
    CapabilityKind.MODIFY: (Modifiable, _by_index(BodyMember)),
    CapabilityKind.MANIFOLD: (_by_index(ContactChange),),
    CapabilityKind.CLOSEST: (ShapeType,),
    CapabilityKind.TRIANGLE_MATERIAL: (ShapeType,),
    CapabilityKind.COOKING: (ShapeType,),
}
_JOINT_MEMBERS = _by_index(JointMember)


def _takes(kind: CapabilityKind, first: Union[IntEnum, str, None]) -> Tuple[Type[IntEnum], ...]:
    """The enumerations of a question's arguments, of which the first may decide about the second."""
    takes = _ARGUMENTS.get(kind, ())
    if kind == CapabilityKind.QUERY and first in (QueryKind.RAY, "ray"):
        return takes[:1]
    if kind == CapabilityKind.MODIFY and first in (Modifiable.JOINTS, "joints"):
        return (Modifiable, _JOINT_MEMBERS)
    if kind == CapabilityKind.MODIFY and first in (Modifiable.SHAPES, "shapes"):
        return (Modifiable, ShapeType)
    return takes


def _questions(kind: CapabilityKind) -> Iterator[Tuple[str, ...]]:
    """All arguments that a kind can be asked with, in words."""
    kinds = _ARGUMENTS.get(kind, ())
    if not kinds:
        yield ()
    for first in kinds[0].__members__ if kinds else ():
        second = _takes(kind, first.lower())[1:]
        if not second:
            yield (first.lower(),)
        for word in second[0].__members__ if second else ():
            yield (first.lower(), word.lower())


class FoundBackend(NamedTuple):
    """A backend on the search path, not opened."""

    name: str
    file: str


class Capability(NamedTuple):
    """How truly a backend has a thing, and a sentence on it, or ""."""

    degree: Degree
    note: str


@dataclass(frozen=True)
class BackendInfo:
    """What a backend is."""

    name: str
    version: str
    """Of the engine."""
    build: str
    """Changes whenever the results or times of this library may."""
    description: str
    device: str
    """"cpu" or the device's name."""
    exclusion_group: str
    """Two backends of one group cannot be open in one process; "" for none."""
    precision: str
    """"f32" or "f64"."""
    determinism: Determinism
    max_threads: int


class Backend:
    """An opened engine, which stays loaded until the process ends."""

    def __init__(self, core: _core.Backend) -> None:
        self._core = core
        facts = core.info()
        facts["determinism"] = Determinism(facts["determinism"])
        self.info = BackendInfo(**facts)
        self.file: str = core.file
        self.settings = KnownSettings(self.info.name, core.settings())
        """SettingInfo by name."""

    @property
    def extensions(self) -> Tuple[str, ...]:
        """Which of the interface's extensions it has: "plumb.joints/1"."""
        return tuple(name for name in EXTENSIONS if self._core.has_extension(name))

    def capability(self, kind: Union[CapabilityKind, str], *arguments: Union[IntEnum, str]) -> Capability:
        """How truly the engine has a thing: shape (type, motion), pair (type, type), joint (type), joint_feature (type,
        feature), query (kind, type of what is cast), field_read, field_write (field), need, event, phase_time (word),
        residual, snapshot, host_jobs, child_material (), modify ("bodies", BodyMember, "joints",
        JointMember or "shapes", ShapeType),
        manifold (ContactChange), triangle_material (type)."""
        which = pick(CapabilityKind, kind, "capability")
        takes = _takes(which, arguments[0] if arguments else None)
        if len(arguments) != len(takes):
            words = ", ".join(kind.__name__ for kind in takes) or "nothing"
            raise TypeError(f"the capability {which.name.lower()} is asked with {words}, not with {arguments!r}")
        asked = [int(pick(kind, value, kind.__name__)) for kind, value in zip(takes, arguments)]
        degree, note = self._core.capability(which, *(asked + [0, 0])[:2])
        return Capability(Degree(degree), note)

    def offered(self, wanted: Union[Need, str, Iterable[Union[Need, str]]]) -> Need:
        """Those of the needs that the engine has, if only approximately."""
        every = pick_bits(Need, wanted, "need")
        words = [word for word, bit in Need.__members__.items() if bit & every]
        return pick_bits(Need, [word for word in words if self.capability("need", word).degree != Degree.NONE], "need")

    def capabilities(self) -> Dict[Tuple[str, ...], Capability]:
        """All answers, by kind and arguments in words: {("joint", "hinge"): Capability(...)}."""
        answers: Dict[Tuple[str, ...], Capability] = {}
        for kind in CapabilityKind:
            for words in _questions(kind):
                answers[(kind.name.lower(), *words)] = self.capability(kind, *words)
        return answers

    def world(
        self,
        needs: Union[Need, str, Iterable[Union[Need, str]]],
        gravity: Vec3 = (0.0, -9.81, 0.0),
        threads: int = 1,
        settings: Optional[Mapping[str, Value]] = None,
        body_capacity: int = 0,
        contact_capacity: int = 0,
        joint_capacity: int = 0,
        wanted: Union[Need, str, Iterable[Union[Need, str]]] = (),
    ) -> World:
        """A world of this engine. needs: what the scene needs; using anything else is an Error of NOT_DECLARED, and a
        need that the engine lacks one of UNSUPPORTED. gravity: m/s2. settings: in force from the start. Capacities are
        hints; 0 is unknown. wanted: needs, too, but for those that the engine lacks."""
        given = [(name, *self.settings.encoded(name, value)) for name, value in (settings or {}).items()]
        capacities = [
            unsigned(body_capacity, "body_capacity", 32),
            unsigned(contact_capacity, "contact_capacity", 32),
            unsigned(joint_capacity, "joint_capacity", 32),
        ]
        core = self._core.world(
            int(pick_bits(Need, needs, "need") | self.offered(wanted)),
            numbers(gravity, (3,), "gravity").tolist(),
            unsigned(threads, "threads", 32),
            given,
            capacities,
        )
        return World(self, core)

    def cook(self, shape: ShapeDesc) -> bytes:
        """A shape worked out ahead, to be kept in a file and made by World.create_cooked of a world of this backend: in a
        build step, or on a thread that loads. The same shape gives the same bytes. Not of a Compound: cook its children.

        >>> import plumb
        >>> impulse = plumb.open("impulse")
        >>> hull = impulse.cook(plumb.ConvexHull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]))
        >>> with impulse.world(["rotation", "collision"]) as world:
        ...     shapes = world.create_cooked([hull])
        """
        return self._core.cook(described_shapes([shape])[0])

    def __repr__(self) -> str:
        return f"<Backend {self.info.name} {self.info.version}>"


def search_path() -> List[str]:
    """Folders in which backends are looked for: $PLUMB_BACKEND_PATH, lib/plumb beside this package's lib/python, and
    that of the Plumb that this package was installed for."""
    wanted = [folder for folder in os.environ.get("PLUMB_BACKEND_PATH", "").split(os.pathsep) if folder]
    wanted.append(str(Path(__file__).resolve().parents[2] / "plumb"))
    if _core.installed_prefix:
        wanted.append(str(Path(_core.installed_prefix, "lib", "plumb")))
    wanted += _core.backend_path()
    folders = [os.path.realpath(folder) for folder in wanted if os.path.isdir(folder)]
    return list(dict.fromkeys(folders))


def backends() -> List[FoundBackend]:
    """The backends on the search path, by name; the first of a name wins. None is opened."""
    found: Dict[str, FoundBackend] = {}
    for folder in search_path():
        for file in sorted(Path(folder).glob("plumb-*.so")):
            name = file.name[len("plumb-") : -len(".so")]
            found.setdefault(name, FoundBackend(name, str(file)))
    return sorted(found.values())


def open(name_or_file: Union[str, os.PathLike[str]]) -> Backend:
    """Opens a backend by name, or by file (anything with a slash, or ending in .so). Raises Error: INVALID_ARGUMENT
    (not found; names the nearest), VERSION (which side is too old), EXCLUDED (which open backend stands in the
    way)."""
    name = os.fspath(name_or_file)
    if os.sep in name or name.endswith(".so"):
        return Backend(_core.open_backend(os.path.abspath(name)))
    found = {one.name: one.file for one in backends()}
    if name not in found:
        hint = (
            _core.suggestion(name, list(found))
            if found
            else ("; none was found at all: set PLUMB_BACKEND_PATH to the folder that holds plumb-*.so")
        )
        raise Error(Result.INVALID_ARGUMENT, f'no backend is called "{name}"{hint}')
    return Backend(_core.open_backend(found[name]))
