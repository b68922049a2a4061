// Joints of a world: create, destroy, read, write, react and break.
#include <algorithm>

#include "plumb/assert.hpp"
#include "plumb/backend/modify.hpp"
#include "world.hpp"

namespace plumb::bullet {

std::unique_ptr<Joint> World::make_joint(const PlumbJointDesc& desc, PlumbJoint handle) {
  auto joint = std::make_unique<Joint>(handle, desc);
  joint->body_b = &body(desc.body_b);
  joint->body_a = desc.body_a == 0 ? nullptr : &body(desc.body_a);
  joint->a = joint->body_a == nullptr ? &ground_ : static_cast<btRigidBody*>(joint->body_a);
  const btTransform frame_a = transform(desc.frame_a, "frame_a"), frame_b = transform(desc.frame_b, "frame_b");
  joint->frame_a = joint->body_a == nullptr ? frame_a : joint->body_a->mass_to_body * frame_a;
  joint->frame_b = joint->body_b->mass_to_body * frame_b;
  if (joint->body_a == nullptr || !joint->body_a->offset_frame) joint->frame_a = frame_a;
  if (!joint->body_b->offset_frame) joint->frame_b = frame_b;
  make_constraint(*joint);
  PLUMB_ASSERT(joint->constraint != nullptr && joint->body_a != joint->body_b);
  joint->wants_reaction = needs(PLUMB_NEED_JOINT_REACTIONS) || joint->breaks();
  if (joint->wants_reaction) {
    joint->feedback = std::make_unique<btJointFeedback[]>(1 + joint->springs.size());
    for (std::size_t k = 0; k <= joint->springs.size(); ++k) joint->feedback[k] = {};
    joint->constraint->setJointFeedback(&joint->feedback[0]);
    for (std::size_t k = 0; k < joint->springs.size(); ++k)
      joint->springs[k]->setJointFeedback(&joint->feedback[1 + k]);
  }
  return joint;
}

PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  std::vector<std::unique_ptr<Joint>> made;
  for (std::size_t i = 0; i < descs.size(); ++i) made.push_back(make_joint(descs[i], ids[i]));
  for (auto& joint : made) {
    add_to_bullet(*joint);
    const std::size_t slot = slot_of(joint->handle);
    if (joints_.size() <= slot) joints_.resize(slot + 1);
    joints_[slot] = std::move(joint);
  }
  return PLUMB_OK;
}

/// Where it can do something: Bullet would divide by the mass of two bodies that nothing moves.
void World::add_to_bullet(Joint& joint) {
  if (joint.body_a != nullptr) wake(*joint.body_a);
  wake(*joint.body_b);
  const bool moves = joint.body_b->is(PLUMB_DYNAMIC) || (joint.body_a != nullptr && joint.body_a->is(PLUMB_DYNAMIC));
  PLUMB_ASSERT(!joint.solved);
  joint.solved = joint.enabled && moves;
  if (!joint.solved) return;
  const bool apart = joint.desc.collide_connected == 0 && joint.body_a != nullptr;
  world_.addConstraint(joint.constraint.get(), apart);
  for (auto& spring : joint.springs) world_.addConstraint(spring.get(), false);
  if (apart) forget_contacts(*joint.body_a, *joint.body_b);
  ++lists_.joint_count;
}

void World::take_from_bullet(Joint& joint) {
  if (joint.body_a != nullptr) wake(*joint.body_a);
  wake(*joint.body_b);
  if (!joint.solved) return;
  for (auto& spring : joint.springs) world_.removeConstraint(spring.get());
  world_.removeConstraint(joint.constraint.get());
  joint.solved = false;
  PLUMB_ASSERT(lists_.joint_count > 0);
  --lists_.joint_count;
}

void World::remove_joint(Joint& joint) {
  take_from_bullet(joint);
  joints_[slot_of(joint.handle)].reset();
}

PlumbResult World::destroy_joints(std::span<const PlumbJoint> ids) {
  for (const PlumbJoint id : ids) remove_joint(joint(id));
  return PLUMB_OK;
}

