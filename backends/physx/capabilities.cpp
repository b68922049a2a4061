// What PhysX has, and how truly.
#include <algorithm>

#include "device.hpp"
#include "plumb/backend/modify.hpp"
#include "plumb/backend/usual_capability.hpp"
#include "world.hpp"

namespace plumb::px {
namespace {

using backend::Capability;

Capability shape_fact(std::uint32_t type, std::uint32_t motion) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_SHAPE, type, motion);
  if (usual.degree == PLUMB_NONE) return usual;
  switch (type) {
    case PLUMB_CYLINDER:
      return {PLUMB_NATIVE, kOnGpu ? "PhysX's convex core" : "the custom geometry of PhysX's extensions"};
    case PLUMB_CONVEX_HULL:
      return {PLUMB_NATIVE, kOnGpu ? "at most 64 corners and faces: of more PhysX makes a hull about them"
                                   : "at most 255 corners and faces: of more PhysX makes a hull about them"};
    case PLUMB_HEIGHT_FIELD: return {PLUMB_NATIVE, "heights are rounded to 1/65534 of their range"};
    default: return usual;
  }
}

Capability pair_fact(std::uint32_t a, std::uint32_t b) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_PAIR, a, b);
  if (usual.degree == PLUMB_NONE) return usual;
  if (a == PLUMB_HEIGHT_FIELD || b == PLUMB_HEIGHT_FIELD) return shape_fact(PLUMB_HEIGHT_FIELD, PLUMB_STATIC);
  return usual;
}

constexpr const char* kSixAxes =
    "by PhysX's joint of six axes, which takes turns apart into a twist and a swing: turns about two axes at a time "
    "are "
    "others";
constexpr const char* kReaction = "the sum of what PhysX's constraints of the joint tell";
constexpr const char* kOwnRow = "a constraint of the adapter's own";

Capability joint_fact(std::uint32_t type) {
  switch (type) {
    case PLUMB_JOINT_UNIVERSAL: return {PLUMB_EMULATED, "PhysX's joint of six axes, its bodies the other way round"};
    case PLUMB_JOINT_GENERIC: return {PLUMB_APPROXIMATE, kSixAxes};
    case PLUMB_JOINT_GEAR:
      return {PLUMB_EMULATED, "a constraint of the adapter's own: PhysX's holds wheels of its hinges alone"};
    case PLUMB_JOINT_RACK_AND_PINION:
      return {
          PLUMB_APPROXIMATE,
          "a constraint of the adapter's own, which like PhysX's pushes both at their centres and turns the pinion"};
    default: return {type < PLUMB_JOINT_TYPE_COUNT ? PLUMB_NATIVE : PLUMB_NONE};
  }
}

Capability drive_fact(std::uint32_t type, std::uint32_t feature) {
  const bool limits = feature == PLUMB_JOINT_HAS_LIMITS, motors = feature == PLUMB_JOINT_HAS_MOTORS;
  switch (type) {
    case PLUMB_JOINT_HINGE: return limits ? Capability{PLUMB_NATIVE} : Capability{PLUMB_EMULATED, kOwnRow};
    case PLUMB_JOINT_SLIDER: return motors ? Capability{PLUMB_EMULATED, kOwnRow} : Capability{PLUMB_NATIVE};
    case PLUMB_JOINT_DISTANCE:
      if (motors) return {PLUMB_NONE, "PhysX's distance joints have none; take a slider"};
      return limits ? Capability{PLUMB_NATIVE} : Capability{PLUMB_EMULATED, kOwnRow};
    case PLUMB_JOINT_SWING_TWIST: return limits ? Capability{PLUMB_NATIVE} : Capability{PLUMB_EMULATED, kOwnRow};
    default: return limits ? Capability{PLUMB_APPROXIMATE, kSixAxes} : Capability{PLUMB_EMULATED, kOwnRow};
  }
}

Capability joint_feature_fact(std::uint32_t type, std::uint32_t feature) {
  if (type >= PLUMB_JOINT_TYPE_COUNT || feature >= PLUMB_JOINT_FEATURE_COUNT) return {};
  if (feature == PLUMB_JOINT_HAS_REACTION) return {PLUMB_NATIVE};
  if (feature == PLUMB_JOINT_BREAKS) return {PLUMB_EMULATED, kReaction};
  if (backend::free_axes(type) == 0) return {PLUMB_NONE, "it leaves no axis free, or has none"};
  return drive_fact(type, feature);
}

constexpr const char* kRoundness = "of cylinders within a millimetre, as PhysX's search for distances is";

