"""Rigid-body physics engines behind one interface: Plumb's backends from Python.

A cube that falls on the ground:

>>> import plumb
>>> engine = plumb.open("impulse")  # a name that plumb.backends() lists, or a file
>>> with engine.world(needs=["rotation", "collision", "friction"]) as world:
...     ground, cube = world.create_shapes([plumb.Box((50, 0.5, 50)), plumb.Box((0.5, 0.5, 0.5))])  # half extents, m
...     _, body = world.create_bodies([plumb.BodyDesc(ground, "static", position=(0, -0.5, 0)),
...                                    plumb.BodyDesc(cube, position=(0, 3, 0))])
...     for _ in range(120):
...         report = world.step(1 / 60)
...     print(f"the cube rests at {world.read('pose', body)[1]:.2f} m")
the cube rests at 0.50 m

Units are SI, axes right-handed, orientations quaternions x y z w. A world declares what it needs; the engine leaves
out the rest. Handles are whole numbers, batches of them arrays of uint64; rows of poses and velocities, contacts,
events and hits are NumPy arrays. `world.joints`, `.queries`, `.collide`, `.settings`, `.snapshot`, `.state`,
`.exceptions`, `.modify` and `.debug` are the interface's extensions, and so is what step() takes. Where enumerations are taken, words are:
"dynamic" for plumb.Motion.DYNAMIC.

`plumb.Worlds` steps many worlds together. `plumb.harness` runs scenes, studies and reports by the program plumb.
"""

from . import harness
from ._core import interface_version
from ._errors import Error, Result
from .backend import Backend, BackendInfo, Capability, FoundBackend, backends, open, search_path
from .bodies import BodyDesc, Filter, body_rows
from .enums import (AxisMode, BodyFlag, BodyMember, CapabilityKind, ContactChange, Degree, Determinism, EventType,
                    Field, HitMode, JointFeature, JointField, JointMember, JointType, Lock, MassMode, Motion, Need,
                    Phase, QueryKind, Remark, SettingRole, SettingType, ShapeType, SpringMode)
from .joints import JointDesc, Joints, Limit, Motor, Spring, StiffSpring
from .modify import BodyChange, JointChange, Modify
from .queries import Collide, Collided, Debug, Queries
from .report import StepReport
from .settings import SettingInfo, Settings
from .shapes import (Box, Capsule, Child, Compound, ConvexHull, Cylinder, HeightField, Material, Plane, ShapeDesc,
                     Sphere, TriangleMesh)
from .snapshot import Exceptions, Snapshot
from .state import LentRows, RowMap, State
from .world import World
from .worlds import Worlds

__all__ = [
    "AxisMode", "Backend", "BackendInfo", "BodyChange", "BodyDesc", "BodyFlag", "BodyMember", "Box", "Capability",
    "CapabilityKind", "Capsule", "Child", "Collide", "Collided", "Compound", "ContactChange", "ConvexHull", "Cylinder",
    "Debug", "Degree", "Determinism", "Error", "EventType", "Exceptions", "Field", "Filter", "FoundBackend", "HeightField",
    "HitMode", "JointChange", "JointDesc", "JointFeature", "JointField", "JointMember", "JointType", "Joints",
    "LentRows", "Limit", "Lock", "MassMode", "Material", "Modify", "Motion", "Motor", "Need", "Phase", "Plane",
    "Queries", "QueryKind", "Remark", "Result", "RowMap", "SettingInfo", "SettingRole", "SettingType", "Settings",
    "ShapeDesc", "ShapeType", "Snapshot", "Sphere", "Spring", "SpringMode", "State", "StepReport", "StiffSpring",
    "TriangleMesh", "World", "Worlds", "backends", "body_rows", "harness", "interface_version", "open", "search_path",
]
