/* plumb.joints/1: joints between two bodies, or between a body and the world.
 *
 * Every joint joins a frame fixed in body a to a frame fixed in body b. Coordinates are those of b's frame seen from
 * a's: axes 0 1 2 are translations along x y z of frame a, axes 3 4 5 rotations about x y z.
 */
#ifndef PLUMB_JOINTS_H
#define PLUMB_JOINTS_H

#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_JOINTS "plumb.joints/1"

typedef uint32_t PlumbJointType;
enum {
  PLUMB_JOINT_BALL = 0,      /* origins coincide */
  PLUMB_JOINT_HINGE = 1,     /* origins and x axes coincide; free axis 3 */
  PLUMB_JOINT_SLIDER = 2,    /* orientations equal, b's origin on a's x axis; free axis 0 */
  PLUMB_JOINT_DISTANCE = 3,  /* distance of the origins: rest_length, or within limits[0]; spring on axis 0 */
  PLUMB_JOINT_FIXED = 4,     /* frames coincide */
  PLUMB_JOINT_UNIVERSAL = 5, /* origins coincide, a's x axis stays square to b's y axis; free axes 3 and 4 */
  PLUMB_JOINT_GENERIC = 6,   /* axis_modes say which of the six axes are free, locked or limited */
  PLUMB_JOINT_TYPE_COUNT = 7
};

typedef uint32_t PlumbAxisMode;
enum { PLUMB_AXIS_FREE = 0, PLUMB_AXIS_LOCKED = 1, PLUMB_AXIS_LIMITED = 2 };

typedef struct PlumbLimit {
  double lower, upper; /* m or rad; lower <= upper */
  uint32_t enabled;
  uint32_t reserved;
} PlumbLimit;

typedef struct PlumbMotor {
  double target_velocity; /* m/s or rad/s, of b seen from a */
  double max_force;       /* N or N m, >= 0 */
  uint32_t enabled;
  uint32_t reserved;
} PlumbMotor;

typedef struct PlumbSpring {
  double rest;          /* m or rad; for a distance joint its rest_length is used instead */
  double frequency;     /* Hz of the undamped spring with the pair's effective mass on this axis */
  double damping_ratio; /* 1 is critical */
  uint32_t enabled;
  uint32_t reserved;
} PlumbSpring;

typedef struct PlumbJointDesc {
  uint32_t struct_size;
  PlumbJointType type;
  PlumbBody body_a;           /* 0: the world; its frame is then in world axes */
  PlumbBody body_b;           /* not 0 */
  PlumbPose frame_a;          /* in body a's frame */
  PlumbPose frame_b;          /* in body b's frame */
  uint32_t collide_connected; /* 0: the two bodies do not touch each other */
  uint32_t reserved;
  PlumbAxisMode axis_modes[6]; /* generic only */
  PlumbLimit limits[6];
  PlumbMotor motors[6];
  PlumbSpring springs[6];
  double rest_length;  /* distance, m, >= 0 */
  double break_force;  /* N, 0: never breaks */
  double break_torque; /* N m, 0: never breaks */
  uint64_t user_data;
} PlumbJointDesc;

/* Rows of a joint, read in batches. */
typedef uint32_t PlumbJointField;
enum {
  PLUMB_JOINT_COORDINATES = 0, /* 6: coordinates of the six axes (angles in -pi..pi) */
  PLUMB_JOINT_REACTION = 1,    /* 6: force, torque on body b at frame b's origin in the last step, world axes; N, N m */
  PLUMB_JOINT_MOTOR = 2,       /* 12: target velocity and max force of the six axes; also written */
  PLUMB_JOINT_FIELD_COUNT = 3
};

/* What a joint type may have beyond itself; second argument of PLUMB_CAP_JOINT_FEATURE. */
typedef uint32_t PlumbJointFeature;
enum {
  PLUMB_JOINT_HAS_LIMITS = 0,
  PLUMB_JOINT_HAS_MOTORS = 1,
  PLUMB_JOINT_HAS_SPRINGS = 2,
  PLUMB_JOINT_BREAKS = 3,
  PLUMB_JOINT_HAS_REACTION = 4,
  PLUMB_JOINT_FEATURE_COUNT = 5
};

typedef struct PlumbJointsTable {
  uint32_t struct_size;
  uint32_t reserved;
  /* [world] All or none; ids[count]. */
  PlumbResult (*create)(PlumbWorld* world, const PlumbJointDesc* descs, size_t stride, uint32_t count, PlumbJoint* ids);
  /* [world] All or none. */
  PlumbResult (*destroy)(PlumbWorld* world, const PlumbJoint* ids, uint32_t count);
  /* [world] ids null: the first count live joints in order of creation. stride in bytes between rows. */
  PlumbResult (*read)(PlumbWorld* world, PlumbJointField field, PlumbDataType type, const PlumbJoint* ids,
                      uint32_t count, void* rows, size_t stride);
  /* [world] Likewise; PLUMB_JOINT_MOTOR only. */
  PlumbResult (*write)(PlumbWorld* world, PlumbJointField field, PlumbDataType type, const PlumbJoint* ids,
                       uint32_t count, const void* rows, size_t stride);
} PlumbJointsTable;

#ifdef __cplusplus
}
#endif
#endif
