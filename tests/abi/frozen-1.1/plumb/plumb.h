/* Plumb: a stable interface to rigid-body physics engines.
 *
 * This header and those that it includes are the whole wall between a host and a backend. A backend is a shared library
 * that exports one symbol, plumb_backend_open; all else is reached through tables of functions.
 *
 * Thread tags: [world] one caller at a time per world; [query] any number at once while no step runs; [any] always.
 * Every struct that may grow starts with struct_size, which the caller sets to sizeof; arrays of descriptors carry the
 * caller's stride. So a host and a backend built against different minor versions understand each other.
 */
#ifndef PLUMB_PLUMB_H
#define PLUMB_PLUMB_H

#include "plumb/bodies.h"
#include "plumb/collide.h"
#include "plumb/debug.h"
#include "plumb/exceptions.h"
#include "plumb/joints.h"
#include "plumb/queries.h"
#include "plumb/settings.h"
#include "plumb/shapes.h"
#include "plumb/snapshot.h"
#include "plumb/state.h"
#include "plumb/types.h"
#include "plumb/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- what the host lends ------------------------------------------------------------------------------------- */

typedef uint32_t PlumbLogLevel;
enum { PLUMB_LOG_DEBUG = 0, PLUMB_LOG_INFO = 1, PLUMB_LOG_WARNING = 2, PLUMB_LOG_ERROR = 3 };

typedef void (*PlumbTask)(void* context, uint32_t index);

/* Lives as long as the process. Every pointer may be null: a backend works without any of it. */
typedef struct PlumbHost {
  uint32_t struct_size;
  uint32_t worker_count; /* threads behind run, the caller's included; 0: run is null */
  void* user;
  /* [any] One line, no newline at its end. */
  void (*log)(void* user, PlumbLogLevel level, const char* line);
  /* [any] Calls task(context, i) for every i < count, in any order and on any thread, and returns when all are done. */
  void (*run)(void* user, PlumbTask task, void* context, uint32_t count);
} PlumbHost;

/* --- what a backend is --------------------------------------------------------------------------------------- */

/* From run to run of the same program on the same machine, each level including those before. */
typedef uint32_t PlumbDeterminism;
enum {
  PLUMB_DETERMINISM_NONE = 0,
  PLUMB_DETERMINISM_RUN = 1,     /* the same calls give the same bits */
  PLUMB_DETERMINISM_THREADS = 2, /* for any number of threads */
  PLUMB_DETERMINISM_DEVICE = 3   /* on the CPU and on the GPU */
};

typedef struct PlumbBackendInfo {
  uint32_t struct_size;
  PlumbDeterminism determinism;
  const char* name;            /* "bullet": what a user types */
  const char* version;         /* of the engine: "3.24" */
  const char* build;           /* changes whenever the results or times of this library may: version, compiler, flags */
  const char* description;     /* one line */
  const char* device;          /* "cpu" or the device's name */
  const char* exclusion_group; /* two backends of one group cannot be open in one process; "" for none */
  PlumbDataType precision;     /* of the engine's arithmetic */
  uint32_t max_threads;        /* that a world can use */
} PlumbBackendInfo;

/* Questions to PlumbBackendTable.capability: kind, and up to two arguments. */
typedef uint32_t PlumbCapability;
enum {
  PLUMB_CAP_SHAPE = 0, /* shape type, motion */
  PLUMB_CAP_PAIR = 1,  /* shape type, shape type (symmetric); the first may be dynamic: contacts and their solution */
  PLUMB_CAP_JOINT = 2, /* joint type */
  PLUMB_CAP_JOINT_FEATURE = 3, /* joint type, PlumbJointFeature */
  PLUMB_CAP_QUERY = 4,         /* PlumbQueryKind, shape type that is cast or overlapped (0 for rays) */
  PLUMB_CAP_FIELD_READ = 5,    /* field */
  PLUMB_CAP_FIELD_WRITE = 6,   /* field */
  PLUMB_CAP_NEED = 7,          /* index of a PLUMB_NEED_ bit */
  PLUMB_CAP_EVENT = 8,         /* event type */
  PLUMB_CAP_PHASE_TIME = 9,    /* PlumbPhase */
  PLUMB_CAP_RESIDUAL = 10,
  PLUMB_CAP_SNAPSHOT = 11,
  PLUMB_CAP_HOST_JOBS = 12,      /* runs its tasks on PlumbHost.run */
  PLUMB_CAP_CHILD_MATERIAL = 13, /* materials of compound children */
  PLUMB_CAP_COUNT = 14
};

