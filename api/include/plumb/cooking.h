/* plumb.cooking/1: shapes worked out ahead, in a build step or on threads that load, and made from bytes in a world.
 * Since 1.2.
 *
 * What takes an engine long about a shape (a mesh's tree and who is whose neighbour, a hull, mass properties) is found
 * out once, without a world, and depends on the descriptor alone: no needs, settings or threads of a world change the
 * bytes, and what the same descriptor is cooked into is the same bytes every time. PLUMB_CAP_COOKING tells for which
 * types an engine's own work is in them.
 */
#ifndef PLUMB_COOKING_H
#define PLUMB_COOKING_H

#include "plumb/shapes.h"
#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_COOKING "plumb.cooking/1"

/* What cook gives. Set struct_size. */
typedef struct PlumbCooked {
  uint32_t struct_size;
  uint32_t reserved;
  const void* data;  /* the backend's, until release is given it; null when the result is below 0 */
  uint64_t size;     /* bytes */
  char message[256]; /* why not, when the result is below 0: one sentence that says what to do */
} PlumbCooked;

/* Bytes that cook gave, in the caller's memory, at any address. */
typedef struct PlumbCookedShape {
  uint32_t struct_size;
  uint32_t reserved;
  const void* data;
  uint64_t size; /* bytes */
} PlumbCookedShape;

typedef struct PlumbCookingTable {
  uint32_t struct_size;
  uint32_t reserved;
  /* [any] A descriptor is refused as create_shapes refuses it. Compounds are not cooked: cook their children, and
   * create the compound from the handles of these. user_data is not in the bytes. */
  PlumbResult (*cook)(const PlumbShapeDesc* desc, PlumbCooked* cooked);
  /* [any] Takes null. */
  void (*release)(const void* data);
  /* [world] As create_shapes does, all or none: a shape from bytes is to the bit what its descriptor would have made of
   * it, in steps, queries, snapshots and when it is modified. The bytes are copied before the call returns. stride is
   * sizeof the caller's row. PLUMB_E_CORRUPT for bytes that are torn, changed, of another backend, precision or byte
   * order, or of another version of the format: keep the descriptors, and cook anew. PLUMB_E_NOT_DECLARED where
   * materials by triangle ask for what the world's needs lack. */
  PlumbResult (*create)(PlumbWorld* world, const PlumbCookedShape* shapes, size_t stride, uint32_t count,
                        PlumbShape* ids);
} PlumbCookingTable;

#ifdef __cplusplus
}
#endif
#endif
