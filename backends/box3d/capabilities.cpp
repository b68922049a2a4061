// What Box3D has, and how truly.
#include <algorithm>

#include "plumb/backend/usual_capability.hpp"
#include "world.hpp"

namespace plumb::box3d {
namespace {

using backend::Capability;
constexpr const char* kPrism = "a prism of cylinder_sides sides and the cylinder's volume";
constexpr const char* kSubStep = "of the last sub-step";

bool is_ground(std::uint32_t type) {
  return type == PLUMB_TRIANGLE_MESH || type == PLUMB_HEIGHT_FIELD || type == PLUMB_PLANE;
}

Capability shape_fact(std::uint32_t type, std::uint32_t motion) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_SHAPE, type, motion);
  if (usual.degree == PLUMB_NONE) return usual;
  switch (type) {
    case PLUMB_CYLINDER: return {PLUMB_APPROXIMATE, kPrism};
    case PLUMB_CONVEX_HULL: return {PLUMB_NATIVE, "at most 128 vertices, 128 faces and 128 edges"};
    case PLUMB_COMPOUND: return {PLUMB_NATIVE, "several shapes of one body"};
    case PLUMB_PLANE: return {PLUMB_EMULATED, "a box of a kilometre, 100 m deep"};
    case PLUMB_HEIGHT_FIELD: return {PLUMB_EMULATED, "by a mesh, as Box3D's own are rounded to 16 bits"};
    default: return usual;
  }
}

Capability pair_fact(std::uint32_t a, std::uint32_t b) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_PAIR, a, b);
  if (usual.degree == PLUMB_NONE) return usual;
  if (a == PLUMB_CYLINDER || b == PLUMB_CYLINDER) return {PLUMB_APPROXIMATE, kPrism};
  if (is_ground(a)) return shape_fact(a, PLUMB_STATIC);
  if (is_ground(b)) return shape_fact(b, PLUMB_STATIC);
  return usual;
}

Capability joint_fact(std::uint32_t type) {
  if (type == PLUMB_JOINT_GENERIC) return {PLUMB_NONE, "Box3D has no joint of six axes"};
  if (type == PLUMB_JOINT_UNIVERSAL)
    return {PLUMB_EMULATED, "Box3D's wheel joint, steered freely and without travel of its suspension"};
  if (type == PLUMB_JOINT_SWING_TWIST)
    return {PLUMB_APPROXIMATE, "its cones are round: one of two half angles is refused"};
  return backend::usual_capability(PLUMB_CAP_JOINT, type, 0);
}

Capability joint_feature_fact(std::uint32_t type, std::uint32_t feature) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_JOINT_FEATURE, type, feature);
  if (feature == PLUMB_JOINT_HAS_TARGETS) return joint_feature_fact(type, PLUMB_JOINT_HAS_SPRINGS);
  if (usual.degree == PLUMB_NONE) return usual;
  if (type == PLUMB_JOINT_GENERIC) return joint_fact(type);
  if (feature == PLUMB_JOINT_HAS_SPRINGS && type == PLUMB_JOINT_SWING_TWIST)
    return {PLUMB_APPROXIMATE, "one spring for all three turns: unlike ones are refused"};
  if (feature == PLUMB_JOINT_HAS_REACTION) return {PLUMB_APPROXIMATE, kSubStep};
  if (joint_has(type, feature)) return usual;
  if (type == PLUMB_JOINT_BALL)
    return {PLUMB_NONE, "Box3D's cone, twist, motor and spring are not those of single axes"};
  if (type == PLUMB_JOINT_SWING_TWIST) return {PLUMB_NONE, "not made: Box3D's motor is of all three turns"};
  return {PLUMB_NONE, "Box3D's wheel joint has them on one of the two axes only"};
}

