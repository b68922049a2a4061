"""The enumerations of plumb.h. Wherever one is taken, its word in lower case is taken too: "dynamic" for
Motion.DYNAMIC."""

from __future__ import annotations

from enum import IntEnum, IntFlag


class Need(IntFlag):
    """What a scene needs of a world. A backend leaves out the rest, and refuses its use."""

    ROTATION = 1 << 0
    COLLISION = 1 << 1
    FRICTION = 1 << 2
    RESTITUTION = 1 << 3
    JOINTS = 1 << 4
    CCD = 1 << 5
    SLEEPING = 1 << 6
    EVENTS = 1 << 7
    CONTACTS = 1 << 8
    CONTACT_IMPULSES = 1 << 9
    SENSORS = 1 << 10
    KINEMATIC = 1 << 11
    GYROSCOPIC = 1 << 12
    DAMPING = 1 << 13
    FORCES = 1 << 14
    AXIS_LOCKS = 1 << 15
    FILTERS = 1 << 16
    QUERIES = 1 << 17
    SURFACE_VELOCITY = 1 << 18
    JOINT_REACTIONS = 1 << 19
    SNAPSHOT = 1 << 20
    CONTACT_MODIFICATION = 1 << 21
    ROLLING_FRICTION = 1 << 22


class ShapeType(IntEnum):
    """The types of shapes, as capabilities name them."""

    SPHERE = 0
    BOX = 1
    CAPSULE = 2
    CYLINDER = 3
    CONVEX_HULL = 4
    TRIANGLE_MESH = 5
    HEIGHT_FIELD = 6
    PLANE = 7
    COMPOUND = 8


class Motion(IntEnum):
    """How a body moves: not of itself, as the host says, or by the laws of mechanics."""

    STATIC = 0
    KINEMATIC = 1
    DYNAMIC = 2


class BodyFlag(IntFlag):
    """BodyDesc.flags."""

    SENSOR = 1 << 0
    CCD = 1 << 1
    NO_ROTATION = 1 << 2
    ASLEEP = 1 << 3
    NEVER_SLEEPS = 1 << 4
    MODIFY_CONTACTS = 1 << 5


class Lock(IntFlag):
    """BodyDesc.locks: motion along or about the world's axes that is taken away."""

    LINEAR_X = 1 << 0
    LINEAR_Y = 1 << 1
    LINEAR_Z = 1 << 2
    ANGULAR_X = 1 << 3
    ANGULAR_Y = 1 << 4
    ANGULAR_Z = 1 << 5


class MassMode(IntEnum):
    """Where a body's mass comes from: density, mass, or mass with centre and inertia."""

    FROM_DENSITY = 0
    FROM_TOTAL = 1
    EXPLICIT = 2


class Field(IntEnum):
    """A row of numbers for every body, with so many columns."""

    POSE = 0
    """7: position, orientation x y z w; of the body's frame"""
    VELOCITY = 1
    """6: linear of the centre of mass, angular; world axes"""
    FORCE = 2
    """3: N at the centre of mass, in the next step; write only, as all down to IMPULSE_AT_POINT"""
    TORQUE = 3
    """3: N m, world axes, in the next step"""
    IMPULSE = 4
    """3: N s at the centre of mass, at once"""
    ANGULAR_IMPULSE = 5
    """3: N m s, at once"""
    FORCE_AT_POINT = 6
    """6: force, world point"""
    IMPULSE_AT_POINT = 7
    """6: impulse, world point"""
    AWAKE = 8
    """1: 0 asleep, 1 awake"""
    KINEMATIC_TARGET = 9
    """7: pose that a kinematic body reaches in exactly the next step; write only"""
    MASS = 10
    """11: mass, centre of mass (3), principal inertia (3), inertia orientation (4); read only"""
    MATERIAL = 11
    """2: friction, restitution"""
    GRAVITY_SCALE = 12
    """1"""
    DAMPING = 13
    """2: linear, angular, 1/s"""
    SURFACE_VELOCITY = 14
    """3: m/s, body frame"""
    FILTER = 15
    """3: category, mask, group"""
    ROLLING_FRICTION = 16
    """2: rolling, spinning, m"""


class JointType(IntEnum):
    """The types of joints; plumb.h says what each holds."""

    BALL = 0
    HINGE = 1
    SLIDER = 2
    DISTANCE = 3
    FIXED = 4
    UNIVERSAL = 5
    GENERIC = 6
    SWING_TWIST = 7
    GEAR = 8
    RACK_AND_PINION = 9


class AxisMode(IntEnum):
    """What a generic joint does with one of its six axes."""

    FREE = 0
    LOCKED = 1
    LIMITED = 2


