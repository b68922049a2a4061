// What most engines answer, so that an author names only what his own lacks or does otherwise.
#pragma once

#include "plumb/backend/names.hpp"
#include "plumb/plumb.h"

namespace plumb::backend {

/// A degree, and in one sentence how, or why not; "" where there is nothing to say.
struct Capability {
  PlumbDegree degree = PLUMB_NONE;
  const char* note = "";
};

/// Axes that a type of joint leaves free, or may leave free, as bits: three of translation, then three of rotation.
[[nodiscard]] constexpr std::uint32_t free_axes(PlumbJointType type) {
  constexpr std::uint32_t axes[PLUMB_JOINT_TYPE_COUNT] = {0b111000, 0b001000, 0b000001, 0b000001,
                                                          0,        0b011000, 0b111111};
  return type < PLUMB_JOINT_TYPE_COUNT ? axes[type] : 0;
}

/// Of an engine of rigid bodies that has all of the interface: NATIVE wherever the question means something. NONE of
/// numbers out of range, of what cannot be (a plane that moves, a limit on a joint that locks every axis, reading a
/// force, writing the mass), and of what an engine must do something for to have it: continuous collision, snapshots,
/// times of its phases but that of the output, a residual, tasks on the host's threads. NONE without a note is no
/// answer that helps a user: put a note where your engine lacks what others have.
[[nodiscard]] constexpr Capability usual_capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  constexpr Capability yes{PLUMB_NATIVE}, no{};
  const auto moves_alone = [](std::uint32_t type) { return is_convex(type) || type == PLUMB_COMPOUND; };
  const auto in_range = [](bool known) { return known ? Capability{PLUMB_NATIVE} : Capability{}; };
  switch (kind) {
    case PLUMB_CAP_SHAPE:
      if (a >= PLUMB_SHAPE_TYPE_COUNT || b >= PLUMB_MOTION_COUNT) return no;
      if (moves_alone(a) || b == PLUMB_STATIC) return yes;
      if (a == PLUMB_PLANE) return {PLUMB_NONE, "planes do not move"};
      return b == PLUMB_KINEMATIC ? yes : Capability{PLUMB_NONE, "a surface has no inside; use a hull or a compound"};
    case PLUMB_CAP_PAIR:
      if (a >= PLUMB_SHAPE_TYPE_COUNT || b >= PLUMB_SHAPE_TYPE_COUNT) return no;
      return moves_alone(a) || moves_alone(b) ? yes : Capability{PLUMB_NONE, "neither of the two can be dynamic"};
    case PLUMB_CAP_JOINT: return in_range(a < PLUMB_JOINT_TYPE_COUNT);
    case PLUMB_CAP_JOINT_FEATURE:
      if (a >= PLUMB_JOINT_TYPE_COUNT || b >= PLUMB_JOINT_FEATURE_COUNT) return no;
      if (b > PLUMB_JOINT_HAS_SPRINGS || free_axes(a) != 0) return yes;
      return {PLUMB_NONE, "it leaves no axis free"};
    case PLUMB_CAP_QUERY:
      if (a == PLUMB_QUERY_RAY) return yes;
      return in_range(a < PLUMB_QUERY_KIND_COUNT && b < PLUMB_SHAPE_TYPE_COUNT && is_convex(b));
    case PLUMB_CAP_FIELD_READ:
    case PLUMB_CAP_FIELD_WRITE: {
      if (a >= PLUMB_FIELD_COUNT) return no;
      const bool reads = kind == PLUMB_CAP_FIELD_READ;
      if (a == PLUMB_FIELD_MASS) return reads ? yes : Capability{PLUMB_NONE, "it follows from shapes and density"};
      const bool acts =
          (a >= PLUMB_FIELD_FORCE && a <= PLUMB_FIELD_IMPULSE_AT_POINT) || a == PLUMB_FIELD_KINEMATIC_TARGET;
      return reads && acts ? Capability{PLUMB_NONE, "it acts and is spent"} : yes;
    }
    case PLUMB_CAP_NEED: {
      constexpr PlumbNeeds own_work = PLUMB_NEED_CCD | PLUMB_NEED_SNAPSHOT;
      return in_range(a < PLUMB_NEED_COUNT && (PlumbNeeds{1} << a & own_work) == 0);
    }
    case PLUMB_CAP_EVENT: return in_range(a < PLUMB_EVENT_COUNT);
    case PLUMB_CAP_PHASE_TIME: return in_range(a == PLUMB_PHASE_OUTPUT);
    case PLUMB_CAP_CHILD_MATERIAL: return yes;
    default: return no;
  }
}

}  // namespace plumb::backend