PlumbResult World::read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Joint& at = joint(ids[i]);
    double row[12] = {};
    if (field == PLUMB_JOINT_COORDINATES) {
      joint_coordinates(at, row);
    } else if (field == PLUMB_JOINT_REACTION) {
      std::copy_n(at.force, 3, row);
      std::copy_n(at.torque, 3, row + 3);
    } else if (field == PLUMB_JOINT_SPRING_REST) {
      backend::read_rest_row(at.desc, row);
    } else {
      for (std::size_t axis = 0; axis < 6; ++axis) {
        row[2 * axis] = at.desc.motors[axis].target_velocity;
        row[2 * axis + 1] = at.desc.motors[axis].max_force;
      }
    }
    rows.put(i, row, joint_columns_of(field));
  }
  return PLUMB_OK;
}

void World::check_drive_row(PlumbJointField field, const PlumbJointDesc& desc, const double* row) {
  for (std::size_t axis = 0; field == PLUMB_JOINT_SPRING_REST && axis < 6; ++axis)
    (void)scalar(row[axis], "the rest of a spring");
  for (std::size_t axis = 0; field == PLUMB_JOINT_MOTOR && axis < 6; ++axis) {
    (void)scalar(row[2 * axis], "the target velocity of a motor");
    (void)scalar(row[2 * axis + 1], "the max force of a motor");
    if (row[2 * axis + 1] != 0 && !may_have_motor(desc, axis))
      throw Error(PLUMB_E_UNSUPPORTED, "Bullet has no motor on axis " + std::to_string(axis) + " of this joint");
  }
}

PlumbResult World::write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) {
  double row[12];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row, joint_columns_of(field));
    check_drive_row(field, joint(ids[i]).desc, row);
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row, joint_columns_of(field));
    Joint& at = joint(ids[i]);
    if (field == PLUMB_JOINT_MOTOR) backend::apply_motor_row(row, at.desc);
    if (field == PLUMB_JOINT_SPRING_REST) {
      backend::apply_rest_row(row, at.desc);
      set_rests(at);
    }
    if (at.body_a != nullptr) wake(*at.body_a);
    wake(*at.body_b);
  }
  return PLUMB_OK;
}

void World::prepare_joints(btScalar h) {
  for (auto& joint : joints_) {
    if (!joint || !joint->solved) continue;
    set_motors(*joint, h);
    if (joint->wants_reaction)
      joint->arm_b = joint->body_b->getWorldTransform().getBasis() * joint->frame_b.getOrigin();
  }
}

void World::break_joints() {
  for (auto& at : joints_) {
    if (!at || !at->solved || !at->wants_reaction) continue;
    PLUMB_ASSERT(at->feedback != nullptr && at->constraint->getJointFeedback() == &at->feedback[0]);
    btVector3 force(0, 0, 0), torque(0, 0, 0);
    for (std::size_t k = 0; k <= at->springs.size(); ++k) {
      const bool first = k == 0 && &at->constraint->getRigidBodyA() == at->body_b;
      force += first ? at->feedback[k].m_appliedForceBodyA : at->feedback[k].m_appliedForceBodyB;
      torque += first ? at->feedback[k].m_appliedTorqueBodyA : at->feedback[k].m_appliedTorqueBodyB;
    }
    torque -= at->arm_b.cross(force);
    put_vector(force, at->force);
    put_vector(torque, at->torque);
    const PlumbJointDesc& desc = at->desc;
    const bool broken = (desc.break_force > 0 && static_cast<double>(force.length()) > desc.break_force) ||
                        (desc.break_torque > 0 && static_cast<double>(torque.length()) > desc.break_torque);
    if (!broken) continue;
    events_.rows.push_back({PLUMB_EVENT_JOINT_BROKEN, 0, desc.body_a, desc.body_b, at->handle});
    remove_joint(*at);
  }
}

}  // namespace plumb::bullet
