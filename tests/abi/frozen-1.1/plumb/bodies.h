/* Bodies, and the fields in which their state is read and written in batches. */
#ifndef PLUMB_BODIES_H
#define PLUMB_BODIES_H

#include "plumb/shapes.h"
#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef uint32_t PlumbMotion;
enum {
  PLUMB_STATIC = 0,    /* never moves of itself; may be teleported by writing its pose */
  PLUMB_KINEMATIC = 1, /* moves as the host says and is moved by nothing */
  PLUMB_DYNAMIC = 2,
  PLUMB_MOTION_COUNT = 3
};

/* PlumbBodyDesc.flags */
enum {
  PLUMB_BODY_SENSOR = 1u << 0,      /* reports overlaps as events, pushes nothing; needs PLUMB_NEED_SENSORS. Sees every
                                       body that its filter lets it see, but where both are static */
  PLUMB_BODY_CCD = 1u << 1,         /* must not pass through others however fast it is; needs PLUMB_NEED_CCD */
  PLUMB_BODY_NO_ROTATION = 1u << 2, /* a particle: orientation and angular velocity stay as they are */
  PLUMB_BODY_ASLEEP = 1u << 3,      /* starts asleep; needs PLUMB_NEED_SLEEPING */
  PLUMB_BODY_NEVER_SLEEPS = 1u << 4
};

/* PlumbBodyDesc.locks: motion along or about the world's axes that is taken away; needs PLUMB_NEED_AXIS_LOCKS. */
enum {
  PLUMB_LOCK_LINEAR_X = 1u << 0,
  PLUMB_LOCK_LINEAR_Y = 1u << 1,
  PLUMB_LOCK_LINEAR_Z = 1u << 2,
  PLUMB_LOCK_ANGULAR_X = 1u << 3,
  PLUMB_LOCK_ANGULAR_Y = 1u << 4,
  PLUMB_LOCK_ANGULAR_Z = 1u << 5
};

typedef uint32_t PlumbMassMode;
enum {
  PLUMB_MASS_FROM_DENSITY = 0, /* mass, centre of mass and inertia of the shape filled with density */
  PLUMB_MASS_FROM_TOTAL = 1,   /* as above, scaled so that the mass is mass; a body without a shape has inertia 0 */
  PLUMB_MASS_EXPLICIT = 2      /* mass, centre_of_mass, inertia and inertia_orientation as given */
};

/* Whether two bodies may touch: equal non-zero groups decide (positive: always, negative: never);
 * otherwise each one's category must be in the other's mask. Single pairs: plumb.exceptions/1. */
typedef struct PlumbFilter {
  uint32_t category; /* bits */
  uint32_t mask;     /* bits */
  int32_t group;
  uint32_t reserved;
} PlumbFilter;

typedef struct PlumbBodyDesc {
  uint32_t struct_size;
  PlumbMotion motion;
  uint32_t flags;
  uint32_t locks;
  PlumbShape shape; /* 0: no shape, touches nothing */
  PlumbPose pose;   /* of the body's frame, in which its shape is placed; the centre of mass may be elsewhere */
  PlumbVec3 linear_velocity;  /* of the centre of mass, m/s */
  PlumbVec3 angular_velocity; /* rad/s, world axes */
  PlumbMassMode mass_mode;    /* dynamic bodies only */
  uint32_t reserved;
  double density;                /* kg/m3, > 0 */
  double mass;                   /* kg, > 0 */
  PlumbVec3 centre_of_mass;      /* body frame, m */
  PlumbVec3 inertia;             /* principal moments about the centre of mass, kg m2; 0 0 0 with NO_ROTATION */
  PlumbQuat inertia_orientation; /* from principal axes to the body frame */
  PlumbMaterial material;
  double gravity_scale;
  double linear_damping;  /* c in dv/dt = -c v, 1/s, >= 0; needs PLUMB_NEED_DAMPING when not 0 */
  double angular_damping; /* likewise for the angular velocity */
  PlumbFilter filter;
  uint64_t user_data;
} PlumbBodyDesc;

/* A field is a row of numbers for every body. Pose and velocity rows are state: a write sets them.
 * Force to impulse rows act: a write adds to what acts on the body in the next step and is spent by it. */
typedef uint32_t PlumbField;
enum {
  PLUMB_FIELD_POSE = 0,             /* 7: position, orientation x y z w; of the body frame */
  PLUMB_FIELD_VELOCITY = 1,         /* 6: linear of the centre of mass, angular; world axes */
  PLUMB_FIELD_FORCE = 2,            /* 3: N at the centre of mass, write only; needs PLUMB_NEED_FORCES */
  PLUMB_FIELD_TORQUE = 3,           /* 3: N m, world axes, write only */
  PLUMB_FIELD_IMPULSE = 4,          /* 3: N s at the centre of mass, write only; changes the velocity at once */
  PLUMB_FIELD_ANGULAR_IMPULSE = 5,  /* 3: N m s, write only; changes the velocity at once */
  PLUMB_FIELD_FORCE_AT_POINT = 6,   /* 6: force, world point, write only */
  PLUMB_FIELD_IMPULSE_AT_POINT = 7, /* 6: impulse, world point, write only */
  PLUMB_FIELD_AWAKE = 8,            /* 1: 0 asleep, 1 awake; what is not dynamic never sleeps */
  PLUMB_FIELD_KINEMATIC_TARGET = 9, /* 7: pose that a kinematic body reaches in exactly the next step, write only. After
                                       that step it reads the velocity that led there; without a new target it stands
                                       still in the one after */
  PLUMB_FIELD_MASS = 10, /* 11: mass, centre of mass (3), principal inertia (3), inertia orientation (4); read only */
  PLUMB_FIELD_MATERIAL = 11,         /* 2: friction, restitution */
  PLUMB_FIELD_GRAVITY_SCALE = 12,    /* 1 */
  PLUMB_FIELD_DAMPING = 13,          /* 2: linear, angular, 1/s */
  PLUMB_FIELD_SURFACE_VELOCITY = 14, /* 3: m/s, body frame */
  PLUMB_FIELD_FILTER = 15,           /* 3: category, mask, group, as whole numbers */
  PLUMB_FIELD_COUNT = 16
};

#ifdef __cplusplus
}
#endif
#endif