Capability query_fact(std::uint32_t kind, std::uint32_t type) {
  switch (kind) {
    case PLUMB_QUERY_RAY: return {PLUMB_NATIVE, "a body in which a ray starts is hit at fraction 0"};
    case PLUMB_QUERY_PENETRATION:
      return {type < PLUMB_SHAPE_TYPE_COUNT && backend::is_convex(type) ? PLUMB_NATIVE : PLUMB_NONE};
    default: return backend::usual_capability(PLUMB_CAP_QUERY, kind, type);
  }
}

Capability need_fact(std::uint32_t index) {
  switch (PlumbNeeds{1} << std::min<std::uint32_t>(index, 63)) {
    case PLUMB_NEED_CCD: return {PLUMB_NATIVE, "bodies are swept along their ways"};
    case PLUMB_NEED_EVENTS:
      return {PLUMB_EMULATED, "by comparing who touches after one step with who does after the next"};
    case PLUMB_NEED_SENSORS: return {PLUMB_EMULATED, "by asking after each step whom their shapes overlap"};
    case PLUMB_NEED_CONTACT_IMPULSES:
      return {PLUMB_EMULATED,
              "PhysX rubs at up to two anchors of a face, whose impulses are told at the points next to "
              "them"};
    case PLUMB_NEED_SURFACE_VELOCITY: return {PLUMB_NATIVE, "as target velocities of contacts"};
    case PLUMB_NEED_SNAPSHOT: return {PLUMB_NONE, "PhysX does not let its contacts and their history be saved"};
    case PLUMB_NEED_CONTACT_MODIFICATION:
      return {PLUMB_NONE, "PhysX asks by a callback in the midst of its threads, which the adapter does not hold up"};
    case PLUMB_NEED_ROLLING_FRICTION: return {PLUMB_NONE, "PhysX has none"};
    default: return backend::usual_capability(PLUMB_CAP_NEED, index, 0);
  }
}

Capability modify_fact(std::uint32_t of, std::uint32_t index) {
  switch (of) {
    case 0:
      if (index >= PLUMB_MODIFY_BODY_COUNT) return {};
      return {PLUMB_EMULATED, "PhysX's actor is made anew"};
    case 1:
      if (index >= PLUMB_MODIFY_JOINT_COUNT) return {};
      return {PLUMB_EMULATED, "PhysX's joint is made anew"};
    default: return {of == 2 && backend::may_change(index) ? PLUMB_EMULATED : PLUMB_NONE};
  }
}

Capability write_fact(std::uint32_t field) {
  const Capability usual = backend::usual_capability(PLUMB_CAP_FIELD_WRITE, field, 0);
  switch (field) {
    case PLUMB_FIELD_IMPULSE:
    case PLUMB_FIELD_ANGULAR_IMPULSE:
    case PLUMB_FIELD_IMPULSE_AT_POINT:
      return {PLUMB_EMULATED, "as a change of the velocity: PhysX keeps impulses for its next step"};
    case PLUMB_FIELD_GRAVITY_SCALE:
      return {PLUMB_EMULATED, "PhysX has it on or off; of others the adapter adds a share"};
    default: return usual;
  }
}

Capability fact(PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  switch (kind) {
    case PLUMB_CAP_SHAPE: return shape_fact(a, b);
    case PLUMB_CAP_PAIR: return pair_fact(a, b);
    case PLUMB_CAP_JOINT: return joint_fact(a);
    case PLUMB_CAP_JOINT_FEATURE: return joint_feature_fact(a, b);
    case PLUMB_CAP_QUERY: return query_fact(a, b);
    case PLUMB_CAP_CLOSEST: {
      const Capability usual = backend::usual_capability(kind, a, b);
      return usual.degree == PLUMB_NONE ? usual : Capability{PLUMB_APPROXIMATE, kRoundness};
    }
    case PLUMB_CAP_FIELD_WRITE: return write_fact(a);
    case PLUMB_CAP_NEED: return need_fact(a);
    case PLUMB_CAP_EVENT: return {a < PLUMB_EVENT_COUNT ? PLUMB_EMULATED : PLUMB_NONE};
    case PLUMB_CAP_PHASE_TIME: return {PLUMB_NONE, "PhysX tells no times of its own"};
    case PLUMB_CAP_TRIANGLE_MATERIAL:
      if (kOnGpu) return {PLUMB_NONE, "PhysX's cylinders read beyond the materials of triangles there"};
      if (a == PLUMB_HEIGHT_FIELD) return {PLUMB_NATIVE, "at most 126 of them"};
      return {a == PLUMB_TRIANGLE_MESH ? PLUMB_NATIVE : PLUMB_NONE};
    case PLUMB_CAP_MODIFY: return modify_fact(a, b);
    default: return backend::usual_capability(kind, a, b);
  }
}

}  // namespace

PlumbDegree World::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
  const Capability answer = fact(kind, a, b);
  note = answer.note;
  return answer.degree;
}

}  // namespace plumb::px
