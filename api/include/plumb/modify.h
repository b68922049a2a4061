/* plumb.modify/1: bodies, joints and shapes that become others while they live. Since 1.2.
 *
 * A handle stays what it was: its filters, material, excluded pairs, joints and user data stay, and nobody else's order
 * changes. Materials, gravity scales, damping, filters, velocities and poses are fields (bodies.h); here is what no row
 * can say. PLUMB_CAP_MODIFY tells what an engine can change.
 */
#ifndef PLUMB_MODIFY_H
#define PLUMB_MODIFY_H

#include "plumb/bodies.h"
#include "plumb/joints.h"
#include "plumb/shapes.h"
#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_MODIFY "plumb.modify/1"

/* PlumbBodyChange.what: the members that count; the others are not read. */
enum {
  /* motion. What becomes dynamic keeps the velocity that it had, and the mass of when it was dynamic last; a body that
   * never was needs PLUMB_MODIFY_MASS, too. What becomes kinematic or static stands still. Joints may be left between
   * bodies that are not dynamic: they do nothing until one of the two is. */
  PLUMB_MODIFY_MOTION = 1u << 0,
  PLUMB_MODIFY_SHAPE = 1u << 1, /* shape; 0: none. The mass stays as it is without PLUMB_MODIFY_MASS */
  /* mass_mode and what it reads, with the shape that the body has after this call; dynamic bodies only. The body goes
   * on as it moved: when its centre of mass is elsewhere, its linear velocity is that of the new one. */
  PLUMB_MODIFY_MASS = 1u << 2,
  /* flags, but PLUMB_BODY_ASLEEP (write PLUMB_FIELD_AWAKE). A body that is to turn and had PLUMB_BODY_NO_ROTATION needs
   * PLUMB_MODIFY_MASS, too. */
  PLUMB_MODIFY_FLAGS = 1u << 3,
  PLUMB_MODIFY_LOCKS = 1u << 4 /* locks; velocity along what is locked is gone */
};
#define PLUMB_MODIFY_BODY_COUNT 5

typedef struct PlumbBodyChange {
  PlumbBody body;
  uint32_t what; /* PLUMB_MODIFY_ bits of bodies */
  PlumbMotion motion;
  uint32_t flags;
  uint32_t locks;
  PlumbShape shape;
  PlumbMassMode mass_mode;
  uint32_t reserved;
  double density;
  double mass;
  PlumbVec3 centre_of_mass;
  PlumbVec3 inertia;
  PlumbQuat inertia_orientation;
} PlumbBodyChange;

/* PlumbJointChange.what */
enum {
  PLUMB_MODIFY_FRAMES = 1u << 0,            /* frame_a, frame_b: the joint pulls its bodies there */
  PLUMB_MODIFY_LIMITS = 1u << 1,            /* limits; rest_length of a distance joint; axis_modes of a generic one */
  PLUMB_MODIFY_MOTORS = 1u << 2,            /* motors; PLUMB_JOINT_MOTOR rows change less and cost less */
  PLUMB_MODIFY_SPRINGS = 1u << 3,           /* springs; likewise PLUMB_JOINT_SPRING_REST rows */
  PLUMB_MODIFY_STRENGTH = 1u << 4,          /* break_force, break_torque */
  PLUMB_MODIFY_COLLIDE_CONNECTED = 1u << 5, /* collide_connected */
  PLUMB_MODIFY_ENABLED = 1u << 6 /* enabled; a joint that is not lets its bodies go and touch, and waits for 1 */
};
#define PLUMB_MODIFY_JOINT_COUNT 7

typedef struct PlumbJointChange {
  PlumbJoint joint;
  uint32_t what;    /* PLUMB_MODIFY_ bits of joints */
  uint32_t enabled; /* 0 or 1; a joint is made enabled */
  uint32_t collide_connected;
  uint32_t reserved;
  PlumbPose frame_a;
  PlumbPose frame_b;
  PlumbAxisMode axis_modes[6];
  PlumbLimit limits[6];
  PlumbMotor motors[6];
  PlumbSpring springs[6];
  double rest_length;
  double break_force;
  double break_torque;
} PlumbJointChange;

/* All or none; a body or joint stands in a call once. What sleeps and is changed, or rested on what is changed, wakes.
 * Contacts that a change ends, or begins, are told by the events of the next step. A snapshot of bodies with other
 * motions, shapes, masses, flags or locks is PLUMB_E_CORRUPT until they are as they were, and so is one of shapes that
 * are others. stride is sizeof the caller's row. */
typedef struct PlumbModifyTable {
  uint32_t struct_size;
  uint32_t reserved;
  PlumbResult (*bodies)(PlumbWorld* world, const PlumbBodyChange* changes, size_t stride, uint32_t count); /* [world] */
  PlumbResult (*joints)(PlumbWorld* world, const PlumbJointChange* changes, size_t stride,
                        uint32_t count); /* [world] */
  /* [world] Terrain that is dug, surfaces that bend: shapes[i] becomes what descs[i] says, whole and of the type that
   * it has, for all bodies that have it; their masses stay. What sleeps where the surface is another wakes; elsewhere
   * contacts and sleep go on. An engine finds by itself what differs: a mesh with the same indices, or a height field
   * of the same rows, columns and spacing, costs far less than one made anew. user_data is not read. From then on a
   * snapshot of a whole world knows the shape by what it is now. */
  PlumbResult (*shapes)(PlumbWorld* world, const PlumbShape* shapes, const PlumbShapeDesc* descs, size_t stride,
                        uint32_t count);
} PlumbModifyTable;

#ifdef __cplusplus
}
#endif
#endif