class SpringMode(IntEnum):
    """What the two numbers of a spring are."""

    FREQUENCY = 0
    """frequency and damping ratio with the pair's effective mass on the axis"""
    STIFFNESS = 1
    """stiffness and damping"""


class JointField(IntEnum):
    """A row of numbers for every joint, with so many columns."""

    COORDINATES = 0
    """6: coordinates of the six axes, m and rad"""
    REACTION = 1
    """6: force, torque on body b at frame b's origin in the last step, world axes"""
    MOTOR = 2
    """12: target velocity and max force of axis 0, of axis 1 and so on; also written"""
    SPRING_REST = 3
    """6: where the springs of the six axes rest, the targets of PD controllers; of a distance joint first its
    rest_length; also written"""


class JointFeature(IntEnum):
    """What a type of joints may have, as capabilities name it."""

    HAS_LIMITS = 0
    HAS_MOTORS = 1
    HAS_SPRINGS = 2
    BREAKS = 3
    HAS_REACTION = 4
    HAS_STIFFNESS = 5
    """springs by SpringMode.STIFFNESS"""
    HAS_TARGETS = 6
    """where its springs rest can be written"""


class QueryKind(IntEnum):
    """Kinds of queries, as capabilities name them."""

    RAY = 0
    CAST = 1
    OVERLAP = 2
    PENETRATION = 3
    TURNING_CAST = 4


class HitMode(IntEnum):
    """The closest hit of each query, in their order, or all hits."""

    CLOSEST = 0
    ALL = 1


class BodyMember(IntFlag):
    """What a BodyChange changes, as capabilities name it."""

    MOTION = 1 << 0
    SHAPE = 1 << 1
    MASS = 1 << 2
    FLAGS = 1 << 3
    LOCKS = 1 << 4


class JointMember(IntFlag):
    """What a JointChange changes, as capabilities name it."""

    FRAMES = 1 << 0
    LIMITS = 1 << 1
    MOTORS = 1 << 2
    SPRINGS = 1 << 3
    STRENGTH = 1 << 4
    COLLIDE_CONNECTED = 1 << 5
    ENABLED = 1 << 6


class ContactChange(IntFlag):
    """What of a contact a host changes before it is solved (World.step), as capabilities name it."""

    DISABLED = 1 << 0
    FRICTION = 1 << 1
    RESTITUTION = 1 << 2
    SURFACE_VELOCITY = 1 << 3


class EventType(IntEnum):
    """What happened in the last step."""

    CONTACT_BEGIN = 0
    CONTACT_END = 1
    SENSOR_ENTER = 2
    SENSOR_LEAVE = 3
    WAKE = 4
    SLEEP = 5
    JOINT_BROKEN = 6


class Phase(IntEnum):
    """Parts of a step whose time a backend may tell."""

    BROAD = 0
    NARROW = 1
    ISLANDS = 2
    SOLVE = 3
    INTEGRATE = 4
    CONTINUOUS = 5
    OUTPUT = 6


class Remark(IntFlag):
    """StepReport.remarks."""

    SOLVER_FELL_BACK = 1 << 0
    CAPACITY_GREW = 1 << 1
    STEP_REPEATED = 1 << 2
    ENERGY_BOUNDED = 1 << 3


class CapabilityKind(IntEnum):
    """What Backend.capability can be asked."""

    SHAPE = 0
    PAIR = 1
    JOINT = 2
    JOINT_FEATURE = 3
    QUERY = 4
    FIELD_READ = 5
    FIELD_WRITE = 6
    NEED = 7
    EVENT = 8
    PHASE_TIME = 9
    RESIDUAL = 10
    SNAPSHOT = 11
    HOST_JOBS = 12
    CHILD_MATERIAL = 13
    MODIFY = 14
    MANIFOLD = 15
    CLOSEST = 16
    TRIANGLE_MATERIAL = 17
    COOKING = 18
    HOST_MEMORY = 19


class Degree(IntEnum):
    """How truly an engine has a thing; more is better."""

    NONE = 0
    APPROXIMATE = 1
    EMULATED = 2
    NATIVE = 3


class Determinism(IntEnum):
    """What gives the same bits, each including those before: the same calls, any number of threads, CPU and GPU."""

    NONE = 0
    RUN = 1
    THREADS = 2
    DEVICE = 3


class SettingType(IntEnum):
    """Of a setting's value."""

    BOOL = 0
    INT = 1
    FLOAT = 2
    CHOICE = 3


class SettingRole(IntEnum):
    """Quality costs time and buys accuracy; speed changes time and not results; behaviour is another model."""

    QUALITY = 0
    SPEED = 1
    BEHAVIOUR = 2
