"""A world: bodies and shapes, their rows of numbers, steps, and what comes out of steps."""

from __future__ import annotations

from types import TracebackType
from typing import TYPE_CHECKING, Callable, List, Optional, Sequence, Type, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import (
    Floats,
    Handle,
    Handles,
    handle,
    handles,
    is_single,
    number,
    numbers,
    one_row,
    rows,
    rows_for_output,
)
from ._words import pick
from .bodies import BodyDesc, described_bodies
from .enums import Field
from .joints import Joints
from .queries import Collide, Debug, Queries
from .modify import Modify
from .report import StepReport
from .settings import Settings
from .shapes import ShapeDesc, Vec3, described_shapes
from .snapshot import Exceptions, Snapshot
from .state import State

if TYPE_CHECKING:
    from .backend import Backend


Bytes = Union[bytes, bytearray, memoryview]
ModifyContacts = Callable[["NDArray[np.void]", "NDArray[np.void]"], object]


class World:
    """A world of a backend, which Backend.world makes. Close it, or use it in a `with`; it is also closed when nobody
    has it any more. Its handles are numbers, of shapes, bodies and joints; those of destroyed objects are stale for
    ever.

    Calls raise Error with the backend's sentence and change nothing then; ValueError or TypeError when an argument is
    none that the call could take, and ValueError once the world is closed. One thread at a time may call (queries: any
    number while none steps): another one is an Error of WRONG_THREAD. Other threads of Python run during steps and
    queries.
    """

    def __init__(self, backend: Backend, core: _core.World) -> None:
        self._core = core
        self.backend = backend
        self.joints = Joints(core)
        self.queries = Queries(core)
        self.collide = Collide(core)
        self.debug = Debug(core)
        self.modify = Modify(core)
        self.settings = Settings(core, backend.settings)
        self.snapshot = Snapshot(core)
        self.exceptions = Exceptions(core)
        self.state = State(core)

    # --- life ---------------------------------------------------------------------------------------------------------

    def close(self) -> None:
        """Destroys the world, its shapes, bodies and joints; rows that are lent live on. May be called again."""
        self._core.close()

    @property
    def closed(self) -> bool:
        """Whether close was called."""
        return self._core.closed

    def __enter__(self) -> World:
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<World of {self.backend.info.name}{', closed' if self.closed else ''}>"

    # --- shapes and bodies --------------------------------------------------------------------------------------------

    def create_shape(self, shape: ShapeDesc) -> int:
        """Makes a shape (Sphere, Box, ...) and gives its handle."""
        return int(self.create_shapes([shape])[0])

    def create_shapes(self, shapes: Sequence[ShapeDesc]) -> NDArray[np.uint64]:
        """All or none. Gives their handles."""
        return self._core.create_shapes(described_shapes(shapes))

    def create_cooked(self, shapes: Sequence[Bytes]) -> NDArray[np.uint64]:
        """As create_shapes, of what Backend.cook of this backend gave: the bytes, or a memoryview of a file that has
        them. All or none. Bytes that are torn, changed or of another backend are an Error of
        CORRUPT."""
        return self._core.create_cooked(shapes)

    def destroy_shapes(self, shapes: Union[Handle, Handles]) -> None:
        """One or many; all or none. A shape that a body or compound still uses is an Error of IN_USE."""
        self._core.destroy_shapes(handles(shapes, "shapes"))

    def create_body(self, desc: BodyDesc) -> int:
        """Makes a body and gives its handle."""
        return int(self.create_bodies([desc])[0])

    def create_bodies(self, descs: Union[NDArray[np.void], Sequence[BodyDesc]]) -> NDArray[np.uint64]:
        """BodyDescs, or rows of body_rows, which need no loop. All or none. Gives their handles."""
        return self._core.create_bodies(described_bodies(descs))

    def destroy_bodies(self, bodies: Union[Handle, Handles]) -> None:
        """One or many; all or none. A body that still has joints is an Error of IN_USE."""
        self._core.destroy_bodies(handles(bodies, "bodies"))

    @property
    def bodies(self) -> NDArray[np.uint64]:
        """The living, in order of creation."""
        return self._core.bodies()

    def user_data(self, body: Handle) -> int:
        """What BodyDesc.user_data said."""
        return self._core.user_data(handle(body, "body"))

    # --- rows ---------------------------------------------------------------------------------------------------------

    def read(
        self, field: Union[Field, str], bodies: Union[Handle, Handles, None] = None, out: Optional[Floats] = None
    ) -> Floats:
        """Rows of a field, one for each body: n x columns. bodies: None is all, in order of creation (with out, the
        first n); of a single handle its row comes back. out: an array of float64 or float32 that is filled and given
        back, its rows any distance apart: nothing is allocated then."""
        kind = pick(Field, field, "field")
        columns = _core.columns_of(kind)
        if bodies is None:
            into = np.empty((len(self.bodies), columns)) if out is None else rows_for_output(out, None, columns, "out")
            self._core.read(kind, None, into)
            return into
        ids = handles(bodies, "bodies")
        into = np.empty((len(ids), columns)) if out is None else rows_for_output(out, len(ids), columns, "out")
        self._core.read(kind, ids, into)
        return one_row(into) if out is None and is_single(bodies) else into

    def write(self, field: Union[Field, str], values: ArrayLike, bodies: Union[Handle, Handles, None] = None) -> None:
        """values: a row for each body, or one row for all of them. bodies: None is the first so many in order of
        creation, or all for one row. Poses and velocities are set; forces, torques and impulses add to what acts on
        the body."""
        kind = pick(Field, field, "field")
        columns = _core.columns_of(kind)
        if bodies is None:
            count = len(self.bodies) if np.ndim(values) == 1 else None
            self._core.write(kind, None, rows(values, count, columns, "values"))
            return
        ids = handles(bodies, "bodies")
        self._core.write(kind, ids, rows(values, len(ids), columns, "values"))

    def set_gravity(self, gravity: Vec3) -> None:
        """m/s2"""
        self._core.set_gravity(numbers(gravity, (3,), "gravity").tolist())

    # --- steps --------------------------------------------------------------------------------------------------------

    def step(self, dt: float, modify: Optional[ModifyContacts] = None) -> StepReport:
        """A step of dt seconds, from begin to end.

        modify(manifolds, changes) is called with what was found between bodies that have the flag modify_contacts,
        before it is solved; once for each part of a step that finds something. Columns of manifolds: body_a, body_b,
        child_a, child_b, point_count, normal (from a to b), velocity (of b against a), position (4 x 3), depth (4),
        friction, restitution, surface_velocity. changes is as long, for modify to write into: what (ContactChange; 0:
        nothing), friction, restitution, surface_velocity. Needs contact_modification.

        >>> import plumb
        >>> with plumb.open("impulse").world(["rotation", "collision", "friction", "contact_modification"]) as world:
        ...     ledge, box = world.create_shapes([plumb.Box((2, 0.1, 2)), plumb.Box((0.2, 0.2, 0.2))])
        ...     _ = world.create_body(plumb.BodyDesc(ledge, "static", flags="modify_contacts"))
        ...     body = world.create_body(plumb.BodyDesc(box, position=(0, -1, 0), linear_velocity=(0, 7, 0)))
        ...     def from_above(manifolds, changes):  # bodies rise through the ledge, and stand on it
        ...         falls = np.where(manifolds["body_b"] == body, 1, -1) * manifolds["velocity"][:, 1] < 0.01
        ...         changes["what"][~falls] = plumb.ContactChange.DISABLED
        ...     _ = [world.step(1 / 60, from_above) for _ in range(120)]
        ...     print(f"it stands at {world.read('pose', body)[1]:.2f} m")
        it stands at 0.30 m
        """
        if modify is None:
            return StepReport(self._core.step(number(dt, "dt")))
        self.begin_step(dt)
        try:
            while len(found := self._core.read_manifolds()) != 0:
                changes = np.zeros(len(found), _core.manifold_change)
                changes["manifold"] = np.arange(len(found))
                modify(found, changes)
                self._core.modify_manifolds(changes[changes["what"] != 0])
        finally:
            report = self.wait()
        return report

    def begin_step(self, dt: float) -> None:
        """Begins a step, which may go on by itself until wait(). Nothing else may be called before that."""
        self._core.begin_step(number(dt, "dt"))

    def wait(self) -> StepReport:
        """Ends the step that begin_step began."""
        return StepReport(self._core.wait())

    def contacts(self) -> NDArray[np.void]:
        """Contact points as the last step solved them: columns body_a, body_b, child_a, child_b, position, normal
        (from a to b), depth, normal_impulse, tangent_impulse, feature. Needs contacts."""
        return self._core.contacts()

    def events(self) -> NDArray[np.void]:
        """What the last step began and ended: columns type (an EventType), body_a, body_b, joint. Needs events."""
        return self._core.events()
