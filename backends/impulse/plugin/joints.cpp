// Joints of a world: made, taken away, read.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "plugin/world.hpp"

namespace plumb::impulse {

namespace {

JointType joint_type(PlumbJointType type) {
  switch (type) {
    case PLUMB_JOINT_BALL: return JointType::kBall;
    case PLUMB_JOINT_HINGE: return JointType::kHinge;
    case PLUMB_JOINT_SLIDER: return JointType::kSlider;
    case PLUMB_JOINT_DISTANCE: return JointType::kDistance;
    case PLUMB_JOINT_FIXED: return JointType::kFixed;
    default: throw Error(PLUMB_E_UNSUPPORTED, "joint type " + std::to_string(type) + " is not in impulse yet");
  }
}

/// From the interface's frame on a body to the engine's, which is on the principal axes about the centre of mass.
Frame principal_frame(const BodyFrame& body, const PlumbPose& frame) {
  const QuatD to_principal = conjugate(body.principal);
  const Position at = rotate(to_principal, to_position(frame.position) - body.centre_of_mass);
  return {to_vec(PlumbVec3{at.x, at.y, at.z}), to_quat(to_principal * to_double(frame.orientation))};
}

struct Placed {
  Position origin;
  QuatD axes;
};
Placed placed(const PlumbPose& body, const PlumbPose& frame) {
  const QuatD q = to_double(body.orientation);
  return {to_position(body.position) + rotate(q, to_position(frame.position)), q * to_double(frame.orientation)};
}

/// Frame b seen from frame a; the turns about x, then the turned y, then the turned z.
std::array<double, 6> coordinates(const Placed& a, const Placed& b) {
  const Position at = rotate_back(a.axes, b.origin - a.origin);
  const Mat33<double> r = to_matrix(conjugate(a.axes) * b.axes);
  return {
      at.x, at.y, at.z, std::atan2(-r.z.y, r.z.z), std::asin(std::clamp(r.z.x, -1.0, 1.0)), std::atan2(-r.y.x, r.x.x)};
}

}  // namespace

PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  for (std::size_t i = 0; i < descs.size(); ++i) {
    const PlumbJointDesc& desc = descs[i];
    const std::uint32_t slot = slot_of(ids[i]);
    Joint joint{};
    joint.type = joint_type(desc.type);
    joint.body_a = desc.body_a == 0 ? kWorld : slot_of(desc.body_a);
    joint.body_b = slot_of(desc.body_b);
    joint.slot = slot;
    joint.born = simulation_.steps() + 1;
    joint.rest_length = static_cast<Real>(desc.rest_length);
    joint.frame_b = principal_frame(simulation_.frames[joint.body_b], desc.frame_b);
    if (joint.body_a != kWorld) {
      joint.frame_a = principal_frame(simulation_.frames[joint.body_a], desc.frame_a);
    } else {
      joint.frame_a = {{0, 0, 0}, to_quat(to_double(desc.frame_a.orientation))};
      joint.world_anchor = to_position(desc.frame_a.position);
    }
    simulation_.joints.add(joint, desc.collide_connected != 0);
    if (slot >= joints_.size()) joints_.resize(slot + 1);
    joints_[slot] = desc;
    wake_for_joint(desc);
  }
  return PLUMB_OK;
}

PlumbResult World::destroy_joints(std::span<const PlumbJoint> ids) {
  for (const PlumbJoint id : ids) {
    wake_for_joint(joints_[slot_of(id)]);
    simulation_.joints.remove(slot_of(id));
  }
  return PLUMB_OK;
}

PlumbResult World::read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) {
  if (field == PLUMB_JOINT_REACTION) throw Error(PLUMB_E_UNSUPPORTED, "reactions of joints are not in impulse yet");
  std::vector<std::uint32_t> bodies;
  for (const PlumbJoint id : ids) {
    const PlumbJointDesc& joint = joints_[slot_of(id)];
    if (joint.body_a != 0) bodies.push_back(slot_of(joint.body_a));
    bodies.push_back(slot_of(joint.body_b));
  }
  simulation_.state.fetch(bodies, kPosePart);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const PlumbJointDesc& joint = joints_[slot_of(ids[i])];
    std::array<double, 12> row{};  // no joint has a motor: its speed and force are 0
    if (field == PLUMB_JOINT_COORDINATES) {
      const PlumbPose a = joint.body_a == 0 ? identity_pose() : pose(slot_of(joint.body_a));
      const auto six = coordinates(placed(a, joint.frame_a), placed(pose(slot_of(joint.body_b)), joint.frame_b));
      std::copy(six.begin(), six.end(), row.begin());
    }
    rows.put(i, row.data(), joint_columns_of(field));
  }
  return PLUMB_OK;
}

PlumbResult World::write_joints(PlumbJointField /*field*/, std::span<const PlumbJoint> ids, ConstRows rows) {
  std::array<double, 12> row{};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row.data(), row.size());
    if (std::any_of(row.begin(), row.end(), [](double number) { return number != 0; }))
      throw Error(PLUMB_E_UNSUPPORTED, "rows[" + std::to_string(i) + "]: motors of joints are not in impulse yet");
  }
  return PLUMB_OK;
}

}  // namespace plumb::impulse
