/* plumb.debug/1: what the engine sees, for pictures and for tests that want no back door. */
#ifndef PLUMB_DEBUG_H
#define PLUMB_DEBUG_H

#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_DEBUG "plumb.debug/1"

typedef struct PlumbDebugPair {
  PlumbBody body_a, body_b;
} PlumbDebugPair;

typedef struct PlumbDebugBox {
  PlumbVec3 lower, upper; /* world, m */
  PlumbBody body;         /* of a leaf; 0 for an inner node */
  int32_t depth;          /* below the root, 0 for the root; -1 where there is no tree */
  uint32_t tree;          /* engines with several trees number them */
} PlumbDebugBox;

typedef struct PlumbDebugAxis {
  PlumbBody body_a, body_b;
  PlumbVec3 axis;    /* unit, from a to b: of least overlap, or separating */
  double separation; /* m along the axis; negative: overlap */
} PlumbDebugAxis;

typedef struct PlumbDebugBody {
  PlumbBody body;
  int32_t island;  /* bodies of one number are bound by contacts and joints and fall asleep together; -1: of none */
  uint32_t asleep; /* 0 or 1 */
} PlumbDebugBody;

typedef struct PlumbDebugConstraint {
  PlumbBody body_a, body_b; /* body_a is 0 for a joint with the world */
  PlumbJoint joint;         /* 0 for the contacts of two bodies */
  int32_t colour;           /* constraints of one colour share no dynamic body and are solved at once; -1: one by one */
  uint32_t reserved;        /* 0 */
} PlumbDebugConstraint;

/* As of the last step. [world]. out[capacity]; *count is how many there are, also when PLUMB_TRUNCATED.
 * A backend answers PLUMB_E_UNSUPPORTED to what it cannot show. */
typedef struct PlumbDebugTable {
  uint32_t struct_size;
  uint32_t reserved;
  PlumbResult (*pairs)(PlumbWorld* world, PlumbDebugPair* out, uint32_t capacity, uint32_t* count);
  PlumbResult (*boxes)(PlumbWorld* world, PlumbDebugBox* out, uint32_t capacity, uint32_t* count);
  PlumbResult (*axes)(PlumbWorld* world, PlumbDebugAxis* out, uint32_t capacity, uint32_t* count);
  /* Since 1.1: look at struct_size before. Every body that lives, once. */
  PlumbResult (*bodies)(PlumbWorld* world, PlumbDebugBody* out, uint32_t capacity, uint32_t* count);
  /* Since 1.1. What the last step's solver had to satisfy. */
  PlumbResult (*constraints)(PlumbWorld* world, PlumbDebugConstraint* out, uint32_t capacity, uint32_t* count);
} PlumbDebugTable;

#ifdef __cplusplus
}
#endif
#endif
