/* plumb.snapshot/1: save and restore a world in memory, and a 64-bit hash of its state. */
#ifndef PLUMB_SNAPSHOT_H
#define PLUMB_SNAPSHOT_H

#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_SNAPSHOT "plumb.snapshot/1"

/* A snapshot holds what moves (poses, velocities, sleep, warm-start data, random state) and the pair exceptions
 * (plumb.exceptions/1), not shapes, descriptors or settings: it is restored into the world that saved it, while the
 * same bodies and joints live there. Native means that save, n steps, restore, n steps gives the same bits; approximate
 * that warm-start data is lost. */
typedef struct PlumbSnapshotTable {
  uint32_t struct_size;
  uint32_t reserved;
  /* [world] Needs PLUMB_NEED_SNAPSHOT. *size is what it takes; with capacity < *size nothing is written and the
   * answer is PLUMB_TRUNCATED. data may be null when capacity is 0. */
  PlumbResult (*save)(PlumbWorld* world, void* data, size_t capacity, size_t* size);
  /* [world] PLUMB_E_CORRUPT for data that is foreign, torn, of another version or of other bodies. */
  PlumbResult (*restore)(PlumbWorld* world, const void* data, size_t size);
  /* [world] Over pose and velocity rows in float64 in order of creation, every NaN as the same NaN. Always there. */
  PlumbResult (*hash)(PlumbWorld* world, uint64_t* hash);
} PlumbSnapshotTable;

#ifdef __cplusplus
}
#endif
#endif
