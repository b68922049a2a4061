// What MuJoCo has, and how truly.
#include <algorithm>

#include "plumb/backend/usual_capability.hpp"
#include "world.hpp"

namespace plumb::mujoco {
namespace {

using backend::Capability;
constexpr Capability kNoMesh{PLUMB_NONE, "MuJoCo takes the hull of a mesh; use hulls or a compound of them"};
constexpr Capability kNoSleep{PLUMB_NONE, "nobody sleeps in this version of MuJoCo"};
constexpr Capability kOnePoint{PLUMB_APPROXIMATE,
                               "one point of contact in a step, on which flat faces rock; multiccd finds more"};

Capability shape_fact(std::uint32_t type, std::uint32_t motion) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_SHAPE, type, motion);
  if (usual.degree == PLUMB_NONE) return usual;
  if (type == PLUMB_TRIANGLE_MESH) return kNoMesh;
  if (type == PLUMB_HEIGHT_FIELD)
    return motion == PLUMB_STATIC ? usual : Capability{PLUMB_NONE, "height fields stand still"};
  if (type == PLUMB_COMPOUND) return {PLUMB_NATIVE, "several geoms of one body"};
  return usual;
}

Capability pair_fact(std::uint32_t a, std::uint32_t b) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_PAIR, a, b);
  if (usual.degree == PLUMB_NONE) return usual;
  if (a == PLUMB_TRIANGLE_MESH || b == PLUMB_TRIANGLE_MESH) return kNoMesh;
  const auto by_mpr = [](std::uint32_t type) { return type == PLUMB_CYLINDER || type == PLUMB_CONVEX_HULL; };
  const auto is_plane_or_ball = [](std::uint32_t type) { return type == PLUMB_PLANE || type == PLUMB_SPHERE; };
  if ((by_mpr(a) && !is_plane_or_ball(b)) || (by_mpr(b) && !is_plane_or_ball(a))) return kOnePoint;
  if (a == PLUMB_HEIGHT_FIELD || b == PLUMB_HEIGHT_FIELD)
    return {PLUMB_APPROXIMATE, "prisms below the field's triangles, each with one point of contact"};
  return usual;
}

Capability joint_fact(std::uint32_t type) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_JOINT, type, 0);
  if (type == PLUMB_JOINT_DISTANCE) return {PLUMB_NATIVE, "a tendon between two points, a soft constraint"};
  if (type == PLUMB_JOINT_BALL || type == PLUMB_JOINT_HINGE || type == PLUMB_JOINT_FIXED)
    return {usual.degree,
            "of a tree, without error; those that close a loop are soft, without limits, motors and springs"};
  if (usual.degree != PLUMB_NONE) return {usual.degree, "of a tree, without error; it cannot close a loop"};
  return usual;
}

Capability joint_feature_fact(std::uint32_t type, std::uint32_t feature) {
  if (const Capability joint = joint_fact(type); joint.degree == PLUMB_NONE) return joint;
  if (feature == PLUMB_JOINT_HAS_STIFFNESS) feature = PLUMB_JOINT_HAS_SPRINGS;
  const Capability usual = backend::usual_capability(PLUMB_CAP_JOINT_FEATURE, type, feature);
  if (usual.degree == PLUMB_NONE) return usual;
  switch (feature) {
    case PLUMB_JOINT_HAS_LIMITS: return {PLUMB_NATIVE, "soft by joint_time and impedance"};
    case PLUMB_JOINT_HAS_MOTORS:
      if (type == PLUMB_JOINT_DISTANCE) return {PLUMB_NONE, "rods have none"};
      return {PLUMB_EMULATED, "dry friction against a speed"};
    case PLUMB_JOINT_BREAKS: return {PLUMB_EMULATED, "by the mean of the reaction over a step"};
    case PLUMB_JOINT_HAS_REACTION: return {PLUMB_NATIVE, "of a fixed joint that closes a loop the force alone"};
    default: return usual;
  }
}

Capability query_fact(std::uint32_t kind) {
  if (kind == PLUMB_QUERY_RAY)
    return {PLUMB_NATIVE, "of a body in which it starts a ray sees the far side; every geom is asked"};
  return {PLUMB_NONE, "MuJoCo has neither shape casts nor overlaps"};
}

