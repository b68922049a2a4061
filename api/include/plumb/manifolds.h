/* plumb.manifolds/1: contact modification: what touches is shown to the host before the solver sees it. Since 1.2.
 *
 * A step goes on in two halves where the host wants it to: step, then read what was found and modify it, then wait. One
 * batch for a step, no callback. So a platform lets bodies through from one side, ice lies on a part of a floor, a belt
 * runs in patches, and what a game alone knows decides whether two bodies touch.
 *
 *   step(world, &desc);
 *   while (read(world, rows, sizeof *rows, capacity, &count) >= 0 && count != 0)
 *     modify(world, changes, sizeof *changes, change_count);
 *   wait(world, &report);
 */
#ifndef PLUMB_MANIFOLDS_H
#define PLUMB_MANIFOLDS_H

#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_MANIFOLDS "plumb.manifolds/1"

/* PlumbManifoldChange.what: the members that count; the others are not read. */
enum {
  PLUMB_MANIFOLD_DISABLED = 1u << 0,    /* in this step the two do not touch there: no contact, no event, no impact */
  PLUMB_MANIFOLD_FRICTION = 1u << 1,    /* needs PLUMB_NEED_FRICTION */
  PLUMB_MANIFOLD_RESTITUTION = 1u << 2, /* needs PLUMB_NEED_RESTITUTION */
  PLUMB_MANIFOLD_SURFACE_VELOCITY = 1u << 3 /* needs PLUMB_NEED_SURFACE_VELOCITY */
};
#define PLUMB_MANIFOLD_CHANGE_COUNT 4
#define PLUMB_MANIFOLD_POINTS 4

/* Where two shapes, or a shape and a triangle, touch or are about to: up to four points of one plane. Engines that make
 * one contact of those with several triangles leave them apart for bodies with PLUMB_BODY_MODIFY_CONTACTS. */
typedef struct PlumbManifold {
  PlumbBody body_a, body_b;
  uint32_t child_a, child_b; /* child of a compound, triangle of a mesh; else 0 */
  uint32_t point_count;      /* 1 to PLUMB_MANIFOLD_POINTS */
  uint32_t reserved;
  PlumbVec3 normal;   /* unit, from a to b, world axes */
  PlumbVec3 velocity; /* of b against a where they touch (the mean of the points), as the step began, m/s */
  PlumbVec3 position[PLUMB_MANIFOLD_POINTS]; /* world, m; as PlumbContact's */
  double depth[PLUMB_MANIFOLD_POINTS];       /* m; positive: overlap, negative: gap */
  double friction;                           /* of the two together, and likewise what follows */
  double restitution;
  PlumbVec3 surface_velocity; /* with which b's surface runs over a's while both bodies stand, m/s, world axes */
} PlumbManifold;

typedef struct PlumbManifoldChange {
  uint32_t manifold;  /* row of the last read */
  uint32_t what;      /* PLUMB_MANIFOLD_ bits */
  double friction;    /* >= 0 */
  double restitution; /* 0 to 1 */
  PlumbVec3 surface_velocity;
} PlumbManifoldChange;

/* Needs PLUMB_NEED_CONTACT_MODIFICATION; PLUMB_CAP_MANIFOLD tells what an engine can change. Changes are of this step
 * alone. */
typedef struct PlumbManifoldsTable {
  uint32_t struct_size;
  uint32_t reserved;
  /* [world] Between step and wait: the manifolds of bodies that have PLUMB_BODY_MODIFY_CONTACTS, of those who do not
   * sleep, before the solver sees them. out[capacity]; *count is how many there are, also when PLUMB_TRUNCATED; asked
   * again they are the same until modify is called. An engine that takes a step in parts, or over again, has more
   * after that, so read and modify until *count is 0. What was not read is solved as it is. stride is sizeof the
   * caller's row. */
  PlumbResult (*read)(PlumbWorld* world, PlumbManifold* out, size_t stride, uint32_t capacity, uint32_t* count);
  /* [world] All or none; changes what was read last, each manifold at most once (count 0: nothing), and the step goes
   * on. Without manifolds that were read since the step began, or the last call, PLUMB_E_WRONG_PHASE. */
  PlumbResult (*modify)(PlumbWorld* world, const PlumbManifoldChange* changes, size_t stride, uint32_t count);
} PlumbManifoldsTable;

#ifdef __cplusplus
}
#endif
#endif
