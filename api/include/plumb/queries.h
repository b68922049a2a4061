/* plumb.queries/1: rays, shape casts and overlaps against the world as the last step left it. Always in batches. */
#ifndef PLUMB_QUERIES_H
#define PLUMB_QUERIES_H

#include "plumb/bodies.h"
#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_QUERIES "plumb.queries/1"

/* First argument of PLUMB_CAP_QUERY; the second is the shape type that is cast or overlapped (0 for rays). */
typedef uint32_t PlumbQueryKind;
enum {
  PLUMB_QUERY_RAY = 0,
  PLUMB_QUERY_CAST = 1,
  PLUMB_QUERY_OVERLAP = 2,
  PLUMB_QUERY_PENETRATION = 3,  /* since 1.2 */
  PLUMB_QUERY_TURNING_CAST = 4, /* since 1.2 */
  PLUMB_QUERY_KIND_COUNT = 5
};

typedef uint32_t PlumbHitMode;
enum {
  PLUMB_HIT_CLOSEST = 0, /* hits has one row a query, in its order; body 0 where nothing was hit */
  PLUMB_HIT_ALL = 1      /* hits has all rows, sorted by query, then fraction, then body slot: one a body */
};

/* Sees a body when the rule of PlumbFilter says that the two may touch. Sensors are not seen. Of a body in which the
 * ray starts engines tell different things: a hit at fraction 0, the far side, or nothing; see the note of
 * PLUMB_CAP_QUERY. */
typedef struct PlumbRay {
  PlumbVec3 origin;      /* m */
  PlumbVec3 translation; /* m: direction and length in one, not 0 */
  PlumbFilter filter;
} PlumbRay;

/* A convex shape moved without turning. A shape that overlaps at the start hits at fraction 0. */
typedef struct PlumbCast {
  PlumbShape shape; /* sphere, box, capsule, cylinder or hull */
  PlumbPose pose;
  PlumbVec3 translation; /* m, not 0 */
  PlumbFilter filter;
} PlumbCast;

/* A convex shape that turns on its way, about the place of its pose: at a fraction f of the way it is at
 * pose.position + f * translation, turned from pose.orientation by f * |rotation| rad about rotation. One of
 * translation and rotation may be 0. Since 1.2. */
typedef struct PlumbTurningCast {
  PlumbShape shape; /* sphere, box, capsule, cylinder or hull */
  PlumbPose pose;
  PlumbVec3 translation; /* m */
  PlumbVec3 rotation;    /* rad, world axes; its length at most 2 pi: a whole turn */
  PlumbFilter filter;
} PlumbTurningCast;

typedef struct PlumbOverlap {
  PlumbShape shape;
  PlumbPose pose;
  PlumbFilter filter;
} PlumbOverlap;

typedef struct PlumbHit {
  PlumbBody body;     /* 0: nothing */
  uint32_t query;     /* index into the batch */
  uint32_t child;     /* of a compound, triangle of a mesh; else 0, also for a height field */
  double fraction;    /* of the way, 0..1; 0 for overlaps */
  PlumbVec3 position; /* world, m; NaN for overlaps */
  PlumbVec3 normal;   /* of the surface that was hit, unit; NaN for overlaps */
} PlumbHit;

/* How deep a shape overlaps a body, and which way out, as plumb.collide/1 tells of the two: of a body with several
 * children, or a surface with several triangles, that which is deepest. Convex shapes are solid and a plane is solid
 * below; surfaces have nothing inside. Since 1.2. */
typedef struct PlumbPenetration {
  PlumbBody body;
  uint32_t query;     /* index into the batch */
  uint32_t child;     /* of a compound, triangle of a mesh; else 0, also for a height field */
  double depth;       /* m, >= 0: how far the shape moves along normal until it only touches what it is deepest in */
  PlumbVec3 position; /* world, m: where it is deepest, on either surface or between them */
  PlumbVec3 normal;   /* unit, from the body to the shape: the way out */
} PlumbPenetration;

/* hits[capacity]; *hit_count is how many there are, also when the answer is PLUMB_TRUNCATED.
 * Strides are in bytes. All [query]: any number at once while no step runs. */
typedef struct PlumbQueriesTable {
  uint32_t struct_size;
  uint32_t reserved;
  PlumbResult (*rays)(PlumbWorld* world, PlumbHitMode mode, const PlumbRay* rays, size_t stride, uint32_t count,
                      PlumbHit* hits, uint32_t capacity, uint32_t* hit_count);
  PlumbResult (*casts)(PlumbWorld* world, PlumbHitMode mode, const PlumbCast* casts, size_t stride, uint32_t count,
                       PlumbHit* hits, uint32_t capacity, uint32_t* hit_count);
  /* Always all hits. */
  PlumbResult (*overlaps)(PlumbWorld* world, const PlumbOverlap* overlaps, size_t stride, uint32_t count,
                          PlumbHit* hits, uint32_t capacity, uint32_t* hit_count);
  /* Of all bodies that a shape overlaps: out[capacity] has a row for each, sorted by query, then depth, the deepest
   * first, then body slot. Bodies that touch the shape without depth may be told or not. PLUMB_CAP_QUERY with
   * PLUMB_QUERY_PENETRATION says of which shapes; a table that ends before has it not. Since 1.2. */
  PlumbResult (*penetrations)(PlumbWorld* world, const PlumbOverlap* overlaps, size_t stride, uint32_t count,
                              PlumbPenetration* out, uint32_t capacity, uint32_t* out_count);
  /* As casts are, of shapes that turn on the way: the first touch on it, though it may be a corner's that swings out
   * and back. PLUMB_CAP_QUERY with PLUMB_QUERY_TURNING_CAST says of which shapes; a table that ends before has it not.
   * Since 1.2. */
  PlumbResult (*turning_casts)(PlumbWorld* world, PlumbHitMode mode, const PlumbTurningCast* casts, size_t stride,
                               uint32_t count, PlumbHit* hits, uint32_t capacity, uint32_t* hit_count);
} PlumbQueriesTable;

#ifdef __cplusplus
}
#endif
#endif
