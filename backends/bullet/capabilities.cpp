// What Bullet has, and how truly.
#include "plumb/backend/modify.hpp"
#include "plumb/backend/usual_capability.hpp"
#include "world.hpp"

namespace plumb::bullet {
namespace {

PlumbDegree answer(PlumbDegree degree, const char*& note, const char* text) {
  note = text;
  return degree;
}

PlumbDegree usual_degree(PlumbCapability kind, std::uint32_t a, const char*& note) {
  const backend::Capability usual = backend::usual_capability(kind, a, 0);
  return answer(usual.degree, note, usual.note);
}

bool is_convex(std::uint32_t type) { return type <= PLUMB_CONVEX_HULL; }

PlumbDegree shape_degree(std::uint32_t type, std::uint32_t motion, const char*& note) {
  if (type >= PLUMB_SHAPE_TYPE_COUNT || motion >= PLUMB_MOTION_COUNT) return PLUMB_NONE;
  if (type == PLUMB_PLANE) return motion == PLUMB_STATIC ? PLUMB_NATIVE : PLUMB_NONE;
  if (type == PLUMB_HEIGHT_FIELD && motion == PLUMB_DYNAMIC)
    return answer(PLUMB_NONE, note, "Bullet's height fields do not move by forces");
  if (type == PLUMB_TRIANGLE_MESH && motion == PLUMB_DYNAMIC)
    return answer(
        PLUMB_APPROXIMATE, note,
        "GImpact, surface against surface: rests a centimetre above (less for a thin mesh) and trembles; surfaces "
        "that have crossed may push sideways, and a tower of six cubes falls");
  if (type == PLUMB_CONVEX_HULL || type == PLUMB_CYLINDER)
    return answer(PLUMB_NATIVE, note, "edges are rounded by collision_margin against all but spheres");
  return PLUMB_NATIVE;
}

PlumbDegree pair_degree(std::uint32_t a, std::uint32_t b, const char*& note) {
  if (a >= PLUMB_SHAPE_TYPE_COUNT || b >= PLUMB_SHAPE_TYPE_COUNT) return PLUMB_NONE;
  const auto volume = [](std::uint32_t type) { return is_convex(type) || type == PLUMB_COMPOUND; };
  if (!volume(a) && !volume(b)) {
    if (a != PLUMB_TRIANGLE_MESH && b != PLUMB_TRIANGLE_MESH)
      return answer(PLUMB_NONE, note, "neither of the two can be dynamic");
    return answer(PLUMB_APPROXIMATE, note, "by the triangles of a dynamic mesh (GImpact); trembles at rest");
  }
  if (a == PLUMB_PLANE || b == PLUMB_PLANE)
    return answer(PLUMB_NATIVE, note,
                  "the manifold grows by one point a step; a large box as ground gets four at once");
  const bool hull = a == PLUMB_CONVEX_HULL || b == PLUMB_CONVEX_HULL;
  if (hull &&
      (a == PLUMB_TRIANGLE_MESH || b == PLUMB_TRIANGLE_MESH || a == PLUMB_HEIGHT_FIELD || b == PLUMB_HEIGHT_FIELD))
    return answer(PLUMB_APPROXIMATE, note,
                  "hulls rock on the one point that is found in a step; hull_clipping finds all at once");
  if (a == PLUMB_TRIANGLE_MESH || b == PLUMB_TRIANGLE_MESH)
    return answer(PLUMB_APPROXIMATE, note, "native where the mesh stands still; a dynamic one trembles at rest");
  return PLUMB_NATIVE;
}

PlumbDegree joint_degree(std::uint32_t type, const char*& note) {
  if (type >= PLUMB_JOINT_TYPE_COUNT) return PLUMB_NONE;
  if (type == PLUMB_JOINT_SWING_TWIST)
    return answer(PLUMB_APPROXIMATE, note, "elliptic cones let go by up to .6 rad; round ones hold");
  if (type == PLUMB_JOINT_DISTANCE)
    return answer(PLUMB_EMULATED, note, "a constraint row of the adapter in Bullet's solver");
  if (backend::is_meshing(type))
    return answer(PLUMB_APPROXIMATE, note, "a row of the adapter over speeds alone: what slips is not taken back");
  return PLUMB_NATIVE;
}

PlumbDegree joint_feature_degree(std::uint32_t type, std::uint32_t feature, const char*& note) {
  if (type >= PLUMB_JOINT_TYPE_COUNT) return PLUMB_NONE;
  const bool has_axes = type == PLUMB_JOINT_HINGE || type == PLUMB_JOINT_SLIDER || type == PLUMB_JOINT_UNIVERSAL ||
                        type == PLUMB_JOINT_GENERIC;
  switch (feature) {
    case PLUMB_JOINT_HAS_LIMITS:
      return has_axes || type == PLUMB_JOINT_SWING_TWIST ? PLUMB_NATIVE
             : type == PLUMB_JOINT_DISTANCE              ? PLUMB_EMULATED
                                                         : PLUMB_NONE;
    case PLUMB_JOINT_HAS_MOTORS: return has_axes ? PLUMB_NATIVE : PLUMB_NONE;
    case PLUMB_JOINT_HAS_SPRINGS:
    case PLUMB_JOINT_HAS_STIFFNESS:
    case PLUMB_JOINT_HAS_TARGETS:
      if (!has_axes && type != PLUMB_JOINT_DISTANCE && type != PLUMB_JOINT_SWING_TWIST) return PLUMB_NONE;
      if (feature == PLUMB_JOINT_HAS_TARGETS) return PLUMB_EMULATED;
      return answer(PLUMB_EMULATED, note,
                    feature == PLUMB_JOINT_HAS_SPRINGS
                        ? "a force of the adapter on the axis; no faster than one radian a sub-step"
                        : "a force of the adapter on the axis, of stiff ones a soft row");
    case PLUMB_JOINT_BREAKS: return answer(PLUMB_EMULATED, note, "by the length of the reaction after each sub-step");
    case PLUMB_JOINT_HAS_REACTION: return PLUMB_NATIVE;
    default: return PLUMB_NONE;
  }
}

PlumbDegree query_degree(std::uint32_t kind, std::uint32_t type, const char*& note) {
  if (kind == PLUMB_QUERY_RAY)
    return answer(PLUMB_NATIVE, note, "spheres and boxes by their equations, others by Bullet's convex casts");
  if (kind >= PLUMB_QUERY_KIND_COUNT || !is_convex(type)) return PLUMB_NONE;
  if (kind == PLUMB_QUERY_CAST && type != PLUMB_SPHERE && type != PLUMB_CAPSULE)
    return answer(PLUMB_APPROXIMATE, note, "edges and corners are rounded off by the shape's margin: up to 2 cm late");
  if (kind == PLUMB_QUERY_CAST)
    return answer(PLUMB_NATIVE, note, "overlap at the start is found by a query of its own");
  if (kind == PLUMB_QUERY_TURNING_CAST)
    return answer(PLUMB_APPROXIMATE, note,
                  "in steps over the closest bodies: up to 1 mm early or late, and slow along what is nearly touched");
  if (kind == PLUMB_QUERY_PENETRATION)
    return answer(PLUMB_APPROXIMATE, note,
                  "as deep as Bullet's contacts: where one is deep in another often too little");
  return PLUMB_NATIVE;
}

/// In single precision Bullet's GJKs end a little early about edges and round sides.
PlumbDegree closest_degree(std::uint32_t type, const char*& note) {
  if (!is_convex(type)) return PLUMB_NONE;
  if (sizeof(btScalar) == 8 || type == PLUMB_SPHERE) return PLUMB_NATIVE;
  return answer(PLUMB_APPROXIMATE, note, "up to 1 mm too far, also of shapes that overlap by less");
}

PlumbDegree read_degree(std::uint32_t field, const char*& note) {
  return field == PLUMB_FIELD_ROLLING_FRICTION ? PLUMB_NATIVE : usual_degree(PLUMB_CAP_FIELD_READ, field, note);
}

PlumbDegree write_degree(std::uint32_t field, const char*& note) {
  if (field == PLUMB_FIELD_ROLLING_FRICTION) return PLUMB_NATIVE;
  if (field == PLUMB_FIELD_DAMPING)
    return answer(PLUMB_EMULATED, note, "exp(-c dt) by the adapter, which holds for any c");
  if (field == PLUMB_FIELD_SURFACE_VELOCITY) return PLUMB_EMULATED;
  return usual_degree(PLUMB_CAP_FIELD_WRITE, field, note);
}

PlumbDegree need_degree(std::uint32_t index, const char*& note) {
  if (index >= PLUMB_NEED_COUNT) return PLUMB_NONE;
  switch (PlumbNeeds{1} << index) {
    case PLUMB_NEED_FRICTION:
      return answer(PLUMB_APPROXIMATE, note, "a slide slows down by up to 3 % less or more, depending on its heading");
    case PLUMB_NEED_CCD:
      return answer(PLUMB_APPROXIMATE, note,
                    "a sphere inside a convex body is swept; compounds are not, and turning is not seen");
    case PLUMB_NEED_GYROSCOPIC:
      return answer(PLUMB_APPROXIMATE, note,
                    "one Newton step of an implicit law, which loses energy; see gyroscopic_mode");
    case PLUMB_NEED_RESTITUTION:
      return answer(PLUMB_NATIVE, note, "impacts slower than restitution_threshold do not bounce");
    case PLUMB_NEED_DAMPING: return answer(PLUMB_EMULATED, note, "exp(-c dt) by the adapter, which holds for any c");
    case PLUMB_NEED_SENSORS:
      return answer(PLUMB_EMULATED, note, "out of the contact points of bodies without response");
    case PLUMB_NEED_EVENTS: return answer(PLUMB_EMULATED, note, "by comparing the contacts of one step with the next");
    case PLUMB_NEED_SURFACE_VELOCITY:
      return answer(PLUMB_APPROXIMATE, note,
                    "by the direction and target velocity of each contact's friction, which is up to 3 % off");
    case PLUMB_NEED_AXIS_LOCKS: return answer(PLUMB_NATIVE, note, "the solver still counts the locked axes' mass");
    case PLUMB_NEED_ROLLING_FRICTION:
      return answer(
          PLUMB_APPROXIMATE, note,
          "of what presses with 1 N s a step or less (6 kg at 1/60 s), up to 13 % off, and at one point of a manifold");
    case PLUMB_NEED_SNAPSHOT: return answer(PLUMB_APPROXIMATE, note, "warm-start data are lost");
    default: return PLUMB_NATIVE;
  }
}

PlumbDegree modify_degree(std::uint32_t kind, std::uint32_t index, const char*& note) {
  if (kind == 0 && index < PLUMB_MODIFY_BODY_COUNT) return PLUMB_NATIVE;
  if (kind == 2 && backend::may_change(index))
    return answer(PLUMB_EMULATED, note, "by another shape in its place; all that rests on it wakes");
  if (kind != 1 || index >= PLUMB_MODIFY_JOINT_COUNT) return PLUMB_NONE;
  return answer(PLUMB_EMULATED, note, "by another constraint in its place, which starts without impulses");
}

PlumbDegree manifold_degree(std::uint32_t index, const char*& note) {
  if (index >= PLUMB_MANIFOLD_CHANGE_COUNT) return PLUMB_NONE;
  switch (1U << index) {
    case PLUMB_MANIFOLD_DISABLED:
      return answer(PLUMB_APPROXIMATE, note, "a body with PLUMB_BODY_CCD is swept against the other all the same");
    case PLUMB_MANIFOLD_SURFACE_VELOCITY:
      return answer(PLUMB_APPROXIMATE, note, "as that of bodies: friction is up to 3 % off");
    default: return PLUMB_NATIVE;
  }
}

PlumbDegree phase_degree(std::uint32_t phase) { return phase <= PLUMB_PHASE_CONTINUOUS ? PLUMB_NATIVE : PLUMB_NONE; }

}  // namespace

PlumbDegree World::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
  switch (kind) {
    case PLUMB_CAP_SHAPE: return shape_degree(a, b, note);
    case PLUMB_CAP_PAIR: return pair_degree(a, b, note);
    case PLUMB_CAP_JOINT: return joint_degree(a, note);
    case PLUMB_CAP_JOINT_FEATURE: return joint_feature_degree(a, b, note);
    case PLUMB_CAP_QUERY: return query_degree(a, b, note);
    case PLUMB_CAP_CLOSEST: return closest_degree(a, note);
    case PLUMB_CAP_FIELD_READ: return read_degree(a, note);
    case PLUMB_CAP_FIELD_WRITE: return write_degree(a, note);
    case PLUMB_CAP_NEED: return need_degree(a, note);
    case PLUMB_CAP_EVENT: return a < PLUMB_EVENT_COUNT ? PLUMB_EMULATED : PLUMB_NONE;
    case PLUMB_CAP_PHASE_TIME: return phase_degree(a);
    case PLUMB_CAP_RESIDUAL:
      return answer(PLUMB_NATIVE, note,
                    "largest squared change of an impulse in the last iteration; not with mlcp solvers");
    case PLUMB_CAP_SNAPSHOT: return answer(PLUMB_APPROXIMATE, note, "warm-start data are lost");
    case PLUMB_CAP_CHILD_MATERIAL: return PLUMB_NATIVE;
    case PLUMB_CAP_TRIANGLE_MATERIAL:
      if (a == PLUMB_HEIGHT_FIELD)
        return answer(PLUMB_EMULATED, note, "Bullet's point tells the place, not the triangle");
      return a == PLUMB_TRIANGLE_MESH ? PLUMB_NATIVE : PLUMB_NONE;
    case PLUMB_CAP_COOKING: return a == PLUMB_TRIANGLE_MESH ? PLUMB_NATIVE : PLUMB_NONE;
    case PLUMB_CAP_MODIFY: return modify_degree(a, b, note);
    case PLUMB_CAP_MANIFOLD: return manifold_degree(a, note);
    default: return PLUMB_NONE;
  }
}

}  // namespace plumb::bullet