Capability query_fact(std::uint32_t kind, std::uint32_t type) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_QUERY, kind, type);
  if (usual.degree == PLUMB_NONE) return usual;
  if (kind == PLUMB_QUERY_RAY)
    return {PLUMB_NATIVE, "a body in which a ray starts is hit at fraction 0; meshes are seen from their front alone"};
  if (type == PLUMB_CYLINDER) return {PLUMB_APPROXIMATE, kPrism};
  if (kind == PLUMB_QUERY_CAST)
    return {PLUMB_NATIVE, "brought by the adapter from Box3D's slop of 5 mm to where the shapes touch"};
  return usual;
}

Capability need_fact(std::uint32_t index) {
  switch (PlumbNeeds{1} << std::min<std::uint32_t>(index, 63)) {
    case PLUMB_NEED_ROTATION:
      return {PLUMB_APPROXIMATE, "float in each sub-step: the spin of a free ball drifts by 5e-5 of itself in 2 s"};
    case PLUMB_NEED_CCD: return {PLUMB_NATIVE, "against static bodies always, with dynamic ones as a bullet"};
    case PLUMB_NEED_SNAPSHOT: return {PLUMB_APPROXIMATE, "warm-start data are lost"};
    case PLUMB_NEED_EVENTS:
    case PLUMB_NEED_SENSORS:
      return {PLUMB_EMULATED, "by comparing who touches after one step with who does after the next"};
    case PLUMB_NEED_ROLLING_FRICTION:
      return {PLUMB_APPROXIMATE, "of spheres and capsules alone, and they resist spinning as they do rolling"};
    case PLUMB_NEED_JOINT_REACTIONS: return {PLUMB_APPROXIMATE, kSubStep};
    case PLUMB_NEED_CONTACT_IMPULSES:
      return {PLUMB_APPROXIMATE,
              "friction is one impulse a manifold, of the last sub-step, shared out by how much its points push"};
    default: return backend::usual_capability(PLUMB_CAP_NEED, index, 0);
  }
}

Capability fact(PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  switch (kind) {
    case PLUMB_CAP_SHAPE: return shape_fact(a, b);
    case PLUMB_CAP_PAIR: return pair_fact(a, b);
    case PLUMB_CAP_JOINT: return joint_fact(a);
    case PLUMB_CAP_JOINT_FEATURE: return joint_feature_fact(a, b);
    case PLUMB_CAP_QUERY: return query_fact(a, b);
    case PLUMB_CAP_CLOSEST: return {PLUMB_NONE, "the adapter does not ask Box3D for distances"};
    case PLUMB_CAP_FIELD_READ:
    case PLUMB_CAP_FIELD_WRITE:
      if (a == PLUMB_FIELD_ROLLING_FRICTION) return {PLUMB_NATIVE};
      if (kind == PLUMB_CAP_FIELD_WRITE && a == PLUMB_FIELD_KINEMATIC_TARGET)
        return {PLUMB_EMULATED, "the velocity that leads there"};
      return backend::usual_capability(kind, a, b);
    case PLUMB_CAP_NEED: return need_fact(a);
    case PLUMB_CAP_EVENT: return {a < PLUMB_EVENT_COUNT ? PLUMB_EMULATED : PLUMB_NONE};
    case PLUMB_CAP_PHASE_TIME:
      return {a == PLUMB_PHASE_BROAD || a == PLUMB_PHASE_NARROW || a == PLUMB_PHASE_SOLVE ? PLUMB_NATIVE : PLUMB_NONE};
    case PLUMB_CAP_TRIANGLE_MATERIAL:
      return {a == PLUMB_TRIANGLE_MESH || a == PLUMB_HEIGHT_FIELD ? PLUMB_NATIVE : PLUMB_NONE};
    case PLUMB_CAP_SNAPSHOT: return {PLUMB_APPROXIMATE, "warm-start data are lost"};
    default: return backend::usual_capability(kind, a, b);
  }
}

}  // namespace

PlumbDegree World::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
  const Capability answer = fact(kind, a, b);
  note = answer.note;
  return answer.degree;
}

}  // namespace plumb::box3d
