// What Jolt has, and how truly.
#include <algorithm>

#include "contacts/saved_contacts.hpp"
#include "plumb/backend/modify.hpp"
#include "plumb/backend/usual_capability.hpp"
#include "world.hpp"

namespace plumb::jolt {
namespace {

using backend::Capability;

bool is_surface(std::uint32_t type) {
  return type == PLUMB_TRIANGLE_MESH || type == PLUMB_HEIGHT_FIELD || type == PLUMB_PLANE;
}

Capability shape_fact(std::uint32_t type, std::uint32_t motion) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_SHAPE, type, motion);
  if (usual.degree == PLUMB_NONE) return usual;
  switch (type) {
    case PLUMB_CONVEX_HULL: return {PLUMB_NATIVE, "at most 256 corners: of more those that stand out most"};
    case PLUMB_PLANE: return {PLUMB_NATIVE, "it ends 5 km from its origin"};
    case PLUMB_HEIGHT_FIELD: return {PLUMB_EMULATED, "by a mesh, as Jolt's own are square and round their heights"};
    default: return usual;
  }
}

Capability pair_fact(std::uint32_t a, std::uint32_t b) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_PAIR, a, b);
  if (usual.degree == PLUMB_NONE) return usual;
  if (is_surface(a)) return shape_fact(a, PLUMB_STATIC);
  if (is_surface(b)) return shape_fact(b, PLUMB_STATIC);
  return usual;
}

constexpr const char* kPushed = "what the solver of velocities pushed with; of several collision steps the last's";
constexpr const char* kSixAxes =
    "by Jolt's constraint of six axes, which bounds a twist and a swing: turns about two axes at a time are others";

Capability joint_fact(std::uint32_t type) {
  switch (type) {
    case PLUMB_JOINT_UNIVERSAL: return {PLUMB_EMULATED, "Jolt's constraint of six axes"};
    case PLUMB_JOINT_GENERIC: return {PLUMB_APPROXIMATE, kSixAxes};
    case PLUMB_JOINT_SWING_TWIST:
      return {PLUMB_APPROXIMATE,
              "its cone is an ellipse of the sines of half angles: in between the two it is another"};
    case PLUMB_JOINT_GEAR:
      return {PLUMB_EMULATED, "a constraint of the adapter's own: Jolt's gives both wheels the same torque"};
    case PLUMB_JOINT_RACK_AND_PINION:
      return {PLUMB_EMULATED,
              "a constraint of the adapter's own: Jolt's drifts, and pushes a rack at its centre alone"};
    default: return {type < PLUMB_JOINT_TYPE_COUNT ? PLUMB_NATIVE : PLUMB_NONE};
  }
}

Capability drive_fact(std::uint32_t type, std::uint32_t feature) {
  switch (type) {
    case PLUMB_JOINT_HINGE:
    case PLUMB_JOINT_SLIDER: return {PLUMB_NATIVE};
    case PLUMB_JOINT_DISTANCE:
      if (feature == PLUMB_JOINT_HAS_MOTORS) return {PLUMB_NONE, "Jolt's distance joints have none; take a slider"};
      return {PLUMB_NATIVE};
    case PLUMB_JOINT_SWING_TWIST:
      if (feature == PLUMB_JOINT_HAS_LIMITS) return joint_fact(type);
      return {PLUMB_APPROXIMATE, "about b's axes, and by twice the sine of half the angle"};
    default: return {PLUMB_APPROXIMATE, kSixAxes};
  }
}

Capability joint_feature_fact(std::uint32_t type, std::uint32_t feature) {
  if (type >= PLUMB_JOINT_TYPE_COUNT || feature >= PLUMB_JOINT_FEATURE_COUNT) return {};
  switch (feature) {
    case PLUMB_JOINT_HAS_REACTION:
    case PLUMB_JOINT_BREAKS:
      if (type == PLUMB_JOINT_GENERIC || type == PLUMB_JOINT_SWING_TWIST)
        return {PLUMB_APPROXIMATE, "as of others, but for the axis of what bounds a swing"};
      return {PLUMB_EMULATED, kPushed};
    default:
      if (backend::free_axes(type) == 0) return {PLUMB_NONE, "it leaves no axis free, or has none"};
      return drive_fact(type, feature);
  }
}