typedef struct PlumbBackendTable {
  uint32_t struct_size;
  uint32_t version; /* that was negotiated */

  /* [any] Lives as long as the process. */
  const PlumbBackendInfo* (*info)(void);
  /* [any] What is unknown to the backend is PLUMB_NONE. note (may be null) receives a sentence or "", never null;
   * it lives as long as the process. */
  PlumbDegree (*capability)(PlumbCapability kind, uint32_t a, uint32_t b, const char** note);
  /* [any] The table of an extension ("plumb.joints/1"), or null. Lives as long as the process. */
  const void* (*extension)(const char* name);

  /* [any] */
  PlumbResult (*create_world)(const PlumbWorldDesc* desc, PlumbWorld** world);
  /* [world] Takes null. All handles of the world are gone; lent state lives on. */
  void (*destroy_world)(PlumbWorld* world);
  /* [any] Text of the last failure: of this world, or with null of this thread's last create_world. Never null;
   * lives until the next call on the world. */
  const char* (*error_text)(PlumbWorld* world);

  /* Shapes and bodies. [world] All or none. stride is sizeof the caller's descriptor. Destroying a shape that a body
   * or compound still uses is PLUMB_E_IN_USE, and so is destroying a body that still has joints. */
  PlumbResult (*create_shapes)(PlumbWorld* world, const PlumbShapeDesc* descs, size_t stride, uint32_t count,
                               PlumbShape* ids);
  PlumbResult (*destroy_shapes)(PlumbWorld* world, const PlumbShape* ids, uint32_t count);
  PlumbResult (*create_bodies)(PlumbWorld* world, const PlumbBodyDesc* descs, size_t stride, uint32_t count,
                               PlumbBody* ids);
  PlumbResult (*destroy_bodies)(PlumbWorld* world, const PlumbBody* ids, uint32_t count);
  /* [world] Live bodies in order of creation. */
  PlumbResult (*list_bodies)(PlumbWorld* world, PlumbBody* ids, uint32_t capacity, uint32_t* count);
  /* [world] user_data of the descriptor. */
  PlumbResult (*user_data)(PlumbWorld* world, PlumbBody id, uint64_t* user_data);

  /* [world] One row a body. ids null: the first count live bodies in order of creation. stride: bytes between rows. */
  PlumbResult (*read)(PlumbWorld* world, PlumbField field, PlumbDataType type, const PlumbBody* ids, uint32_t count,
                      void* rows, size_t stride);
  PlumbResult (*write)(PlumbWorld* world, PlumbField field, PlumbDataType type, const PlumbBody* ids, uint32_t count,
                       const void* rows, size_t stride);
  /* [world] m/s2 */
  PlumbResult (*set_gravity)(PlumbWorld* world, const PlumbVec3* gravity);

  /* [world] step begins a step and may return before it is done; until wait returns, nothing else may be called.
   * wait fills the report (may be null). */
  PlumbResult (*step)(PlumbWorld* world, const PlumbStepDesc* desc);
  PlumbResult (*wait)(PlumbWorld* world, PlumbStepReport* report);

  /* [world] Of the last step. out[capacity]; *count is how many there are, also when PLUMB_TRUNCATED.
   * stride is sizeof the caller's row. Events also hold what destroying bodies since the step before has ended. */
  PlumbResult (*contacts)(PlumbWorld* world, PlumbContact* out, size_t stride, uint32_t capacity, uint32_t* count);
  PlumbResult (*events)(PlumbWorld* world, PlumbEvent* out, size_t stride, uint32_t capacity, uint32_t* count);
} PlumbBackendTable;

/* --- negotiation --------------------------------------------------------------------------------------------- */

typedef struct PlumbOpenRequest {
  uint32_t struct_size;
  uint32_t min_version, max_version; /* what the host can speak */
  uint32_t reserved;
  const PlumbHost* host; /* may be null */
} PlumbOpenRequest;

typedef struct PlumbOpenReply {
  uint32_t struct_size;
  uint32_t version; /* chosen, within the range of the request */
  const PlumbBackendTable* table;
  char message[256]; /* why not, when the result is below 0: one sentence that says what to do */
} PlumbOpenReply;

/* The one symbol of a backend. [any] May be called again: the same table comes back for the same version. */
#define PLUMB_OPEN_SYMBOL "plumb_backend_open"
PLUMB_EXPORT PlumbResult plumb_backend_open(const PlumbOpenRequest* request, PlumbOpenReply* reply);
typedef PlumbResult (*PlumbOpenFunction)(const PlumbOpenRequest* request, PlumbOpenReply* reply);

#ifdef __cplusplus
}
#endif
#endif