Capability need_fact(std::uint32_t index) {
  switch (PlumbNeeds{1} << std::min<std::uint32_t>(index, 63)) {
    case PLUMB_NEED_CCD: return {PLUMB_NONE, "MuJoCo looks at where bodies are alone"};
    case PLUMB_NEED_SLEEPING: return kNoSleep;
    case PLUMB_NEED_FRICTION:
      return {PLUMB_APPROXIMATE, "soft: what should stick creeps, less with impratio or noslip"};
    case PLUMB_NEED_GYROSCOPIC:
      return {PLUMB_NATIVE,
              "that of a sub-step's beginning; none beyond half a radian in one, where bodies would gain"};
    case PLUMB_NEED_ROLLING_FRICTION: return {PLUMB_APPROXIMATE, "soft: what should stay creeps"};
    case PLUMB_NEED_RESTITUTION:
      return {PLUMB_APPROXIMATE,
              "a spring for bounce_substeps sub-steps, in which bodies overlap; a rebound of a twentieth where there "
              "should be none"};
    case PLUMB_NEED_SURFACE_VELOCITY: return {PLUMB_EMULATED, "as the sliding speed that a contact's friction wants"};
    case PLUMB_NEED_DAMPING: return {PLUMB_EMULATED, "a force of the adapter in each sub-step"};
    case PLUMB_NEED_AXIS_LOCKS:
      return {PLUMB_EMULATED,
              "bodies weigh 1e10 kg along locked axes; where one or two turns are locked, they are taken out "
              "after each sub-step"};
    case PLUMB_NEED_KINEMATIC: return {PLUMB_EMULATED, "bodies of 1e10 kg that are put where they should be"};
    case PLUMB_NEED_FILTERS: return {PLUMB_EMULATED, "by the adapter, after contacts were found"};
    case PLUMB_NEED_EVENTS:
    case PLUMB_NEED_SENSORS: return {PLUMB_EMULATED, "by comparing who touches in one step with who does in the next"};
    case PLUMB_NEED_SNAPSHOT: return {PLUMB_NATIVE, ""};
    default: return backend::usual_capability(PLUMB_CAP_NEED, index, 0);
  }
}

Capability field_fact(PlumbCapability kind, std::uint32_t field) {
  if (field == PLUMB_FIELD_ROLLING_FRICTION) return {PLUMB_NATIVE};
  if (field == PLUMB_FIELD_AWAKE && kind == PLUMB_CAP_FIELD_WRITE) return kNoSleep;
  if (field == PLUMB_FIELD_KINEMATIC_TARGET && kind == PLUMB_CAP_FIELD_WRITE)
    return {PLUMB_EMULATED, "the velocity that leads there"};
  return backend::usual_capability(kind, field, 0);
}

Capability fact(PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  switch (kind) {
    case PLUMB_CAP_SHAPE: return shape_fact(a, b);
    case PLUMB_CAP_PAIR: return pair_fact(a, b);
    case PLUMB_CAP_JOINT: return joint_fact(a);
    case PLUMB_CAP_JOINT_FEATURE: return joint_feature_fact(a, b);
    case PLUMB_CAP_QUERY: return query_fact(a);
    case PLUMB_CAP_CLOSEST:
      return {PLUMB_NONE, "MuJoCo tells distances of geoms of its model alone, not around a shape"};
    case PLUMB_CAP_FIELD_READ:
    case PLUMB_CAP_FIELD_WRITE: return field_fact(kind, a);
    case PLUMB_CAP_NEED: return need_fact(a);
    case PLUMB_CAP_EVENT:
      if (a == PLUMB_EVENT_WAKE || a == PLUMB_EVENT_SLEEP) return kNoSleep;
      return {a < PLUMB_EVENT_COUNT ? PLUMB_EMULATED : PLUMB_NONE};
    case PLUMB_CAP_PHASE_TIME: return {};
    case PLUMB_CAP_SNAPSHOT:
      if (a == 1) return {PLUMB_APPROXIMATE, "where bodies or joints came or went its warm start is made anew"};
      return {PLUMB_NATIVE};
    default: return backend::usual_capability(kind, a, b);
  }
}

}  // namespace

PlumbDegree World::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
  const Capability answer = fact(kind, a, b);
  note = answer.note;
  return answer.degree;
}

}  // namespace plumb::mujoco
