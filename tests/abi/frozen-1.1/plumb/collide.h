/* plumb.collide/1: collision without a step. Posed shapes in, contacts and distances out. */
#ifndef PLUMB_COLLIDE_H
#define PLUMB_COLLIDE_H

#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_COLLIDE "plumb.collide/1"

typedef struct PlumbPosedPair {
  PlumbShape shape_a, shape_b;
  PlumbPose pose_a, pose_b;
} PlumbPosedPair;

typedef struct PlumbPairResult {
  double distance;      /* m; negative: depth of the deepest contact; NaN when apart and the engine does not tell */
  uint32_t first_point; /* into points */
  uint32_t point_count;
} PlumbPairResult;

typedef struct PlumbPairPoint {
  PlumbVec3 position; /* world, m */
  PlumbVec3 normal;   /* unit, from a to b */
  double depth;       /* m; positive: overlap */
  uint64_t feature;   /* 0: not known */
} PlumbPairPoint;

typedef struct PlumbCollideTable {
  uint32_t struct_size;
  uint32_t reserved;
  /* [query] results[count], points[capacity]; *point_count is how many there are, also when PLUMB_TRUNCATED. */
  PlumbResult (*pairs)(PlumbWorld* world, const PlumbPosedPair* pairs, size_t stride, uint32_t count,
                       PlumbPairResult* results, PlumbPairPoint* points, uint32_t capacity, uint32_t* point_count);
} PlumbCollideTable;

#ifdef __cplusplus
}
#endif
#endif
