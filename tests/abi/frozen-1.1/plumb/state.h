/* plumb.state/1: state rows lent without a copy, as DLPack tensors (the 1.x versioned layout of dmlc/dlpack). */
#ifndef PLUMB_STATE_H
#define PLUMB_STATE_H

#include "plumb/bodies.h"
#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_STATE "plumb.state/1"

/* Binary layout of DLPack 1.x, declared here so that nobody needs its header; a host casts to its own DLPack type. */
typedef struct PlumbDLDevice {
  int32_t device_type; /* kDLCPU 1, kDLCUDA 2 */
  int32_t device_id;
} PlumbDLDevice;

typedef struct PlumbDLDataType {
  uint8_t code; /* kDLFloat 2 */
  uint8_t bits;
  uint16_t lanes;
} PlumbDLDataType;

typedef struct PlumbDLTensor {
  void* data;
  PlumbDLDevice device;
  int32_t ndim;
  PlumbDLDataType dtype;
  int64_t* shape;
  int64_t* strides; /* in elements */
  uint64_t byte_offset;
} PlumbDLTensor;

typedef struct PlumbDLManagedTensor {
  struct {
    uint32_t major, minor;
  } version;
  void* manager_ctx;
  void (*deleter)(struct PlumbDLManagedTensor* self); /* [any] also after the world is gone */
  uint64_t flags;                                     /* bit 0: read only, bit 1: is a copy */
  PlumbDLTensor dl_tensor;
} PlumbDLManagedTensor;

/* When the rows may be read. On the host both are null and the rows are ready. */
typedef struct PlumbFence {
  void* stream; /* cudaStream_t that wrote the rows */
  void* event;  /* cudaEvent_t recorded after it */
} PlumbFence;

typedef struct PlumbStateRequest {
  uint32_t struct_size;
  PlumbField field;    /* pose or velocity */
  int32_t device_type; /* 1 host, 2 CUDA */
  uint32_t allow_copy; /* 0: fail with PLUMB_E_UNSUPPORTED rather than copy; 1: copy and answer PLUMB_COPIED */
} PlumbStateRequest;

typedef struct PlumbStateTable {
  uint32_t struct_size;
  uint32_t reserved;
  /* [world] Rows x columns in the engine's type. The rows stay as they are until the next step; the caller calls
   * the tensor's deleter when done. fence may be null. */
  PlumbResult (*borrow)(PlumbWorld* world, const PlumbStateRequest* request, PlumbDLManagedTensor** tensor,
                        PlumbFence* fence);
  /* [world] Which body each row is (0: none). *generation changes whenever the map does. */
  PlumbResult (*rows)(PlumbWorld* world, PlumbBody* ids, uint32_t capacity, uint32_t* count, uint64_t* generation);
} PlumbStateTable;

#ifdef __cplusplus
}
#endif
#endif
