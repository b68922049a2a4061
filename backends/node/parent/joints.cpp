// Joints: their coordinates are worked out from poses, and they are broken by their reactions.
#include <cmath>

#include "append.hpp"
#include "plumb/backend/modify.hpp"
#include "plumb/backend/small_math.hpp"
#include "world.hpp"

namespace plumb::wire {

using namespace backend;

namespace {

/// Of b's frame in a's: a translation, and the angles of R = Rx(q3) Ry(q4) Rz(q5).
void put_coordinates(const PlumbPose& a, const PlumbPose& b, double* row) {
  const PlumbPose relative = compose(inverse(a), b);
  const Matrix3 r = rotation_matrix(relative.orientation);
  row[0] = relative.position.x, row[1] = relative.position.y, row[2] = relative.position.z;
  row[3] = std::atan2(-r[1][2], r[2][2]);
  row[4] = std::asin(std::fmax(-1, std::fmin(1, r[0][2])));
  row[5] = std::atan2(-r[0][1], r[0][0]);
}

void put_motors(const PlumbJointDesc& desc, double* row) {
  for (std::size_t axis = 0; axis < 6; ++axis) {
    row[2 * axis] = desc.motors[axis].target_velocity;
    row[2 * axis + 1] = desc.motors[axis].enabled != 0 ? desc.motors[axis].max_force : 0;
  }
}

}  // namespace

PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  std::vector<double> rows = {double(descs.size())};
  for (std::size_t i = 0; i < descs.size(); ++i) append_joint(rows, slot_of(ids[i]), descs[i]);
  call(Call::kCreateJoints, rows);
  for (std::size_t i = 0; i < descs.size(); ++i) {
    if (slot_of(ids[i]) >= joints_.size()) joints_.resize(slot_of(ids[i]) + 1);
    joints_[slot_of(ids[i])] = {ids[i], descs[i]};
    if (descs[i].break_force > 0 || descs[i].break_torque > 0) breakable_.insert(ids[i]);
  }
  return PLUMB_OK;
}

void World::remove_joints(std::span<const PlumbJoint> ids) {
  std::vector<double> slots;
  for (const PlumbJoint id : ids) slots.push_back(slot_of(id));
  call(Call::kDestroyJoints, slots);
  for (const PlumbJoint id : ids) {
    joints_[slot_of(id)] = {};
    breakable_.erase(id);
  }
}

PlumbResult World::destroy_joints(std::span<const PlumbJoint> ids) { return remove_joints(ids), PLUMB_OK; }

PlumbResult World::read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) {
  if (ids.empty()) return PLUMB_OK;
  if (field == PLUMB_JOINT_REACTION) {
    std::vector<double> slots;
    for (const PlumbJoint id : ids) slots.push_back(slot_of(id));
    const Frame reply = call(Call::kReactions, slots);
    if (reply.numbers.size() != 6 * ids.size())
      throw Error(PLUMB_E_INTERNAL, "the child gave no six numbers a joint as reactions");
    for (std::size_t i = 0; i < ids.size(); ++i) rows.put(i, &reply.numbers[6 * i], 6);
    return PLUMB_OK;
  }
  std::vector<double> poses;
  if (field == PLUMB_JOINT_COORDINATES) {
    std::vector<PlumbBody> ends;
    for (const PlumbJoint id : ids)
      for (const PlumbBody end : {joints_[slot_of(id)].desc.body_a, joints_[slot_of(id)].desc.body_b})
        ends.push_back(end != 0 ? end : joints_[slot_of(id)].desc.body_b);
    poses = read_rows(PLUMB_FIELD_POSE, ends);
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const PlumbJointDesc& desc = joints_[slot_of(ids[i])].desc;
    double row[12];
    if (field == PLUMB_JOINT_COORDINATES) {
      const PlumbPose a = desc.body_a == 0 ? identity_pose() : pose_at(&poses[14 * i]);
      put_coordinates(compose(a, desc.frame_a), compose(pose_at(&poses[14 * i + 7]), desc.frame_b), row);
    } else if (field == PLUMB_JOINT_SPRING_REST) {
      backend::read_rest_row(desc, row);
    } else {
      put_motors(desc, row);
    }
    rows.put(i, row, joint_columns_of(field));
  }
  return PLUMB_OK;
}

PlumbResult World::write_joints(PlumbJointField, std::span<const PlumbJoint> ids, ConstRows rows) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    double row[12];
    rows.get(i, row, 12);
    numbers.push_back(slot_of(ids[i]));
    numbers.insert(numbers.end(), row, row + 12);
  }
  call(Call::kWriteMotors, numbers);
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t axis = 0; axis < 6; ++axis) {
      const double *motor = &numbers[13 * i + 1 + 2 * axis], most = motor[1];
      joints_[slot_of(ids[i])].desc.motors[axis] = {motor[0], most, most != 0 ? 1u : 0u, 0};
    }
  return PLUMB_OK;
}

void World::break_joints(double) {
  if (breakable_.empty()) return;
  const std::vector<PlumbJoint> watched(breakable_.begin(), breakable_.end());
  std::vector<double> reactions(6 * watched.size());
  read_joints(PLUMB_JOINT_REACTION, watched,
              {reinterpret_cast<std::byte*>(reactions.data()), watched.size(), 6 * sizeof(double), PLUMB_F64});
  std::vector<PlumbJoint> broken;
  for (std::size_t i = 0; i < watched.size(); ++i) {
    const PlumbJointDesc& desc = joints_[slot_of(watched[i])].desc;
    const double force = length(vec3_at(&reactions[6 * i])), torque = length(vec3_at(&reactions[6 * i + 3]));
    if (!(desc.break_force > 0 && force > desc.break_force) && !(desc.break_torque > 0 && torque > desc.break_torque))
      continue;
    events_.push_back({PLUMB_EVENT_JOINT_BROKEN, 0, desc.body_a, desc.body_b, watched[i]});
    broken.push_back(watched[i]);
  }
  if (!broken.empty()) remove_joints(broken);
}

}  // namespace plumb::wire
