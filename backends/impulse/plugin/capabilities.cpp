// What impulse truly has.
#include "physics_revision.hpp"
#include "plugin/joint_rows.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

namespace {

struct Fact {
  PlumbDegree degree;
  const char* note = "";
};

constexpr Fact kYes{PLUMB_NATIVE};
constexpr Fact kNotYet{PLUMB_NONE, "not in impulse yet"};

/// Convex, or made of such: what may move freely.
bool is_solid(std::uint32_t type) {
  return type == PLUMB_SPHERE || type == PLUMB_BOX || type == PLUMB_CAPSULE || type == PLUMB_CYLINDER ||
         type == PLUMB_CONVEX_HULL || type == PLUMB_COMPOUND;
}
bool is_ground(std::uint32_t type) {
  return type == PLUMB_PLANE || type == PLUMB_TRIANGLE_MESH || type == PLUMB_HEIGHT_FIELD;
}

Fact shape_fact(std::uint32_t type, std::uint32_t motion) {
  if (motion >= PLUMB_MOTION_COUNT) return {PLUMB_NONE};
  if (is_solid(type)) return kYes;
  if (!is_ground(type)) return kNotYet;
  if (motion == PLUMB_STATIC) return kYes;
  if (type == PLUMB_PLANE) return {PLUMB_NONE, "planes do not move"};
  return motion == PLUMB_KINEMATIC ? kYes : Fact{PLUMB_NONE, "surfaces have no inside: use a hull or a compound"};
}

Fact pair_fact(std::uint32_t a, std::uint32_t b) {
  if ((is_solid(a) && (is_solid(b) || is_ground(b))) || (is_ground(a) && is_solid(b))) return kYes;
  return is_ground(a) && is_ground(b) ? Fact{PLUMB_NONE, "neither of them is pushed"} : kNotYet;
}

Fact need_fact(std::uint32_t index) {
  if (index >= PLUMB_NEED_COUNT) return {PLUMB_NONE};
  switch (PlumbNeeds{1} << index) {
    case PLUMB_NEED_ROTATION:
    case PLUMB_NEED_COLLISION:
    case PLUMB_NEED_FRICTION:
    case PLUMB_NEED_RESTITUTION:
    case PLUMB_NEED_JOINTS:
    case PLUMB_NEED_EVENTS:
    case PLUMB_NEED_CONTACTS:
    case PLUMB_NEED_CONTACT_IMPULSES:
    case PLUMB_NEED_KINEMATIC:
    case PLUMB_NEED_GYROSCOPIC:
    case PLUMB_NEED_DAMPING:
    case PLUMB_NEED_FORCES:
    case PLUMB_NEED_SLEEPING:
    case PLUMB_NEED_FILTERS:
    case PLUMB_NEED_AXIS_LOCKS:
    case PLUMB_NEED_CCD:
    case PLUMB_NEED_SENSORS:
    case PLUMB_NEED_QUERIES:
    case PLUMB_NEED_SURFACE_VELOCITY:
    case PLUMB_NEED_JOINT_REACTIONS:
    case PLUMB_NEED_SNAPSHOT: return kYes;
    default: return kNotYet;
  }
}

Fact field_fact(std::uint32_t field, bool writing) {
  if (field >= PLUMB_FIELD_COUNT) return {PLUMB_NONE};
  if (field == PLUMB_FIELD_MASS) return {writing ? PLUMB_NONE : PLUMB_NATIVE};
  const bool acts =
      (field >= PLUMB_FIELD_FORCE && field <= PLUMB_FIELD_IMPULSE_AT_POINT) || field == PLUMB_FIELD_KINEMATIC_TARGET;
  if (acts && !writing) return {PLUMB_NONE, "it acts and is spent"};
  return kYes;
}

/// Rays ask for no shape; what is cast or overlapped is convex.
Fact query_fact(std::uint32_t kind, std::uint32_t shape) {
  if (kind == PLUMB_QUERY_RAY)
    return {PLUMB_NATIVE, "convex shapes and planes are solid: a ray that starts inside hits at fraction 0"};
  if (kind >= PLUMB_QUERY_KIND_COUNT) return {PLUMB_NONE};
  if (is_ground(shape) || shape == PLUMB_COMPOUND) return {PLUMB_NONE, "what is cast or overlapped is convex"};
  return is_solid(shape) ? kYes : kNotYet;
}

Fact joint_fact(std::uint32_t type, std::uint32_t feature) {
  if (type >= PLUMB_JOINT_TYPE_COUNT || feature >= PLUMB_JOINT_FEATURE_COUNT) return {PLUMB_NONE};
  const bool on_an_axis = feature <= PLUMB_JOINT_HAS_SPRINGS;
  return on_an_axis && free_axes(type) == 0 ? Fact{PLUMB_NONE, "it leaves no axis free"} : kYes;
}

Fact phase_fact(std::uint32_t phase) {
  if (phase > PLUMB_PHASE_SOLVE && phase != PLUMB_PHASE_OUTPUT) return kNotYet;
  if (phase == PLUMB_PHASE_SOLVE) return {PLUMB_APPROXIMATE, "with integration: one kernel does both"};
  return {PLUMB_NATIVE, PhaseClock::kEvery == 1 ? "" : "of one step in sixteen"};
}

Fact event_fact(std::uint32_t event) {
  switch (event) {
    case PLUMB_EVENT_CONTACT_BEGIN:
    case PLUMB_EVENT_CONTACT_END:
    case PLUMB_EVENT_SENSOR_ENTER:
    case PLUMB_EVENT_SENSOR_LEAVE:
    case PLUMB_EVENT_WAKE:
    case PLUMB_EVENT_SLEEP:
    case PLUMB_EVENT_JOINT_BROKEN: return kYes;
    default: return kNotYet;
  }
}

Fact fact(PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  switch (kind) {
    case PLUMB_CAP_SHAPE: return shape_fact(a, b);
    case PLUMB_CAP_PAIR: return pair_fact(a, b);
    case PLUMB_CAP_QUERY: return query_fact(a, b);
    case PLUMB_CAP_CHILD_MATERIAL: return kYes;
    case PLUMB_CAP_FIELD_READ: return field_fact(a, false);
    case PLUMB_CAP_FIELD_WRITE: return field_fact(a, true);
    case PLUMB_CAP_NEED: return need_fact(a);
    case PLUMB_CAP_JOINT: return a < PLUMB_JOINT_TYPE_COUNT ? kYes : kNotYet;
    case PLUMB_CAP_JOINT_FEATURE: return joint_fact(a, b);
    case PLUMB_CAP_EVENT: return event_fact(a);
    case PLUMB_CAP_PHASE_TIME: return phase_fact(a);
    case PLUMB_CAP_SNAPSHOT:
    case PLUMB_CAP_HOST_JOBS: return kYes;
    default: return kNotYet;
  }
}

}  // namespace

PlumbDegree World::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
  const Fact found = fact(kind, a, b);
  note = found.note;
  return found.degree;
}

const PlumbBackendInfo& World::info() {
  static const PlumbBackendInfo info = {sizeof info,
                                        PLUMB_DETERMINISM_THREADS,
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
