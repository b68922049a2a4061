// What ODE 0.16 truly has.
#include <ode/ode.h>

#include <algorithm>

#include "plumb/backend/modify.hpp"
#include "plumb/backend/usual_capability.hpp"
#include "world.hpp"

namespace plumb::ode {
namespace {

using Fact = backend::Capability;

// --- shapes and pairs ------------------------------------------------------------------------------------------------

Fact shape_fact(std::uint32_t type, std::uint32_t motion) {
  if (type >= PLUMB_SHAPE_TYPE_COUNT || motion >= PLUMB_MOTION_COUNT) return {PLUMB_NONE};
  if (type == PLUMB_PLANE && motion != PLUMB_STATIC) return {PLUMB_NONE, "a plane cannot be placed on a body"};
  if (type == PLUMB_HEIGHT_FIELD && motion == PLUMB_DYNAMIC)
    return {PLUMB_NONE, "a height field is ground, open below"};
  if (type == PLUMB_COMPOUND) return {PLUMB_NATIVE, "several geoms on one body"};
  return {PLUMB_NATIVE};
}

/// a <= b. Each was tried: a shape dropped on a shape for 5 s (tests/test_pairs.cpp does it again).
Fact pair_fact(std::uint32_t a, std::uint32_t b) {
  constexpr Fact one_point{PLUMB_APPROXIMATE, "libccd finds a single point, on which flat faces rock without end"};
  if (b >= PLUMB_SHAPE_TYPE_COUNT) return {PLUMB_NONE};
  const auto is = [&](PlumbShapeType x, PlumbShapeType y) { return a == std::min(x, y) && b == std::max(x, y); };
  if (a == PLUMB_HEIGHT_FIELD && b <= PLUMB_PLANE)
    return {PLUMB_NONE, "ODE has no contacts between height fields and planes"};
  if (a == PLUMB_PLANE && b == PLUMB_PLANE) return {PLUMB_NONE, "planes stand still"};
  if (is(PLUMB_CONVEX_HULL, PLUMB_COMPOUND)) return one_point;
  if (b == PLUMB_COMPOUND) return {PLUMB_NATIVE, "as its children"};
  if (is(PLUMB_SPHERE, PLUMB_CONVEX_HULL))
    return {PLUMB_APPROXIMATE, "libccd's normal leans by a thousandth: a ball at rest rolls off slowly"};
  for (const PlumbShapeType flat : {PLUMB_BOX, PLUMB_CAPSULE, PLUMB_CYLINDER, PLUMB_CONVEX_HULL, PLUMB_TRIANGLE_MESH})
    if (is(PLUMB_CONVEX_HULL, flat)) return one_point;
  if (is(PLUMB_CAPSULE, PLUMB_CYLINDER)) return one_point;
  if (is(PLUMB_BOX, PLUMB_CAPSULE)) return {PLUMB_APPROXIMATE, "a single point: a capsule that lies on a box rocks"};
  if (is(PLUMB_TRIANGLE_MESH, PLUMB_TRIANGLE_MESH))
    return {PLUMB_APPROXIMATE,
            "rests on a face twice its size; where edges stand over edges it is thrown off or sinks"};
  if (is(PLUMB_CYLINDER, PLUMB_TRIANGLE_MESH))
    return {PLUMB_APPROXIMATE, "points come and go: a standing cylinder trembles"};
  return {PLUMB_NATIVE};
}

// --- the rest --------------------------------------------------------------------------------------------------------

Fact joint_fact(std::uint32_t type) {
  if (type >= PLUMB_JOINT_TYPE_COUNT) return {PLUMB_NONE};
  if (type == PLUMB_JOINT_SWING_TWIST) return {PLUMB_NONE, "ODE has no joint with a cone"};
  if (backend::is_meshing(type)) return {PLUMB_NONE, "not made: ODE's transmissions hold wheels by where they are"};
  if (type == PLUMB_JOINT_GENERIC)
    return {PLUMB_EMULATED,
            "contact rows along the axes of frame a, and an angular motor told its axes in each sub-step"};
  return {PLUMB_NATIVE};
}

Fact joint_feature_fact(std::uint32_t type, std::uint32_t feature) {
  if (feature >= PLUMB_JOINT_FEATURE_COUNT || joint_fact(type).degree == PLUMB_NONE || !joint_has(type, feature))
    return {PLUMB_NONE};
  if (feature == PLUMB_JOINT_BREAKS) return {PLUMB_EMULATED, "the reaction is compared after each step"};
  if (type == PLUMB_JOINT_DISTANCE && feature == PLUMB_JOINT_HAS_LIMITS)
    return {PLUMB_EMULATED, "a contact row along the line between the frames"};
  if (feature == PLUMB_JOINT_HAS_SPRINGS || feature == PLUMB_JOINT_HAS_STIFFNESS)
    return {PLUMB_NATIVE, "implicit: soft rows by ERP and CFM; by stiffness beside a motor, and at a limit, a force"};
  return {PLUMB_NATIVE};
}

Fact query_fact(std::uint32_t kind, std::uint32_t type) {
  if (kind == PLUMB_QUERY_RAY) return {PLUMB_NATIVE, "hulls by the planes of their faces: ODE's own rays miss most"};
  if (kind == PLUMB_QUERY_CAST || kind == PLUMB_QUERY_TURNING_CAST) return {PLUMB_NONE, "ODE has no casts of shapes"};
  if (kind == PLUMB_QUERY_OVERLAP && type == PLUMB_BOX)
    return {PLUMB_APPROXIMATE, "ODE finds no contact of some boxes that overlap deeply: about one pair in a thousand"};
  if (kind == PLUMB_QUERY_OVERLAP && type <= PLUMB_CONVEX_HULL)
    return {PLUMB_APPROXIMATE,
            "ODE finds no contact of some shapes that cut a height field, nor of some capsules deep in boxes"};
  if (kind == PLUMB_QUERY_PENETRATION && type <= PLUMB_CONVEX_HULL)
    return {PLUMB_APPROXIMATE, "as deep as the contacts that ODE makes: of some deep overlaps none, or too deep"};
  return {PLUMB_NONE};
}

Fact need_fact(std::uint32_t index) {
  if (index >= PLUMB_NEED_COUNT) return {PLUMB_NONE};
  switch (PlumbNeeds{1} << index) {
    case PLUMB_NEED_CCD: return {PLUMB_NONE, "ODE has no continuous collision detection"};
    case PLUMB_NEED_FRICTION:
      return {PLUMB_APPROXIMATE,
              "a pyramid of two directions instead of Coulomb's cone; a contact may stick on the diagonal"};
    case PLUMB_NEED_EVENTS: return {PLUMB_EMULATED, "the difference of the touching pairs of two steps"};
    case PLUMB_NEED_SENSORS: return {PLUMB_EMULATED, "pairs whose contacts get no joints"};
    case PLUMB_NEED_AXIS_LOCKS: return {PLUMB_EMULATED, "motors at rest against the world, and projection"};
    case PLUMB_NEED_ROLLING_FRICTION:
      return {PLUMB_APPROXIMATE, "a pyramid of two directions, at each point with its share of the load"};
    case PLUMB_NEED_DAMPING: return {PLUMB_EMULATED, "ODE's share per step set to 1 - exp(-c dt)"};
    default: return {PLUMB_NATIVE};
  }
}

Fact field_fact(PlumbCapability kind, std::uint32_t field) {
  if (field == PLUMB_FIELD_ROLLING_FRICTION) return {PLUMB_NATIVE};
  const Fact usual = backend::usual_capability(kind, field, 0);
  if (usual.degree == PLUMB_NONE) return usual;
  switch (field) {
    case PLUMB_FIELD_IMPULSE:
    case PLUMB_FIELD_ANGULAR_IMPULSE:
    case PLUMB_FIELD_IMPULSE_AT_POINT: return {PLUMB_EMULATED, "a change of velocity"};
    case PLUMB_FIELD_KINEMATIC_TARGET:
      return {PLUMB_EMULATED, "the velocity that leads there, and the pose at the end"};
    case PLUMB_FIELD_GRAVITY_SCALE: return {PLUMB_EMULATED, "0 and 1 natively, others as a force"};
    default: return usual;
  }
}

Fact event_fact(std::uint32_t type) {
  if (type >= PLUMB_EVENT_COUNT) return {PLUMB_NONE};
  return {PLUMB_EMULATED, "found by comparing with the step before"};
}

Fact modify_fact(std::uint32_t kind, std::uint32_t index) {
  if (kind == 0 && index < PLUMB_MODIFY_BODY_COUNT)
    return {PLUMB_EMULATED, "another body of ODE's in the place of the one there was"};
  if (kind == 2 && backend::may_change(index))
    return {PLUMB_EMULATED, "another geom of ODE's in the place of the one there was; all that rests on it wakes"};
  if (kind == 1 && index < PLUMB_MODIFY_JOINT_COUNT)
    return {PLUMB_EMULATED, "another joint of ODE's in the place of the one there was"};
  return {PLUMB_NONE};
}

Fact phase_fact(std::uint32_t phase) {
  if (phase == PLUMB_PHASE_BROAD) return {PLUMB_APPROXIMATE, "with the narrow phase, which ODE calls from within"};
  if (phase == PLUMB_PHASE_SOLVE) return {PLUMB_APPROXIMATE, "with islands and integration: one call of ODE"};
  if (phase == PLUMB_PHASE_OUTPUT) return {PLUMB_NATIVE};
  return {PLUMB_NONE};
}

Fact fact(PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  switch (kind) {
    case PLUMB_CAP_SHAPE: return shape_fact(a, b);
    case PLUMB_CAP_PAIR: return pair_fact(std::min(a, b), std::max(a, b));
    case PLUMB_CAP_JOINT: return joint_fact(a);
    case PLUMB_CAP_JOINT_FEATURE: return joint_feature_fact(a, b);
    case PLUMB_CAP_QUERY: return query_fact(a, b);
    case PLUMB_CAP_CLOSEST: return {PLUMB_NONE, "ODE tells how deep shapes overlap, not how far apart they are"};
    case PLUMB_CAP_FIELD_READ:
    case PLUMB_CAP_FIELD_WRITE: return field_fact(kind, a);
    case PLUMB_CAP_NEED: return need_fact(a);
    case PLUMB_CAP_EVENT: return event_fact(a);
    case PLUMB_CAP_PHASE_TIME: return phase_fact(a);
    case PLUMB_CAP_RESIDUAL: return {PLUMB_NONE, "ODE does not tell its residual"};
    case PLUMB_CAP_SNAPSHOT:
      if (a == 1) return {PLUMB_APPROXIMATE, "who was made anew comes first in ODE's own list, which no one can order"};
      return {PLUMB_NATIVE, "not with the spaces sap and quadtree, which keep their order to themselves"};
    case PLUMB_CAP_HOST_JOBS: return {PLUMB_NONE, "ODE runs threads of its own"};
    case PLUMB_CAP_CHILD_MATERIAL: return {PLUMB_NATIVE};
    case PLUMB_CAP_TRIANGLE_MATERIAL:
      if (a == PLUMB_HEIGHT_FIELD) return {PLUMB_EMULATED, "ODE's point tells the place, not the triangle"};
      return {a == PLUMB_TRIANGLE_MESH ? PLUMB_NATIVE : PLUMB_NONE};
    case PLUMB_CAP_MODIFY: return modify_fact(a, b);
    case PLUMB_CAP_MANIFOLD: return {a < PLUMB_MANIFOLD_CHANGE_COUNT ? PLUMB_NATIVE : PLUMB_NONE};
    default: return {PLUMB_NONE};
  }
}

}  // namespace

PlumbDegree World::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
  const Fact known = fact(kind, a, b);
  note = known.note;
  return known.degree;
}

const PlumbBackendInfo& World::info() {
  static const PlumbBackendInfo all = [] {
    PlumbBackendInfo i{};
    i.struct_size = sizeof i;
    i.determinism = PLUMB_DETERMINISM_RUN;
    i.name = "ode";
    i.version = PLUMB_ODE_VERSION;
    i.build = "ode " PLUMB_ODE_VERSION ", double, adapter " PLUMB_ODE_BUILD;
    i.description = "Open Dynamics Engine: quickstep (SOR) or step (Dantzig), contacts rebuilt in every step";
    i.device = "cpu";
    i.exclusion_group = "";
    i.precision = PLUMB_F64;
    i.max_threads = 64;
    return i;
  }();
  return all;
}

}  // namespace plumb::ode
