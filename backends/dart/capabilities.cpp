// What DART has, and how truly.
#include <algorithm>

#include "plumb/backend/usual_capability.hpp"
#include "world.hpp"

namespace plumb::dart6 {
namespace {

using backend::Capability;

constexpr Capability kNoSleep{PLUMB_NONE, "nobody sleeps in this version of DART"};
constexpr Capability kHollow{PLUMB_APPROXIMATE,
                             "the triangles of its surface, hollow: edges catch, points come and go"};
constexpr Capability kNoQuery{PLUMB_NONE, "DART has neither shape casts nor overlaps of a shape that no body has"};

constexpr Capability kRays{
    PLUMB_NATIVE, "by the geoms of DART's detector of ODE; of a body in which it starts a ray sees the far side"};

bool is_triangles(std::uint32_t type) {
  return type == PLUMB_CONVEX_HULL || type == PLUMB_TRIANGLE_MESH || type == PLUMB_HEIGHT_FIELD;
}

Capability shape_fact(std::uint32_t type, std::uint32_t motion) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_SHAPE, type, motion);
  if (usual.degree == PLUMB_NONE) return usual;
  if (type == PLUMB_CONVEX_HULL) return kHollow;
  if (type == PLUMB_HEIGHT_FIELD) return {PLUMB_EMULATED, "as a triangle mesh"};
  if (type == PLUMB_COMPOUND) return {PLUMB_NATIVE, "several shapes of one body"};
  return usual;
}

Capability pair_fact(std::uint32_t a, std::uint32_t b) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_PAIR, a, b);
  if (usual.degree == PLUMB_NONE) return usual;
  if (is_triangles(a) || is_triangles(b)) return kHollow;
  return usual;
}

Capability joint_fact(std::uint32_t type) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_JOINT, type, 0);
  if (usual.degree == PLUMB_NONE) return usual;
  if (type == PLUMB_JOINT_DISTANCE) return {PLUMB_EMULATED, "a row of the adapter in DART's equations"};
  return {PLUMB_NATIVE,
          "of a tree, without error; those that close a loop are rows of the adapter in DART's equations, without "
          "limits, motors and springs"};
}

Capability joint_feature_fact(std::uint32_t type, std::uint32_t feature) {
  if (const Capability joint = joint_fact(type); joint.degree == PLUMB_NONE) return joint;
  if (feature == PLUMB_JOINT_HAS_STIFFNESS || feature == PLUMB_JOINT_HAS_TARGETS) feature = PLUMB_JOINT_HAS_SPRINGS;
  const Capability usual = backend::usual_capability(PLUMB_CAP_JOINT_FEATURE, type, feature);
  if (usual.degree == PLUMB_NONE) return usual;
  if (type == PLUMB_JOINT_DISTANCE) {
    if (feature == PLUMB_JOINT_HAS_MOTORS) return {PLUMB_NONE, "rods have none"};
    if (feature < PLUMB_JOINT_BREAKS) return {PLUMB_EMULATED, "rows of the adapter"};
  }
  if (feature == PLUMB_JOINT_HAS_MOTORS) return {PLUMB_NATIVE, "servo actuators"};
  if (feature == PLUMB_JOINT_BREAKS) return {PLUMB_EMULATED, "by the mean of the reaction over a step"};
  return usual;
}

Capability need_fact(std::uint32_t index) {
  switch (PlumbNeeds{1} << std::min<std::uint32_t>(index, 63)) {
    case PLUMB_NEED_CCD: return {PLUMB_NONE, "DART looks at where bodies are alone"};
    case PLUMB_NEED_SLEEPING: return kNoSleep;
    case PLUMB_NEED_FRICTION:
      return {PLUMB_APPROXIMATE,
              "a pyramid of two directions instead of Coulomb's cone; a contact may stick on the diagonal"};
    case PLUMB_NEED_SURFACE_VELOCITY: return {PLUMB_EMULATED, "as the sliding speed that a contact's friction wants"};
    case PLUMB_NEED_DAMPING: return {PLUMB_EMULATED, "a force of the adapter in each sub-step"};
    case PLUMB_NEED_AXIS_LOCKS: return {PLUMB_EMULATED, "rows of the adapter in DART's equations"};
    case PLUMB_NEED_KINEMATIC:
      return {PLUMB_EMULATED, "free joints that are told their speed, and put where they should be"};
    case PLUMB_NEED_EVENTS:
    case PLUMB_NEED_SENSORS: return {PLUMB_EMULATED, "by comparing who touches in one step with who does in the next"};
    case PLUMB_NEED_SNAPSHOT: return {PLUMB_NATIVE};
    default: return backend::usual_capability(PLUMB_CAP_NEED, index, 0);
  }
}

Capability field_fact(PlumbCapability kind, std::uint32_t field) {
  if (field == PLUMB_FIELD_AWAKE && kind == PLUMB_CAP_FIELD_WRITE) return kNoSleep;
  if (field == PLUMB_FIELD_KINEMATIC_TARGET && kind == PLUMB_CAP_FIELD_WRITE)
    return {PLUMB_EMULATED, "the velocity that leads there"};
  if (field == PLUMB_FIELD_GRAVITY_SCALE) return {PLUMB_EMULATED, "what is more or less than 1 as a force"};
  return backend::usual_capability(kind, field, 0);
}

Capability fact(PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  switch (kind) {
    case PLUMB_CAP_SHAPE: return shape_fact(a, b);
    case PLUMB_CAP_PAIR: return pair_fact(a, b);
    case PLUMB_CAP_JOINT: return joint_fact(a);
    case PLUMB_CAP_JOINT_FEATURE: return joint_feature_fact(a, b);
    case PLUMB_CAP_QUERY: return a == PLUMB_QUERY_RAY ? kRays : kNoQuery;
    case PLUMB_CAP_CLOSEST: return {PLUMB_NONE, "DART's detector of ODE tells no distances"};
    case PLUMB_CAP_FIELD_READ:
    case PLUMB_CAP_FIELD_WRITE: return field_fact(kind, a);
    case PLUMB_CAP_NEED: return need_fact(a);
    case PLUMB_CAP_EVENT:
      if (a == PLUMB_EVENT_WAKE || a == PLUMB_EVENT_SLEEP) return kNoSleep;
      return {a < PLUMB_EVENT_COUNT ? PLUMB_EMULATED : PLUMB_NONE};
    case PLUMB_CAP_PHASE_TIME: return {};
    case PLUMB_CAP_SNAPSHOT: return {PLUMB_NATIVE};
    default: return backend::usual_capability(kind, a, b);
  }
}

}  // namespace

PlumbDegree World::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
  const Capability answer = fact(kind, a, b);
  note = answer.note;
  return answer.degree;
}

}  // namespace plumb::dart6
