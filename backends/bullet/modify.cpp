// Bodies, joints and shapes of a world that become others while they live.
#include "plumb/backend/modify.hpp"
#include "plumb/assert.hpp"

#include <utility>

#include "moving_mesh.hpp"
#include "world.hpp"

namespace plumb::bullet {

PlumbResult World::modify_bodies(std::span<const PlumbBodyChange> changes) {
  std::vector<MadeOf> made;
  for (const PlumbBodyChange& change : changes) made.push_back(made_of(backend::described(change)));
  if (needs(PLUMB_NEED_CONTACTS)) (void)contacts();  // while those of the last step are there
  for (std::size_t i = 0; i < changes.size(); ++i) remake_body(changes[i], std::move(made[i]));
  remake_joints_of(changes);
  return PLUMB_OK;
}

void World::remake_body(const PlumbBodyChange& change, MadeOf made) {
  Body& at = body(change.body);
  const btTransform pose = at.frame_pose();
  const btVector3 shift = pose.getBasis() * (made.body_to_mass.getOrigin() - at.body_to_mass.getOrigin());
  const btVector3 spin = at.getAngularVelocity(), velocity = at.getLinearVelocity() + spin.cross(shift);
  const btVector3 force = at.getTotalForce(), torque = at.getTotalTorque();
  const bool pushed = at.is(PLUMB_DYNAMIC) && change.motion == PLUMB_DYNAMIC, was_asleep = at.was_asleep;

  wake_neighbours(at);
  take_from_bullet(at);
  at.motion = change.motion;
  at.flags = change.flags;
  at.locks = change.locks;
  at.coasting.on = at.has_target = false;
  btRigidBody::btRigidBodyConstructionInfo info = construction(made, pose);
  info.m_friction = at.getFriction();
  info.m_restitution = at.getRestitution();
  info.m_rollingFriction = at.getRollingFriction();
  info.m_spinningFriction = at.getSpinningFriction();
  at.remake(info);
  at.take(std::move(made));
  add_to_bullet(at);
  if (change.motion == PLUMB_DYNAMIC) {
    at.setLinearVelocity(velocity * at.getLinearFactor());
    at.setAngularVelocity(spin * at.getAngularFactor());
    at.was_asleep = was_asleep;
  }
  if (!pushed) return;
  at.applyCentralForce(force);
  at.applyTorque(torque);
}

/// Their constraints hold frames on the old centres of mass, and may have come to join what nothing moves.
void World::remake_joints_of(std::span<const PlumbBodyChange> changes) {
  const backend::ChangedBodies changed(changes);
  for (const auto& at : joints_) {
    if (!at || !changed.joined_by(at->desc)) continue;
    auto fresh = make_joint(at->desc, at->handle);
    fresh->enabled = at->enabled;
    replace_joint(std::move(fresh));
  }
}

PlumbResult World::modify_joints(std::span<const PlumbJointChange> changes) {
  std::vector<std::unique_ptr<Joint>> made;
  for (const PlumbJointChange& change : changes) {
    const Joint& at = joint(change.joint);
    PlumbJointDesc desc = at.desc;
    backend::apply(change, desc);
    made.push_back(make_joint(desc, change.joint));
    made.back()->enabled = (change.what & PLUMB_MODIFY_ENABLED) != 0 ? change.enabled != 0 : at.enabled;
  }
  for (auto& joint : made) replace_joint(std::move(joint));
  return PLUMB_OK;
}

void World::replace_joint(std::unique_ptr<Joint> joint) {
  std::unique_ptr<Joint>& place = joints_[slot_of(joint->handle)];
  PLUMB_ASSERT(place != nullptr && place->handle == joint->handle);
  take_from_bullet(*place);
  place = std::move(joint);
  add_to_bullet(*place);
}

PlumbResult World::modify_shapes(std::span<const PlumbShape> shapes, std::span<const PlumbShapeDesc> descs) {
  std::vector<std::shared_ptr<const Shape>> made;
  for (const PlumbShapeDesc& desc : descs) made.push_back(make_shape(desc, {}, settings_.shape_options()));
  if (needs(PLUMB_NEED_CONTACTS)) (void)contacts();  // while those of the last step are there
  for (std::size_t i = 0; i < made.size(); ++i) {
    const std::shared_ptr<const Shape> before = std::exchange(shapes_[slot_of(shapes[i])], made[i]);
    for (const auto& body : bodies_)
      if (body && body->shape == before) reshape(*body, made[i]);
  }
  return PLUMB_OK;
}

/// Gives a body the other shape in the place of the one that it has; its mass stays where it is.
void World::reshape(Body& at, const std::shared_ptr<const Shape>& other) {
  wake_neighbours(at);
  take_from_bullet(at);
  at.shape = other;
  if (at.is(PLUMB_DYNAMIC) && other->type == PLUMB_TRIANGLE_MESH)
    at.own_shape = make_moving_mesh(*other, at.mass_to_body);
  else if (at.offset_frame)
    at.own_shape = make_offset_shape(*other, at.mass_to_body);
  at.setCollisionShape(at.own_shape ? at.own_shape.get() : other->bullet.get());
  add_to_bullet(at);
  wake(at);
}

}  // namespace plumb::bullet