Capability query_fact(std::uint32_t kind, std::uint32_t type) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_QUERY, kind, type);
  switch (kind) {
    case PLUMB_QUERY_RAY:
      return {PLUMB_NATIVE,
              "a body in which a ray starts is hit at fraction 0; meshes are seen from their front alone"};
    case PLUMB_QUERY_PENETRATION:
      return {type < PLUMB_SHAPE_TYPE_COUNT && backend::is_convex(type) ? PLUMB_NATIVE : PLUMB_NONE};
    default: return usual;
  }
}

Capability need_fact(std::uint32_t index) {
  switch (PlumbNeeds{1} << std::min<std::uint32_t>(index, 63)) {
    case PLUMB_NEED_ROTATION: return {PLUMB_NATIVE};
    case PLUMB_NEED_CCD: return {PLUMB_NATIVE, "bodies are cast along their ways, without turning"};
    case PLUMB_NEED_SNAPSHOT: return {PLUMB_NATIVE};
    case PLUMB_NEED_EVENTS:
      return {PLUMB_EMULATED, "by comparing who touches after one step with who does after the next"};
    case PLUMB_NEED_SENSORS: return {PLUMB_EMULATED, "by asking after each step whom their shapes overlap"};
    case PLUMB_NEED_JOINT_REACTIONS: return {PLUMB_EMULATED, kPushed};
    case PLUMB_NEED_CONTACT_IMPULSES:
      if (!kReadsSavedContacts) return {PLUMB_NONE, "the adapter knows how Jolt 5.5.1 saves its contacts alone"};
      return {
          PLUMB_EMULATED,
          "read out of Jolt's saved state; friction is one of a manifold, shared out by how much its points push; of "
          "several collision steps the last's, times their number; not of bodies that continuous collision stops"};
    default: return backend::usual_capability(PLUMB_CAP_NEED, index, 0);
  }
}

Capability modify_fact(std::uint32_t of, std::uint32_t index) {
  switch (of) {
    case 0:
      if (index >= PLUMB_MODIFY_BODY_COUNT) return {};
      return {PLUMB_EMULATED, "Jolt's body is made anew under its number"};
    case 1:
      if (index >= PLUMB_MODIFY_JOINT_COUNT) return {};
      return {PLUMB_EMULATED, "its constraint is made anew"};
    default: return {of == 2 && backend::may_change(index) ? PLUMB_EMULATED : PLUMB_NONE};
  }
}

Capability fact(PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  switch (kind) {
    case PLUMB_CAP_SHAPE: return shape_fact(a, b);
    case PLUMB_CAP_PAIR: return pair_fact(a, b);
    case PLUMB_CAP_JOINT: return joint_fact(a);
    case PLUMB_CAP_JOINT_FEATURE: return joint_feature_fact(a, b);
    case PLUMB_CAP_QUERY: return query_fact(a, b);
    case PLUMB_CAP_FIELD_WRITE:
      if (a == PLUMB_FIELD_KINEMATIC_TARGET) return {PLUMB_NATIVE, "the velocity that leads there"};
      return backend::usual_capability(kind, a, b);
    case PLUMB_CAP_NEED: return need_fact(a);
    case PLUMB_CAP_EVENT: return {a < PLUMB_EVENT_COUNT ? PLUMB_EMULATED : PLUMB_NONE};
    case PLUMB_CAP_PHASE_TIME: return {PLUMB_NONE};
    case PLUMB_CAP_TRIANGLE_MATERIAL:
      return {a == PLUMB_TRIANGLE_MESH || a == PLUMB_HEIGHT_FIELD ? PLUMB_NATIVE : PLUMB_NONE};
    case PLUMB_CAP_MODIFY: return modify_fact(a, b);
    case PLUMB_CAP_SNAPSHOT: return {a <= 1 ? PLUMB_NATIVE : PLUMB_NONE};
    default: return backend::usual_capability(kind, a, b);
  }
}

}  // namespace

PlumbDegree World::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
  const Capability answer = fact(kind, a, b);
  note = answer.note;
  return answer.degree;
}

}  // namespace plumb::jolt
