/* Collision shapes. A shape is immutable and may be shared by any number of bodies of its world. */
#ifndef PLUMB_SHAPES_H
#define PLUMB_SHAPES_H

#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef uint32_t PlumbShapeType;
enum {
  PLUMB_SPHERE = 0,        /* radius */
  PLUMB_BOX = 1,           /* half_extents */
  PLUMB_CAPSULE = 2,       /* radius, half_height of the segment along local y */
  PLUMB_CYLINDER = 3,      /* radius, half_height along local y */
  PLUMB_CONVEX_HULL = 4,   /* vertices: the hull of them */
  PLUMB_TRIANGLE_MESH = 5, /* vertices, indices: counter-clockwise seen from outside */
  PLUMB_HEIGHT_FIELD = 6,  /* heights, rows, columns, spacing */
  PLUMB_PLANE = 7,         /* the half space y <= 0 of the local frame; static bodies only */
  PLUMB_COMPOUND = 8,      /* children */
  PLUMB_SHAPE_TYPE_COUNT = 9
};

/* Surface of a body. The coefficients of a PAIR are the same in every backend:
 * friction sqrt(friction_a * friction_b), restitution max(restitution_a, restitution_b). */
typedef struct PlumbMaterial {
  double friction;            /* Coulomb, >= 0 */
  double restitution;         /* Newton, 0..1 */
  PlumbVec3 surface_velocity; /* m/s in the body's frame, for conveyors; needs PLUMB_NEED_SURFACE_VELOCITY when not 0 */
} PlumbMaterial;

typedef struct PlumbCompoundChild {
  PlumbShape shape;      /* not a compound, plane, mesh or height field */
  PlumbPose pose;        /* of the child in the compound's frame */
  uint32_t has_material; /* 0: the body's material; 1: the one below */
  uint32_t reserved;
  PlumbMaterial material;
} PlumbCompoundChild;

/* Only the members of the shape's type are read. All arrays are copied before the call returns. */
typedef struct PlumbShapeDesc {
  uint32_t struct_size;
  PlumbShapeType type;
  double radius;          /* m, > 0 */
  double half_height;     /* m, > 0 (capsule: >= 0) */
  PlumbVec3 half_extents; /* m, > 0 */
  const double* vertices; /* xyz triples, m */
  uint32_t vertex_count;  /* hull: >= 4 and not all in one plane */
  uint32_t triangle_count;
  const uint32_t* indices; /* 3 a triangle, each < vertex_count */
  /* rows * columns values, m, row by row: y of the point at x = column * spacing.x, z = row * spacing.z. Each cell is
   * two triangles, cut along the diagonal from (column, row + 1) to (column + 1, row). */
  const double* heights;
  uint32_t rows;     /* >= 2, along z; the field is centred: the origin is the middle of the rectangle, at height 0 */
  uint32_t columns;  /* >= 2, along x */
  PlumbVec3 spacing; /* x and z > 0, m; y unused */
  const PlumbCompoundChild* children;
  uint32_t child_count;
  uint32_t reserved;
  uint64_t user_data;
} PlumbShapeDesc;

#ifdef __cplusplus
}
#endif
#endif
