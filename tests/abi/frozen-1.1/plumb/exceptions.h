/* plumb.exceptions/1: excluded pairs: bodies that do not touch, whatever their filters say. */
#ifndef PLUMB_EXCEPTIONS_H
#define PLUMB_EXCEPTIONS_H

#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_EXCEPTIONS "plumb.exceptions/1"

/* The order of the two does not matter. */
typedef struct PlumbBodyPair {
  PlumbBody body_a, body_b;
} PlumbBodyPair;

/* An exception lasts until it is taken back or one of its bodies is destroyed: a later body in the same slot has none.
 * Neither contacts nor sensors see a pair that is excepted; queries do. It stands beside what joints say of their
 * bodies (collide_connected): each may keep a pair apart by itself. Needs no PLUMB_NEED bit, as it costs nothing where
 * it is not used. Snapshots hold the exceptions of their time. */
typedef struct PlumbExceptionsTable {
  uint32_t struct_size;
  uint32_t reserved;
  /* [world] All or none. touch 0: from the next step on the two do not touch, and a contact that they had ends with
   * that step's events; 1: they touch as their filters say again. Bodies that sleep wake where that changes something;
   * setting what is so already is fine. stride is sizeof the caller's pair. A body with itself, or another touch, is
   * PLUMB_E_INVALID_ARGUMENT. */
  PlumbResult (*set)(PlumbWorld* world, const PlumbBodyPair* pairs, size_t stride, uint32_t count, uint32_t touch);
  /* [world] The exceptions there are, the lower slot of each first, in the order of body_a's slot, then body_b's.
   * out[capacity]; *count is how many there are, also when PLUMB_TRUNCATED. */
  PlumbResult (*list)(PlumbWorld* world, PlumbBodyPair* out, uint32_t capacity, uint32_t* count);
} PlumbExceptionsTable;

#ifdef __cplusplus
}
#endif
#endif
