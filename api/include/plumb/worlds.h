/* plumb.worlds/1: many worlds of one backend whose steps are taken together. Since 1.2. */
#ifndef PLUMB_WORLDS_H
#define PLUMB_WORLDS_H

#include "plumb/state.h"
#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_WORLDS "plumb.worlds/1"

/* A device takes thousands of small worlds in the time of one, if it is given their steps at once. */
typedef struct PlumbWorldsTable {
  uint32_t struct_size;
  uint32_t reserved;
  /* [world, each of them] From now on the steps of this world and of the others are taken together: what step begins
   * may not run before one of them is waited for, and runs then with what the others have begun. So begin the step of
   * each, on any threads, and then wait for each; a world that takes no part is left out by not stepping it. No result
   * changes, and each world is called, reports and is destroyed as before. others: worlds of the same backend, all
   * different, none within a step (PLUMB_E_WRONG_PHASE); count 0: this one is by itself again. Who was in another group
   * leaves it. A backend on which that is no gain does nothing. */
  PlumbResult (*group)(PlumbWorld* world, PlumbWorld* const* others, uint32_t count);
  /* [world, each of its group] As borrow of plumb.state/1, of all worlds of the group: worlds x rows x columns, this
   * world first and the others as they were named. Whose rows they are tells each world's plumb.state/1. All must have
   * as many rows, and none may be gone since. Of a world in no group its own. */
  PlumbResult (*borrow_all)(PlumbWorld* world, const PlumbStateRequest* request, PlumbDLManagedTensor** tensor,
                            PlumbFence* fence);
} PlumbWorldsTable;

#ifdef __cplusplus
}
#endif
#endif
