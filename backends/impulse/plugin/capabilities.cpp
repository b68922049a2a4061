// What impulse truly has.
#include <algorithm>

#include "plugin/physics_revision.hpp"
#include "plugin/world.hpp"
#include "plumb/backend/modify.hpp"
#include "plumb/backend/usual_capability.hpp"

namespace plumb::impulse {

namespace {

using backend::Capability;

Capability phase_time(std::uint32_t phase) {
  if (phase == PLUMB_PHASE_SOLVE) return {PLUMB_APPROXIMATE, "with integration: one kernel does both"};
  if (phase < PLUMB_PHASE_SOLVE || phase == PLUMB_PHASE_OUTPUT)
    return {PLUMB_NATIVE, PhaseClock::kEvery == 1 ? "" : "of one step in sixteen"};
  return {PLUMB_NONE, "not in impulse yet"};
}

Capability known(PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  switch (kind) {
    case PLUMB_CAP_NEED: return {a < PLUMB_NEED_COUNT ? PLUMB_NATIVE : PLUMB_NONE};
    case PLUMB_CAP_FIELD_READ:
    case PLUMB_CAP_FIELD_WRITE:
      if (a == PLUMB_FIELD_ROLLING_FRICTION) return {PLUMB_NATIVE};
      break;
    case PLUMB_CAP_JOINT:
      if (a == PLUMB_JOINT_SWING_TWIST || backend::is_meshing(a)) return {PLUMB_NATIVE};
      break;
    case PLUMB_CAP_JOINT_FEATURE:
      if (backend::is_meshing(a)) {
        if (b == PLUMB_JOINT_BREAKS || b == PLUMB_JOINT_HAS_REACTION) return {PLUMB_NATIVE};
        return {PLUMB_NONE, b < PLUMB_JOINT_FEATURE_COUNT ? "of the joints that its bodies are on" : ""};
      }
      if (b == PLUMB_JOINT_HAS_STIFFNESS || b == PLUMB_JOINT_HAS_TARGETS)
        return backend::usual_capability(kind, a, PLUMB_JOINT_HAS_SPRINGS);
      break;
    case PLUMB_CAP_QUERY:
      if (a == PLUMB_QUERY_RAY)
        return {PLUMB_NATIVE, "convex shapes and planes are solid: a ray that starts inside hits at fraction 0"};
      if (a < PLUMB_QUERY_KIND_COUNT && !backend::is_convex(b))
        return {PLUMB_NONE, "what is cast or overlapped is convex"};
      if (a == PLUMB_QUERY_PENETRATION || a == PLUMB_QUERY_TURNING_CAST) return {PLUMB_NATIVE};
      break;
    case PLUMB_CAP_CLOSEST:
      if (a < PLUMB_SHAPE_TYPE_COUNT && !backend::is_convex(a)) return {PLUMB_NONE, "what is looked around is convex"};
      break;
    case PLUMB_CAP_TRIANGLE_MATERIAL:
      return {a == PLUMB_TRIANGLE_MESH || a == PLUMB_HEIGHT_FIELD ? PLUMB_NATIVE : PLUMB_NONE};
    case PLUMB_CAP_COOKING: return {a == PLUMB_TRIANGLE_MESH || a == PLUMB_CONVEX_HULL ? PLUMB_NATIVE : PLUMB_NONE};
    case PLUMB_CAP_PHASE_TIME: return phase_time(a);
    case PLUMB_CAP_RESIDUAL: return {PLUMB_NONE, "not in impulse yet"};
    case PLUMB_CAP_MODIFY:
      if (a == 2) return {backend::may_change(b) ? PLUMB_NATIVE : PLUMB_NONE};
      return {a < 2 && b < (a == 0 ? PLUMB_MODIFY_BODY_COUNT : PLUMB_MODIFY_JOINT_COUNT) ? PLUMB_NATIVE : PLUMB_NONE};
    case PLUMB_CAP_MANIFOLD:
      if (1U << std::min(a, 31U) == PLUMB_MANIFOLD_RESTITUTION)
        return {PLUMB_NATIVE, "the point is where two are nearest as the step begins, not where they will touch"};
      return {a < PLUMB_MANIFOLD_CHANGE_COUNT ? PLUMB_NATIVE : PLUMB_NONE};
    case PLUMB_CAP_HOST_MEMORY:
#if defined(PLUMB_IMPULSE_CUDA)
      return {PLUMB_APPROXIMATE, "not what kernels work on, and its twins on the host: that is the driver's"};
#endif
    case PLUMB_CAP_SNAPSHOT:
    case PLUMB_CAP_HOST_JOBS: return {PLUMB_NATIVE};
    default: break;
  }
  return backend::usual_capability(kind, a, b);
}

}  // namespace

PlumbDegree World::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
  const Capability found = known(kind, a, b);
  note = found.note;
  return found.degree;
}

const PlumbBackendInfo& World::info() {
  // In double there is no device that it is held against.
  constexpr auto kDeterminism = sizeof(Real) == 8 ? PLUMB_DETERMINISM_THREADS : PLUMB_DETERMINISM_DEVICE;
  static const PlumbBackendInfo info = {sizeof info,
                                        kDeterminism,
                                        PLUMB_IMPULSE_NAME,
                                        "0.1",
                                        PLUMB_IMPULSE_BUILD " physics " PLUMB_IMPULSE_PHYSICS_REVISION_TEXT,
                                        "LBVH, SAT and sequential impulses: Plumb's own engine",
                                        Executor::device_name(),
                                        "",
                                        sizeof(Real) == 8 ? PLUMB_F64 : PLUMB_F32,
                                        Executor::max_threads()};
  return info;
}

}  // namespace plumb::impulse
