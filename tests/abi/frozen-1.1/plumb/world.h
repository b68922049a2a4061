/* A world, its step, and what comes out of a step: the report, contacts and events. */
#ifndef PLUMB_WORLD_H
#define PLUMB_WORLD_H

#include "plumb/bodies.h"
#include "plumb/settings.h"
#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a scene needs. A backend may leave out all the rest; using what was not declared is PLUMB_E_NOT_DECLARED,
 * declaring what the engine lacks (PLUMB_CAP_NEED is none) makes create_world fail with PLUMB_E_UNSUPPORTED. */
typedef uint64_t PlumbNeeds;
#define PLUMB_NEED_ROTATION ((PlumbNeeds)1 << 0)
#define PLUMB_NEED_COLLISION ((PlumbNeeds)1 << 1)
#define PLUMB_NEED_FRICTION ((PlumbNeeds)1 << 2)
#define PLUMB_NEED_RESTITUTION ((PlumbNeeds)1 << 3)
#define PLUMB_NEED_JOINTS ((PlumbNeeds)1 << 4)
#define PLUMB_NEED_CCD ((PlumbNeeds)1 << 5)
#define PLUMB_NEED_SLEEPING ((PlumbNeeds)1 << 6)
#define PLUMB_NEED_EVENTS ((PlumbNeeds)1 << 7)           /* contact, sleep and joint events */
#define PLUMB_NEED_CONTACTS ((PlumbNeeds)1 << 8)         /* contact points can be read after a step */
#define PLUMB_NEED_CONTACT_IMPULSES ((PlumbNeeds)1 << 9) /* and carry their impulses */
#define PLUMB_NEED_SENSORS ((PlumbNeeds)1 << 10)
#define PLUMB_NEED_KINEMATIC ((PlumbNeeds)1 << 11)
#define PLUMB_NEED_GYROSCOPIC ((PlumbNeeds)1 << 12) /* the term -w x I w of bodies that are not isotropic */
#define PLUMB_NEED_DAMPING ((PlumbNeeds)1 << 13)
#define PLUMB_NEED_FORCES ((PlumbNeeds)1 << 14) /* forces, torques and impulses from the host */
#define PLUMB_NEED_AXIS_LOCKS ((PlumbNeeds)1 << 15)
#define PLUMB_NEED_FILTERS ((PlumbNeeds)1 << 16) /* filters other than "everything touches everything" */
#define PLUMB_NEED_QUERIES ((PlumbNeeds)1 << 17)
#define PLUMB_NEED_SURFACE_VELOCITY ((PlumbNeeds)1 << 18)
#define PLUMB_NEED_JOINT_REACTIONS ((PlumbNeeds)1 << 19)
#define PLUMB_NEED_SNAPSHOT ((PlumbNeeds)1 << 20)
#define PLUMB_NEED_COUNT 21
#define PLUMB_NEED_ALL (((PlumbNeeds)1 << PLUMB_NEED_COUNT) - 1)

typedef struct PlumbWorldDesc {
  uint32_t struct_size;
  uint32_t threads; /* how many the world may use; 0 is 1. More than the engine can use is not an error */
  PlumbNeeds needs;
  PlumbVec3 gravity;      /* m/s2 */
  uint32_t body_capacity; /* hints; 0 is unknown */
  uint32_t contact_capacity;
  uint32_t joint_capacity;
  uint32_t setting_count;
  const PlumbSetting* settings; /* set before anything else happens; the only way for creation-only settings */
} PlumbWorldDesc;

typedef struct PlumbStepDesc {
  uint32_t struct_size;
  uint32_t reserved;
  double dt; /* s, > 0 */
} PlumbStepDesc;

/* Phases of a step for which a backend may report its time. */
typedef uint32_t PlumbPhase;
enum {
  PLUMB_PHASE_BROAD = 0,     /* bounds and candidate pairs */
  PLUMB_PHASE_NARROW = 1,    /* contacts of candidate pairs */
  PLUMB_PHASE_ISLANDS = 2,   /* graph, colouring, sleeping */
  PLUMB_PHASE_SOLVE = 3,     /* joints and contacts */
  PLUMB_PHASE_INTEGRATE = 4, /* forces to velocities to poses */
  PLUMB_PHASE_CONTINUOUS = 5,
  PLUMB_PHASE_OUTPUT = 6, /* events, contacts and state rows */
  PLUMB_PHASE_COUNT = 8   /* room for one more */
};

/* The host sets struct_size; the backend fills the rest. NaN stands for "not known". */
typedef struct PlumbStepReport {
  uint32_t struct_size;
  uint32_t threads;  /* used by this step */
  uint64_t step;     /* steps done since the world was made */
  uint32_t bodies;   /* alive, all motions */
  uint32_t awake;    /* dynamic bodies not asleep */
  uint32_t pairs;    /* candidate pairs of the broad phase; UINT32_MAX when not known */
  uint32_t contacts; /* points */
  uint32_t joints;
  uint32_t dropped;   /* contacts, pairs or events that the engine found and lost */
  uint32_t nonfinite; /* dynamic bodies whose pose or velocity is NaN or infinite */
  uint32_t remarks;   /* PlumbStepRemark bits */
  double residual;    /* of the engine's own solver, in its own measure */
  double phase_seconds[PLUMB_PHASE_COUNT];
} PlumbStepReport;

/* PlumbStepReport.remarks */
enum {
  PLUMB_REMARK_SOLVER_FELL_BACK = 1u << 0, /* the chosen solver gave up and another finished the step */
  PLUMB_REMARK_CAPACITY_GREW = 1u << 1,
  PLUMB_REMARK_STEP_REPEATED = 1u << 2,
  PLUMB_REMARK_ENERGY_BOUNDED = 1u << 3 /* it would have made energy: solved again finer, or the gain taken out */
};

/* One contact point as the last step solved it: geometry at detection, impulse summed over the step. */
typedef struct PlumbContact {
  PlumbBody body_a, body_b;
  uint32_t child_a, child_b; /* child of a compound, triangle of a mesh; else 0 */
  PlumbVec3 position;        /* world, m; between the two surfaces, where is the engine's choice */
  PlumbVec3 normal;          /* unit, from a to b */
  double depth;              /* m; positive: overlap, negative: gap */
  double normal_impulse;     /* N s on b along the normal; NaN where the engine does not tell */
  PlumbVec3 tangent_impulse; /* N s on b, world axes; NaN where the engine does not tell */
  uint64_t feature;          /* equal from step to step for the same pair of features; 0: not known */
} PlumbContact;

typedef uint32_t PlumbEventType;
enum {
  PLUMB_EVENT_CONTACT_BEGIN = 0, /* body_a, body_b began to touch */
  PLUMB_EVENT_CONTACT_END = 1,   /* also when one of them was destroyed: its handle is stale by then */
  PLUMB_EVENT_SENSOR_ENTER = 2,  /* body_a is the sensor */
  PLUMB_EVENT_SENSOR_LEAVE = 3,
  PLUMB_EVENT_WAKE = 4,         /* body_a */
  PLUMB_EVENT_SLEEP = 5,        /* body_a */
  PLUMB_EVENT_JOINT_BROKEN = 6, /* joint; it is gone from the step on */
  PLUMB_EVENT_COUNT = 7
};

/* In the order: type, then body_a's slot, then body_b's slot, then the joint's slot. */
typedef struct PlumbEvent {
  PlumbEventType type;
  uint32_t reserved;
  PlumbBody body_a, body_b;
  PlumbJoint joint;
} PlumbEvent;

#ifdef __cplusplus
}
#endif
#endif
