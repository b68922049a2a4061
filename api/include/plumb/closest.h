/* plumb.closest/1: which bodies are near a convex shape, how far away, and where, in the world as the last step left
 * it. Always in batches. Since 1.2. */
#ifndef PLUMB_CLOSEST_H
#define PLUMB_CLOSEST_H

#include "plumb/queries.h"
#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_CLOSEST "plumb.closest/1"

/* Looks around a shape that need not be in the world. Sees a body when the rule of PlumbFilter says that the two may
 * touch. Sensors are not seen. To look around a point give a small sphere and add its radius to distances. */
typedef struct PlumbProbe {
  PlumbShape shape; /* sphere, box, capsule, cylinder or hull; PLUMB_CAP_CLOSEST says which */
  PlumbPose pose;
  double most_distance; /* m, > 0 and finite: what is further away is not looked for */
  PlumbFilter filter;
} PlumbProbe;

/* The shortest way from a probe to a body. Convex shapes are solid and a plane is solid below; meshes and height fields
 * are surfaces with two sides and nothing inside. Of several ways that are equally short it is one of them. */
typedef struct PlumbClosest {
  PlumbBody body;     /* 0: nothing is within most_distance; then what follows child is NaN */
  uint32_t probe;     /* index into the batch */
  uint32_t child;     /* of a compound, triangle of a mesh; else 0, also for a height field. The first of equal ones;
                       * where distance is 0 one of those that touch */
  double distance;    /* m, >= 0; 0 where they touch or overlap: plumb.collide/1 tells how deep */
  PlumbVec3 on_probe; /* world, m: the point of the probe's surface; NaN where distance is 0 */
  PlumbVec3 on_body;  /* world, m: the point of the body's surface; NaN where distance is 0 */
  PlumbVec3 normal;   /* unit, from the probe to the body; NaN where distance is 0 */
} PlumbClosest;

/* Needs PLUMB_NEED_QUERIES. */
typedef struct PlumbClosestTable {
  uint32_t struct_size;
  uint32_t reserved;
  /* [query] PLUMB_HIT_CLOSEST: one row a probe, in their order, of the body that is nearest; of bodies that are
   * equally near of the one in the lower slot. PLUMB_HIT_ALL: a row for each body within most_distance, sorted by
   * probe, then distance, then body slot. out[capacity] is the caller's; *out_count is how many there are, also when
   * the answer is PLUMB_TRUNCATED. stride is in bytes, sizeof the caller's probe. A shape that is not convex, and a
   * number that may not be, are PLUMB_E_INVALID_ARGUMENT; then nothing is written. */
  PlumbResult (*bodies)(PlumbWorld* world, PlumbHitMode mode, const PlumbProbe* probes, size_t stride, uint32_t count,
                        PlumbClosest* out, uint32_t capacity, uint32_t* out_count);
} PlumbClosestTable;

#ifdef __cplusplus
}
#endif
#endif
