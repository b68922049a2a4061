// Joints of a world: made, read, driven, broken, taken away.
#include "plumb/backend/joint_coordinates.hpp"
#include "plumb/backend/modify.hpp"
#include "world.hpp"

namespace plumb::px {
namespace {

/// Two frames in world axes; of a distance joint their origins' distance stands for the first coordinate.
void coordinates(const PlumbJointDesc& desc, const PlumbPose& a, const PlumbPose& b, double* row) {
  backend::joint_coordinates(desc.type, a, b, row);
  if (desc.type != PLUMB_JOINT_DISTANCE) return;
  row[0] = backend::length({row[0], row[1], row[2]});
  row[1] = row[2] = 0;
}

void put_vector(const PlumbVec3& v, double* row) {
  row[0] = v.x;
  row[1] = v.y;
  row[2] = v.z;
}

}  // namespace

Ends World::ends_of(const PlumbJointDesc& desc) {
  return {desc.body_a == 0 ? nullptr : body(desc.body_a).actor, body(desc.body_b).actor,
          transform(desc.frame_a, "frame_a"), transform(desc.frame_b, "frame_b")};
}

PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  for (const PlumbJointDesc& desc : descs) check_joint(desc);
  std::vector<std::unique_ptr<Joint>> made;
  for (std::size_t i = 0; i < descs.size(); ++i) {
    auto joint = std::make_unique<Joint>();
    joint->handle = ids[i];
    joint->desc = descs[i];
    make_native(*joint, ends_of(descs[i]));
    made.push_back(std::move(joint));
  }
  for (auto& joint : made) {
    add_joint(*joint);
    put(joints_, joint->handle, std::move(joint));
  }
  return PLUMB_OK;
}

PlumbResult World::destroy_joints(std::span<const PlumbJoint> ids) {
  for (const PlumbJoint id : ids) {
    remove_joint(joint(id));
    joints_[slot_of(id)].reset();
  }
  return PLUMB_OK;
}

void World::add_joint(Joint& joint) {
  if (joint.keeps_apart()) keep_apart(body(joint.desc.body_a), body(joint.desc.body_b), 1);
  wake_joint(joint);
}

void World::remove_joint(Joint& joint) {
  if (joint.keeps_apart()) keep_apart(body(joint.desc.body_a), body(joint.desc.body_b), -1);
  wake_joint(joint);
  drop_native(joint);
}

void World::wake_joint(const Joint& joint) {
  for (const PlumbBody handle : {joint.desc.body_a, joint.desc.body_b})
    if (handle != 0 && body(handle).is(PLUMB_DYNAMIC)) body(handle).dynamic().wakeUp();
}

void World::remember_turns() {
  for (const auto& joint : joints_)
    if (joint)
      for (const auto& row : joint->rows) row->remember_turns();
}

/// The adapter looks itself: several of PhysX's may stand for one joint.
void World::break_joints() {
  for (auto& joint : joints_) {
    if (!joint || !joint->may_break()) continue;
    const PlumbJointDesc& desc = joint->desc;
    const Reaction pull = reaction(*joint);
    if (!(desc.break_force > 0 && backend::length(pull.force) > desc.break_force) &&
        !(desc.break_torque > 0 && backend::length(pull.torque) > desc.break_torque))
      continue;
    events_.push_back({PLUMB_EVENT_JOINT_BROKEN, 0, desc.body_a, desc.body_b, joint->handle});
    remove_joint(*joint);
    joint.reset();
  }
}

PlumbResult World::read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) {
  double row[12];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Joint& read = joint(ids[i]);
    const PlumbJointDesc& desc = read.desc;
    if (field == PLUMB_JOINT_COORDINATES) {
      const PlumbPose a = desc.body_a == 0 ? identity_pose() : body(desc.body_a).pose();
      coordinates(desc, backend::compose(a, desc.frame_a), backend::compose(body(desc.body_b).pose(), desc.frame_b),
                  row);
    }
    if (field == PLUMB_JOINT_REACTION) {
      const Reaction pull = reaction(read);
      put_vector(pull.force, row);
      put_vector(pull.torque, row + 3);
    }
    if (field == PLUMB_JOINT_SPRING_REST) backend::read_rest_row(desc, row);
    for (std::size_t axis = 0; field == PLUMB_JOINT_MOTOR && axis < 6; ++axis) {
      const PlumbMotor& motor = desc.motors[axis];
      row[2 * axis] = motor.target_velocity;
      row[2 * axis + 1] = motor.enabled != 0 ? motor.max_force : 0;
    }
    rows.put(i, row, joint_columns_of(field));
  }
  return PLUMB_OK;
}

PlumbResult World::write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) {
  std::vector<PlumbJointDesc> changed;
  double row[12];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row, joint_columns_of(field));
    changed.push_back(joint(ids[i]).desc);
    if (field == PLUMB_JOINT_SPRING_REST) backend::apply_rest_row(row, changed.back());
    if (field == PLUMB_JOINT_MOTOR) backend::apply_motor_row(row, changed.back());
    check_joint(changed.back());
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Joint& at = joint(ids[i]);
    at.desc = changed[i];
    if (!drive(at)) make_native(at, ends_of(at.desc));
    wake_joint(at);
  }
  return PLUMB_OK;
}

}  // namespace plumb::px
