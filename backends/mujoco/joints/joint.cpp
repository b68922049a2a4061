#include "joints/joint.hpp"

#include "plumb/backend/mass_properties.hpp"

namespace plumb::mujoco {
namespace {

/// n . I^-1 n of a dynamic body in world axes; 0 of what forces do not turn.
double turning(const Body* body, const PlumbVec3& n) {
  if (body == nullptr || !body->is(PLUMB_DYNAMIC) || (body->desc.flags & PLUMB_BODY_NO_ROTATION) != 0) return 0;
  const PlumbVec3 u = unrotate(multiply(body->pose.orientation, body->desc.inertia_orientation), n);
  const PlumbVec3& i = body->desc.inertia;
  return u.x * u.x / i.x + u.y * u.y / i.y + u.z * u.z / i.z;
}

double inverse_mass(const Body* body) { return body != nullptr && body->is(PLUMB_DYNAMIC) ? 1 / body->desc.mass : 0; }

/// n . (1/m + r x I^-1 x r) n
double pushing(const Body* body, const PlumbVec3& at, const PlumbVec3& n) {
  return body == nullptr ? 0 : inverse_mass(body) + turning(body, cross(sub(at, body->centre()), n));
}

}  // namespace

bool can_close_a_loop(const PlumbJointDesc& desc) {
  if (desc.type == PLUMB_JOINT_DISTANCE) return true;
  const std::uint32_t open = open_axes(desc);
  if (!asks_nothing(desc, open)) return false;
  return open == 0 || open == kTurns || open == 0b001000;
}

void check_joint(const PlumbJointDesc& desc) {
  if (desc.type == PLUMB_JOINT_DISTANCE && desc.motors[0].enabled != 0)
    throw Error(PLUMB_E_UNSUPPORTED, "MuJoCo's rods have no motors; leave motors[0] out or take a slider");
}

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

}  // namespace plumb::mujoco
