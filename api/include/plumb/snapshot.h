/* plumb.snapshot/1: save and restore a world in memory (rollback, save games), and a 64-bit hash of its state. */
#ifndef PLUMB_SNAPSHOT_H
#define PLUMB_SNAPSHOT_H

#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_SNAPSHOT "plumb.snapshot/1"

/* Two kinds of snapshot, both restored by restore:
 *
 * Of what moves (save): poses, velocities, sleep, warm-start data, random state, gravity, and the pair exceptions
 * (plumb.exceptions/1). Restored into the world that saved it, while the same bodies and joints live there.
 *
 * Of the whole world (save_world): beside these who lives and of what, every body and joint with its handle, its
 * descriptor as it is by now, user_data, and the handles that will be given out next. Restored while other bodies and
 * joints live, or into another world, of the same needs and settings, in another process or on another platform: who
 * came since is destroyed, who is gone lives again under the handle that it had, and what was created and destroyed
 * from then on gets the same handles again. Only shapes are not in it: those that its bodies have must live in the
 * world, under the same handles and with the same geometry. A handle of a body that came after the save may so be given
 * out a second time, to whoever comes in its place.
 *
 * Native (PLUMB_CAP_SNAPSHOT; 0: of what moves, 1: of the whole) means that save, n steps, restore, n steps gives the
 * same bits; approximate that warm-start data or an engine's order of bodies is lost. */
typedef struct PlumbSnapshotTable {
  uint32_t struct_size;
  uint32_t reserved;
  /* [world] Needs PLUMB_NEED_SNAPSHOT. *size is what it takes; with capacity < *size nothing is written and the
   * answer is PLUMB_TRUNCATED. data may be null when capacity is 0. */
  PlumbResult (*save)(PlumbWorld* world, void* data, size_t capacity, size_t* size);
  /* [world] Of either kind. PLUMB_E_CORRUPT for data that is foreign, torn, of another version, of other bodies, or of
   * shapes that this world has not: then nothing has changed. */
  PlumbResult (*restore)(PlumbWorld* world, const void* data, size_t size);
  /* [world] Over pose and velocity rows in float64 in order of creation, every NaN as the same NaN. Always there. */
  PlumbResult (*hash)(PlumbWorld* world, uint64_t* hash);
  /* [world] As save, of the whole world. Since 1.2. */
  PlumbResult (*save_world)(PlumbWorld* world, void* data, size_t capacity, size_t* size);
} PlumbSnapshotTable;

#ifdef __cplusplus
}
#endif
#endif
