// Joints of a world: made, broken, their rows.
#include <algorithm>

#include "plumb/assert.hpp"
#include "plumb/backend/modify.hpp"
#include "slots.hpp"
#include "world.hpp"

namespace plumb::ode {

PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  for (const PlumbJointDesc& desc : descs) check_joint(desc);
  return inside_ode([&] {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      const PlumbJointDesc& desc = descs[i];
      auto joint = std::make_unique<Joint>();
      joint->handle = ids[i];
      joint->desc = desc;
      joint->a = desc.body_a == 0 ? nullptr : &body(desc.body_a);
      joint->b = &body(desc.body_b);
      bind(*joint);
      joint_lists_.all.push_back(joint.get());
      put(slots_.joints, ids[i], std::move(joint));
    }
    return PLUMB_OK;
  });
}

PlumbResult World::destroy_joints(std::span<const PlumbJoint> ids) {
  return inside_ode([&] {
    for (const PlumbJoint id : ids) remove_joint(joint(id));
    return PLUMB_OK;
  });
}

void World::bind(Joint& joint) {
  PLUMB_ASSERT(!joint.solved() && joint.b != nullptr && joint.a != joint.b);
  joint.force = joint.torque = {};
  if (!joint.enabled || !(joint.b->dynamic() || (joint.a != nullptr && joint.a->dynamic()))) return;
  const PlumbJointDesc& desc = joint.desc;
  joint.watched = init_.needs(PLUMB_NEED_JOINT_REACTIONS) || desc.break_force > 0 || desc.break_torque > 0;
  attach(joint, world_);
  if (substep_.h != 0) set_parameters(joint, settings_, substep_.h);
  if (joint.a != nullptr && desc.collide_connected == 0) keep_apart(*joint.a, *joint.b);
  if (joint.watched || joint.needs_preparing()) joint_lists_.busy.push_back(&joint);
}

void World::unbind(Joint& joint) {
  for (Body* body : {joint.a, joint.b})
    if (body != nullptr) body->wake();
  if (!joint.solved()) return;
  if (joint.a != nullptr && joint.desc.collide_connected == 0) let_touch(*joint.a, *joint.b);
  dJointDestroy(joint.id);
  joint.id = nullptr;
  std::erase(joint_lists_.busy, &joint);
}

void World::remove_joint(Joint& joint) {
  unbind(joint);
  std::erase(joint_lists_.all, &joint);
  slots_.joints[slot_of(joint.handle)].reset();
}

PlumbResult World::modify_joints(std::span<const PlumbJointChange> changes) {
  std::vector<PlumbJointDesc> changed;
  for (const PlumbJointChange& change : changes) {
    changed.push_back(joint(change.joint).desc);
    backend::apply(change, changed.back());
    check_joint(changed.back());
  }
  return inside_ode([&] {
    for (std::size_t i = 0; i < changes.size(); ++i) {
      Joint& at = joint(changes[i].joint);
      unbind(at);
      at.desc = changed[i];
      if ((changes[i].what & PLUMB_MODIFY_ENABLED) != 0) at.enabled = changes[i].enabled != 0;
      bind(at);
    }
    return PLUMB_OK;
  });
}

PlumbResult World::read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) {
  double row[12];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Joint& read = joint(ids[i]);
    if (field == PLUMB_JOINT_COORDINATES) read_coordinates(read, row);
    if (field == PLUMB_JOINT_REACTION) {
      const double reaction[6] = {read.force.x,  read.force.y,  read.force.z,
                                  read.torque.x, read.torque.y, read.torque.z};
      std::copy(std::begin(reaction), std::end(reaction), row);
    }
    if (field == PLUMB_JOINT_SPRING_REST) backend::read_rest_row(read.desc, row);
    for (std::size_t axis = 0; field == PLUMB_JOINT_MOTOR && axis < 6; ++axis) {
      const PlumbMotor& motor = read.desc.motors[axis];
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
    for (std::size_t axis = 0; field == PLUMB_JOINT_MOTOR && axis < 6; ++axis) {
      const bool enabled = row[2 * axis + 1] != 0;
      changed.back().motors[axis] = {row[2 * axis], row[2 * axis + 1], enabled ? 1u : 0u, 0};
    }
    check_joint(changed.back());
  }
  return inside_ode([&] {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      Joint& written = joint(ids[i]);
      written.desc = changed[i];
      if (written.solved() && substep_.h != 0) set_parameters(written, settings_, substep_.h);
      for (Body* body : {written.a, written.b})
        if (body != nullptr) body->wake();
    }
    return PLUMB_OK;
  });
}

}  // namespace plumb::ode
