#include "joints/joint.hpp"

#include <numbers>

namespace plumb::dart6 {
namespace {

/// n . I^-1 n of a dynamic body in world axes; 0 of what forces do not turn.
double turning(const Body* body, const PlumbVec3& n) {
  if (body == nullptr || !body->is(PLUMB_DYNAMIC) || !body->turns()) return 0;
  const PlumbVec3 u = unrotate(multiply(body->pose.orientation, body->desc.inertia_orientation), n);
  const PlumbVec3& i = body->desc.inertia;
  return u.x * u.x / i.x + u.y * u.y / i.y + u.z * u.z / i.z;
}

double inverse_mass(const Body* body) { return body != nullptr && body->is(PLUMB_DYNAMIC) ? 1 / body->desc.mass : 0; }

/// n . (1/m + r x I^-1 x r) n
double pushing(const Body* body, const PlumbVec3& at, const PlumbVec3& n) {
  return body == nullptr ? 0 : inverse_mass(body) + turning(body, cross(sub(at, body->centre()), n));
}

/// kg or kg m2, against which a force along the axis works, with nothing else holding the bodies.
double effective_mass(const Joint& joint, std::size_t axis) {
  const PlumbPose a = joint.frame_a(), b = joint.frame_b();
  if (axis >= 3) {
    const PlumbVec3 n = rotate(axis == 3 ? a.orientation : b.orientation, unit(axis - 3));
    return 1 / (turning(joint.a, n) + turning(joint.b, n));
  }
  const bool rod = joint.desc.type == PLUMB_JOINT_DISTANCE;
  if (!rod && joint.desc.type != PLUMB_JOINT_GENERIC) return 1 / (inverse_mass(joint.a) + inverse_mass(joint.b));
  const PlumbVec3 way = sub(b.position, a.position);
  const PlumbVec3 n = rod && length(way) > 1e-9 ? normalized(way) : rotate(a.orientation, unit(axis));
  return 1 / (pushing(joint.a, rod ? a.position : b.position, n) + pushing(joint.b, b.position, n));
}

}  // namespace

bool can_be_link(const Joint& joint) {
  const auto turns = [](const Body* body) { return body == nullptr || !body->is(PLUMB_DYNAMIC) || body->turns(); };
  return joint.desc.type != PLUMB_JOINT_DISTANCE && turns(joint.a) && turns(joint.b);
}

bool can_close_a_loop(const PlumbJointDesc& desc) {
  if (desc.type == PLUMB_JOINT_DISTANCE) return true;
  return asks_nothing(desc, open_axes(desc));
}

void check_joint(const PlumbJointDesc& desc) {
  if (desc.type == PLUMB_JOINT_DISTANCE && desc.motors[0].enabled != 0)
    throw Error(PLUMB_E_UNSUPPORTED, "rods have no motors here; leave motors[0] out or take a slider");
}

Stiffness stiffness_of(const Joint& joint, std::size_t axis) {
  const PlumbSpring& spring = joint.desc.springs[axis];
  if (spring.mode != PLUMB_SPRING_FREQUENCY) return {spring.frequency, spring.damping_ratio};
  const double mass = effective_mass(joint, axis), rate = 2 * std::numbers::pi * spring.frequency;
  return {mass * rate * rate, 2 * spring.damping_ratio * mass * rate};
}

}  // namespace plumb::dart6
