/* Plain values that cross the wall: results, handles, vectors, poses.
 *
 * SI units throughout: metres, kilograms, seconds, radians. Right-handed axes. Quaternions are x y z w, unit length.
 * Everything here is C11 and compiles unchanged as C++17 and later.
 */
#ifndef PLUMB_TYPES_H
#define PLUMB_TYPES_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The revision of this interface. Minor versions only append; nothing that is here moves or changes its meaning. */
#define PLUMB_MAKE_VERSION(major, minor) (((uint32_t)(major) << 16) | (uint32_t)(minor))
#define PLUMB_VERSION_MAJOR(version) ((uint32_t)(version) >> 16)
#define PLUMB_VERSION_MINOR(version) ((uint32_t)(version)&0xffffu)
#define PLUMB_VERSION PLUMB_MAKE_VERSION(1, 1)

#if defined(_WIN32)
#define PLUMB_EXPORT __declspec(dllexport)
#else
#define PLUMB_EXPORT __attribute__((visibility("default")))
#endif

/* 0: done. Above 0: done, with a remark. Below 0: failed and nothing changed,
 * except after WORLD_LOST and DEVICE_LOST, when only destroying the world and reading the error text remain legal. */
typedef int32_t PlumbResult;
enum {
  PLUMB_OK = 0,
  PLUMB_TRUNCATED = 1, /* the caller's array was too short: it is full, and the count says how many there are */
  PLUMB_GROWN = 2,     /* a capacity had to grow; this call cost more than usual */
  PLUMB_COPIED = 3,    /* state was copied because it could not be lent */

  PLUMB_E_INVALID_ARGUMENT = -1, /* a value out of its range, not finite, or a null where none is allowed */
  PLUMB_E_STALE_HANDLE = -2,     /* the handle never existed here, or its object is gone */
  PLUMB_E_UNSUPPORTED = -3,      /* the engine cannot do this; the text says what is missing */
  PLUMB_E_NOT_DECLARED = -4,     /* needs a bit that PlumbWorldDesc.needs did not declare */
  PLUMB_E_OUT_OF_MEMORY = -5,
  PLUMB_E_WRONG_PHASE = -6,  /* for example a read between step and wait */
  PLUMB_E_WRONG_THREAD = -7, /* two callers at a time where only one is allowed */
  PLUMB_E_VERSION = -8,      /* host and backend have no interface version in common */
  PLUMB_E_EXCLUDED = -9,     /* a backend of the same exclusion group is already open in this process */
  PLUMB_E_IN_USE = -10,      /* the shape still has bodies, or the body still has joints */
  PLUMB_E_CORRUPT = -11,     /* a snapshot or trace that is foreign, torn or of another version */
  PLUMB_E_INTERNAL = -12,    /* an exception inside the backend; its text is the error text */
  PLUMB_E_WORLD_LOST = -13,
  PLUMB_E_DEVICE_LOST = -14
};

/* Handles are values: the slot in the low 32 bits, the slot's generation (from 1) in the high 32. 0 is no object.
 * A handle of a destroyed object stays stale for ever and is answered with PLUMB_E_STALE_HANDLE. */
typedef uint64_t PlumbShape;
typedef uint64_t PlumbBody;
typedef uint64_t PlumbJoint;

typedef struct PlumbVec3 {
  double x, y, z;
} PlumbVec3;

typedef struct PlumbQuat {
  double x, y, z, w;
} PlumbQuat;

/* A rigid placement: a point p of the local frame is at position + orientation * p. */
typedef struct PlumbPose {
  PlumbVec3 position;    /* m */
  PlumbQuat orientation; /* unit */
} PlumbPose;

/* How truly an engine has a thing. Ordered: a larger value is better. */
typedef int32_t PlumbDegree;
enum {
  PLUMB_NONE = 0,        /* absent: asking for it is PLUMB_E_UNSUPPORTED */
  PLUMB_APPROXIMATE = 1, /* there, with a meaning that differs from the interface's; the note says how */
  PLUMB_EMULATED = 2,    /* there with the right meaning, made by the adapter out of other things */
  PLUMB_NATIVE = 3
};

typedef uint32_t PlumbDataType;
enum { PLUMB_F32 = 1, PLUMB_F64 = 2 };

/* Opaque: made and owned by a backend. */
typedef struct PlumbWorld PlumbWorld;

#ifdef __cplusplus
}
#endif
#endif
