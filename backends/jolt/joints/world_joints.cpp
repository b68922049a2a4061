// Joints of a world: made, read, driven, broken, taken away.
#include "plumb/backend/joint_coordinates.hpp"
#include "plumb/backend/modify.hpp"
#include "world.hpp"

namespace plumb::jolt {
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

PlumbPose from_centre(const PlumbPose& frame, const JPH::Body& body) {
  return {backend::sub(frame.position, to_plumb(body.GetShape()->GetCenterOfMass())), frame.orientation};
}

}  // namespace

Ends World::ends_of(const PlumbJointDesc& desc) {
  JPH::Body& b = *body(desc.body_b).jolt;
  if (desc.body_a == 0) return {JPH::Body::sFixedToWorld, b, desc.frame_a, from_centre(desc.frame_b, b)};
  JPH::Body& a = *body(desc.body_a).jolt;
  return {a, b, from_centre(desc.frame_a, a), from_centre(desc.frame_b, b)};
}

PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  std::vector<std::unique_ptr<Joint>> made;
  for (std::size_t i = 0; i < descs.size(); ++i) {
    const PlumbJointDesc& desc = descs[i];
    check_joint(desc);
    auto joint = std::make_unique<Joint>();
    joint->handle = ids[i];
    joint->desc = desc;
    make_constraints(*joint, ends_of(desc));
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

void World::add_joint(const Joint& joint) {
  if (joint.keeps_apart()) keep_apart(body(joint.desc.body_a), body(joint.desc.body_b), 1);
  give_constraints(joint);
}

void World::remove_joint(const Joint& joint) {
  if (joint.keeps_apart()) keep_apart(body(joint.desc.body_a), body(joint.desc.body_b), -1);
  take_constraints(joint);
}

void World::give_constraints(const Joint& joint) {
  if (!joint.enabled) return;
  for (JPH::TwoBodyConstraint* constraint : {joint.main.GetPtr(), joint.helper.GetPtr()}) {
    if (constraint == nullptr) continue;
    constraint->SetConstraintPriority(slot_of(joint.handle));
    system_.AddConstraint(constraint);
  }
  interface().ActivateConstraint(joint.main);
}

void World::take_constraints(const Joint& joint) {
  if (!joint.enabled) return;
  interface().ActivateConstraint(joint.main);
  for (JPH::TwoBodyConstraint* constraint : {joint.main.GetPtr(), joint.helper.GetPtr()})
    if (constraint != nullptr) system_.RemoveConstraint(constraint);
}

/// Reactions are along the axes that a step begins with.
void World::remember_axes() {
  for (const auto& joint : joints_) {
    if (!joint || !(joint->may_break() || needs(PLUMB_NEED_JOINT_REACTIONS))) continue;
    const PlumbJointDesc& desc = joint->desc;
    joint->at_a = desc.body_a == 0 ? desc.frame_a : backend::compose(body(desc.body_a).pose(), desc.frame_a);
    joint->at_b = backend::compose(body(desc.body_b).pose(), desc.frame_b);
  }
}

/// Jolt tells what its constraints push with, and leaves them.
void World::break_joints() {
  for (auto& joint : joints_) {
    if (!joint || !joint->may_break()) continue;
    const PlumbJointDesc& desc = joint->desc;
    const Impulse impulse = reaction(*joint);
    const double force = backend::length(impulse.force) / last_.part,
                 torque = backend::length(impulse.torque) / last_.part;
    if (!(desc.break_force > 0 && force > desc.break_force) && !(desc.break_torque > 0 && torque > desc.break_torque))
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
      const Impulse impulse = reaction(read);
      const double per_second = last_.part > 0 ? 1 / last_.part : 0;
      put_vector(backend::scale(per_second, impulse.force), row);
      put_vector(backend::scale(per_second, impulse.torque), row + 3);
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
    const std::uint32_t columns = joint_columns_of(field);
    rows.get(i, row, columns);
    for (std::uint32_t k = 0; k < columns; ++k) (void)number(row[k]);
    changed.push_back(joint(ids[i]).desc);
    if (field == PLUMB_JOINT_SPRING_REST) backend::apply_rest_row(row, changed.back());
    if (field == PLUMB_JOINT_MOTOR) backend::apply_motor_row(row, changed.back());
    check_joint(changed.back());
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Joint& at = joint(ids[i]);
    at.desc = changed[i];
    if (make_helper(at, ends_of(at.desc)) && at.enabled) {
      at.helper->SetConstraintPriority(slot_of(at.handle));
      system_.AddConstraint(at.helper);
    }
    drive(at);
    interface().ActivateConstraint(at.main);
  }
  return PLUMB_OK;
}

}  // namespace plumb::jolt
