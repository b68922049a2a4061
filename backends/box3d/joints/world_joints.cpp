// Joints of a world: made, read, driven, taken away.
#include "plumb/backend/joint_coordinates.hpp"
#include "plumb/backend/modify.hpp"
#include "world.hpp"

namespace plumb::box3d {
namespace {

/// Two frames in world axes; of a distance joint their origins' distance stands for the first coordinate.
void coordinates(const PlumbJointDesc& desc, const PlumbPose& a, const PlumbPose& b, double* row) {
  backend::joint_coordinates(desc.type, a, b, row);
  if (desc.type != PLUMB_JOINT_DISTANCE) return;
  row[0] = backend::length({row[0], row[1], row[2]});
  row[1] = row[2] = 0;
}

void put_force(const PlumbVec3& v, double* row) {
  row[0] = v.x;
  row[1] = v.y;
  row[2] = v.z;
}

}  // namespace

PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  for (const PlumbJointDesc& desc : descs) check_joint(desc);
  std::vector<std::unique_ptr<Joint>> made;
  try {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      const PlumbJointDesc& desc = descs[i];
      b3JointDef base = base_of(desc, desc.body_a == 0 ? ground_ : body(desc.body_a).id, body(desc.body_b).id);
      base.userData = reinterpret_cast<void*>(std::uintptr_t{slot_of(ids[i])});
      base.constraintHertz = static_cast<float>(settings_.joint_hertz);
      base.constraintDampingRatio = static_cast<float>(settings_.joint_damping_ratio);
      made.push_back(std::make_unique<Joint>(Joint{ids[i], make_joint(world_, desc, base), desc}));
    }
  } catch (...) {
    for (const auto& joint : made) b3DestroyJoint(joint->id, false);
    throw;
  }
  for (auto& joint : made) {
    if (joint->may_break()) ++breakable_;
    put(joints_, joint->handle, std::move(joint));
  }
  return PLUMB_OK;
}

PlumbResult World::destroy_joints(std::span<const PlumbJoint> ids) {
  for (const PlumbJoint id : ids) remove_joint(joint(id));
  return PLUMB_OK;
}

void World::remove_joint(Joint& joint) {
  if (joint.may_break()) --breakable_;
  b3DestroyJoint(joint.id, true);
  joints_[slot_of(joint.handle)].reset();
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
      put_force(to_plumb(b3Joint_GetConstraintForce(read.id)), row);
      put_force(to_plumb(b3Joint_GetConstraintTorque(read.id)), row + 3);
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
    for (std::size_t axis = 0; field == PLUMB_JOINT_SPRING_REST && axis < 6; ++axis)
      (void)scalar(row[axis], "rest of a spring");
    if (field == PLUMB_JOINT_SPRING_REST) backend::apply_rest_row(row, changed.back());
    for (std::size_t axis = 0; field == PLUMB_JOINT_MOTOR && axis < 6; ++axis) {
      const PlumbMotor motor{row[2 * axis], row[2 * axis + 1], row[2 * axis + 1] != 0 ? 1u : 0u, 0};
      (void)scalar(motor.target_velocity, "target velocity"), (void)scalar(motor.max_force, "max force");
      changed.back().motors[axis] = motor;
    }
    check_joint(changed.back());
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    joint(ids[i]).desc = changed[i];
    if (field == PLUMB_JOINT_MOTOR) apply_motor(joint(ids[i]));
    if (field == PLUMB_JOINT_SPRING_REST) apply_rest(joint(ids[i]));
    b3Joint_WakeBodies(joint(ids[i]).id);
  }
  return PLUMB_OK;
}

}  // namespace plumb::box3d
