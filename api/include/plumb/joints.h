/* plumb.joints/1: joints between two bodies, or between a body and the world.
 *
 * Every joint joins a frame fixed in body a to a frame fixed in body b. Coordinates are those of b's frame seen from
 * a's: axes 0 1 2 are translations along x y z of frame a, axes 3 4 5 rotations about x y z.
 *
 * Of PLUMB_JOINT_SWING_TWIST (others: cone twist, ball and socket with a cone) axes 3 4 5 are other numbers. b's turn
 * seen from a is taken apart into a twist about x and, after it, a swing about an axis square to x, by the shorter way
 * (Dobrowolski, "Swing-twist decomposition in Clifford algebra", 2015). Axis 3 is the twist's angle; axes 4 and 5 are
 * the swing as a rotation vector: its direction in a's y and z times its angle, which is the one between both x axes.
 * limits[3] bounds the twist. limits[4] and limits[5], both or neither and each with lower = -upper, are the half
 * angles of an elliptic cone about a's x axis that b's x axis stays within: (x4 / upper4)^2 + (x5 / upper5)^2 <= 1, 0 <
 * upper < pi. Motors and springs are of each axis by itself: springs on all three are a PD controller whose target
 * orientation is the one with these coordinates. Where the x axes are opposite the twist is any number: what swings as
 * far as that is held by no limit of the twist, and should have a cone.
 *
 * PLUMB_JOINT_GEAR and PLUMB_JOINT_RACK_AND_PINION (since 1.2) hold what two bodies do, each on a joint of its own:
 * they keep no body in place, have no limits, motors or springs, and begin as the bodies lie. A gear holds how far both
 * turn about their frames' x axes: turn of a + ratio * turn of b stays what it was, so ratio is b's teeth by a's, below
 * 0 where one wheel is within the other; by torques alone, wherever the two are, as a shaft between them would. Turns
 * are those in the world: on a carrier that turns itself about these axes wheels are held by it, too. A rack, b, is a
 * toothed line along x of frame b; a, the pinion, turns about x of frame a, which should be square to it, by ratio rad
 * for each m that the line goes past: at 1/ratio m from its axis, where they push on each other.
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
  PLUMB_JOINT_BALL = 0,            /* origins coincide */
  PLUMB_JOINT_HINGE = 1,           /* origins and x axes coincide; free axis 3 */
  PLUMB_JOINT_SLIDER = 2,          /* orientations equal, b's origin on a's x axis; free axis 0 */
  PLUMB_JOINT_DISTANCE = 3,        /* distance of the origins: rest_length, or within limits[0]; spring on axis 0 */
  PLUMB_JOINT_FIXED = 4,           /* frames coincide */
  PLUMB_JOINT_UNIVERSAL = 5,       /* origins coincide, a's x axis stays square to b's y axis; free axes 3 and 4 */
  PLUMB_JOINT_GENERIC = 6,         /* axis_modes say which of the six axes are free, locked or limited */
  PLUMB_JOINT_SWING_TWIST = 7,     /* origins coincide; axes 3 4 5 are a twist and a swing (head of joints.h) */
  PLUMB_JOINT_GEAR = 8,            /* turns about both x axes (head of joints.h). Since 1.2 */
  PLUMB_JOINT_RACK_AND_PINION = 9, /* a's turn about its x axis and b's way along its own. Since 1.2 */
  PLUMB_JOINT_TYPE_COUNT = 10
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

/* What a spring's two numbers are. By stiffness needs PLUMB_JOINT_HAS_STIFFNESS. */
typedef uint32_t PlumbSpringMode;
enum {
  PLUMB_SPRING_FREQUENCY = 0, /* frequency and damping ratio with the pair's effective mass on the axis */
  PLUMB_SPRING_STIFFNESS = 1  /* stiffness and damping: force = -stiffness (x - rest) - damping dx/dt. A stiffness of 0
                                 is a damper; with rest as the target it is a PD controller. */
};

typedef struct PlumbSpring {
  double rest;          /* m or rad; for a distance joint its rest_length is used instead */
  double frequency;     /* Hz, of the undamped spring, > 0; by stiffness: N/m or N m/rad, >= 0 */
  double damping_ratio; /* 1 is critical, >= 0; by stiffness: N s/m or N m s/rad */
  uint32_t enabled;
  PlumbSpringMode mode;
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
  double ratio; /* gear, rack and pinion: not 0; b's teeth by a's, or rad/m. Since 1.2 */
} PlumbJointDesc;

/* Rows of a joint, read in batches. */
typedef uint32_t PlumbJointField;
enum {
  PLUMB_JOINT_COORDINATES = 0, /* 6: coordinates of the six axes (angles in -pi..pi) */
  PLUMB_JOINT_REACTION = 1,    /* 6: force, torque on body b at frame b's origin in the last step, world axes; N, N m */
  PLUMB_JOINT_MOTOR = 2,       /* 12: target velocity and max force of axis 0, of axis 1, ...; also written */
  /* 6: rest of the spring of axis 0, of axis 1, ...: the targets of PD controllers; of a distance joint the first is
   * its rest_length, >= 0. Also written, which needs PLUMB_JOINT_HAS_TARGETS. Since 1.2. */
  PLUMB_JOINT_SPRING_REST = 3,
  PLUMB_JOINT_FIELD_COUNT = 4
};

/* What a joint type may have beyond itself; second argument of PLUMB_CAP_JOINT_FEATURE. */
typedef uint32_t PlumbJointFeature;
enum {
  PLUMB_JOINT_HAS_LIMITS = 0,
  PLUMB_JOINT_HAS_MOTORS = 1,
  PLUMB_JOINT_HAS_SPRINGS = 2,
  PLUMB_JOINT_BREAKS = 3,
  PLUMB_JOINT_HAS_REACTION = 4,
  PLUMB_JOINT_HAS_STIFFNESS = 5, /* springs by PLUMB_SPRING_STIFFNESS */
  PLUMB_JOINT_HAS_TARGETS = 6,   /* its PLUMB_JOINT_SPRING_REST rows can be written */
  PLUMB_JOINT_FEATURE_COUNT = 7
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
  /* [world] Likewise; PLUMB_JOINT_MOTOR and PLUMB_JOINT_SPRING_REST. What sleeps and is written to wakes. */
  PlumbResult (*write)(PlumbWorld* world, PlumbJointField field, PlumbDataType type, const PlumbJoint* ids,
                       uint32_t count, const void* rows, size_t stride);
} PlumbJointsTable;

#ifdef __cplusplus
}
#endif
#endif
