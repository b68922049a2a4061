// Joints of a world: made, broken, taken away, read, driven.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "plugin/rows/joint_rows.hpp"
#include "plugin/world.hpp"
#include "plumb/backend/joint_coordinates.hpp"
#include "plumb/backend/modify.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::impulse {

namespace {

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

/// Frame b seen from frame a; the turns about x, then the turned y, then the turned z, or a swing after a twist.
std::array<double, 6> coordinates(PlumbJointType type, const Placed& a, const Placed& b) {
  const Position at = rotate_back(a.axes, b.origin - a.origin);
  const QuatD turn = conjugate(a.axes) * b.axes;
  if (type == PLUMB_JOINT_SWING_TWIST) {
    const PlumbVec3 turns = backend::swing_twist({turn.x, turn.y, turn.z, turn.w});
    return {at.x, at.y, at.z, turns.x, turns.y, turns.z};
  }
  const Mat33<double> r = to_matrix(turn);
  return {
      at.x, at.y, at.z, std::atan2(-r.z.y, r.z.z), std::asin(std::clamp(r.z.x, -1.0, 1.0)), std::atan2(-r.y.x, r.x.x)};
}

}  // namespace

/// Puts the joint's descriptor before the engine, at first or as it is after a change.
void World::put_joint(std::uint32_t slot) {
  if (!joints_.records[slot].enabled) return;
  const PlumbJointDesc& desc = joints_.records[slot].desc;
  const JointRows rows = rows_of_joint(desc);
  Joint joint{};
  joint.type = rows.type;
  joint.rows = rows.rows;
  joint.pulls = rows.pulls;
  joint.body_a = desc.body_a == 0 ? kWorld : slot_of(desc.body_a);
  joint.body_b = slot_of(desc.body_b);
  joint.slot = slot;
  joint.first_step = simulation_.steps() + 1;
  joint.rest_length = static_cast<Real>(desc.rest_length);
  joint.frame_b = principal_frame(simulation_.bodies.frames[joint.body_b], desc.frame_b);
  if (joint.body_a != kWorld) {
    joint.frame_a = principal_frame(simulation_.bodies.frames[joint.body_a], desc.frame_a);
  } else {
    joint.frame_a = {{0, 0, 0}, to_quat(to_double(desc.frame_a.orientation))};
    joint.world_anchor = to_position(desc.frame_a.position);
  }
  simulation_.joints.add(
      joint, rows.axes,
      {desc.collide_connected != 0, rows.locks_turns, joints_.records[slot].breaks(), backend::is_meshing(desc.type)});
  simulation_.joints.drives.edit(slot) = rows.drive;
}

PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  for (const PlumbJointDesc& desc : descs) (void)rows_of_joint(desc);
  for (std::size_t i = 0; i < descs.size(); ++i) {
    const std::uint32_t slot = slot_of(ids[i]);
    if (slot >= joints_.records.size()) joints_.records.resize(slot + 1);
    joints_.records[slot] = {ids[i], descs[i], true, simulation_.steps()};
    put_joint(slot);
    if (joints_.records[slot].breaks()) ++joints_.breakable;
    wake_for_joint(descs[i]);
  }
  return PLUMB_OK;
}

void World::remove_joint(std::uint32_t slot) {
  if (joints_.records[slot].enabled) simulation_.joints.remove(slot);
  if (joints_.records[slot].breaks()) --joints_.breakable;
  joints_.records[slot].id = 0;
  pacing_.lets_go = true;
}

PlumbResult World::destroy_joints(std::span<const PlumbJoint> ids) {
  for (const PlumbJoint id : ids) {
    wake_for_joint(joints_.records[slot_of(id)].desc);
    remove_joint(slot_of(id));
  }
  return PLUMB_OK;
}

/// Joints whose mean load over the step was above their strength.
void World::break_joints() {
  if (joints_.breakable == 0) return;
  const std::vector<JointReaction> reactions = simulation_.joints.reactions();
  for (std::uint32_t slot = 0; slot < joints_.records.size(); ++slot) {
    const JointRecord& joint = joints_.records[slot];
    if (joint.id == 0 || !joint.enabled || !joint.breaks()) continue;
    const auto above = [&](const Vec& impulse, double strength) {
      return strength > 0 && static_cast<double>(length(impulse)) > strength * pacing_.dt;
    };
    if (!above(reactions[slot].force, joint.desc.break_force) &&
        !above(reactions[slot].torque, joint.desc.break_torque))
      continue;
    told_.events.push_back({PLUMB_EVENT_JOINT_BROKEN, 0, joint.desc.body_a, joint.desc.body_b, joint.id});
    wake_for_joint(joint.desc);
    remove_joint(slot);
  }
}

PlumbResult World::read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) {
  std::vector<JointReaction> reactions;
  if (field == PLUMB_JOINT_REACTION) reactions = simulation_.joints.reactions();
  if (field == PLUMB_JOINT_COORDINATES) {
    std::vector<std::uint32_t> bodies;
    for (const PlumbJoint id : ids) {
      const PlumbJointDesc& joint = joints_.records[slot_of(id)].desc;
      if (joint.body_a != 0) bodies.push_back(slot_of(joint.body_a));
      bodies.push_back(slot_of(joint.body_b));
    }
    simulation_.bodies.state.fetch(bodies, kPosePart);
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint32_t slot = slot_of(ids[i]);
    const PlumbJointDesc& joint = joints_.records[slot].desc;
    std::array<double, 12> row{};
    if (field == PLUMB_JOINT_COORDINATES) {
      const PlumbPose a = joint.body_a == 0 ? identity_pose() : pose(slot_of(joint.body_a));
      const auto six =
          coordinates(joint.type, placed(a, joint.frame_a), placed(pose(slot_of(joint.body_b)), joint.frame_b));
      std::copy(six.begin(), six.end(), row.begin());
    } else if (field == PLUMB_JOINT_REACTION) {
      const JointRecord& record = joints_.records[slot];
      if (!record.enabled || record.made_after == simulation_.steps()) {  // it was in no step yet
        rows.put(i, row.data(), joint_columns_of(field));
        continue;
      }
      for (int axis = 0; axis < 3; ++axis) {
        row[static_cast<std::size_t>(axis)] = static_cast<double>(reactions[slot].force[axis]) / pacing_.dt;
        row[static_cast<std::size_t>(axis) + 3] = static_cast<double>(reactions[slot].torque[axis]) / pacing_.dt;
      }
    } else if (field == PLUMB_JOINT_SPRING_REST) {
      backend::read_rest_row(joint, row.data());
    } else {
      for (std::size_t axis = 0; axis < 6; ++axis) {
        row[2 * axis] = joint.motors[axis].target_velocity;
        row[2 * axis + 1] = joint.motors[axis].enabled != 0 ? joint.motors[axis].max_force : 0;
      }
    }
    rows.put(i, row.data(), joint_columns_of(field));
  }
  return PLUMB_OK;
}

PlumbResult World::write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) {
  std::vector<PlumbJointDesc> written;
  std::array<double, 12> row{};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row.data(), joint_columns_of(field));
    written.push_back(joints_.records[slot_of(ids[i])].desc);
    (field == PLUMB_JOINT_MOTOR ? backend::apply_motor_row : backend::apply_rest_row)(row.data(), written.back());
    (void)rows_of_joint(written.back());
  }
  for (std::size_t i = 0; i < ids.size(); ++i)
    change_joint(slot_of(ids[i]), written[i], joints_.records[slot_of(ids[i])].enabled);
  return PLUMB_OK;
}

}  // namespace plumb::impulse
