// Bodies, joints and shapes of a world that become others while they live. An actor is made anew for its body, with the
// joints that hold it.
#include "plumb/backend/modify.hpp"

#include "world.hpp"

namespace plumb::px {
namespace {

/// What the change leaves as it is, and what it says.
PlumbBodyDesc changed(const PlumbBodyDesc& before, const PlumbBodyChange& change) {
  const PlumbBodyDesc with = backend::described(change);
  PlumbBodyDesc desc = before;
  desc.motion = with.motion;
  desc.flags = with.flags & ~std::uint32_t{PLUMB_BODY_ASLEEP};
  desc.locks = with.locks;
  desc.shape = with.shape;
  desc.mass = with.mass;
  desc.centre_of_mass = with.centre_of_mass;
  desc.inertia = with.inertia;
  desc.inertia_orientation = with.inertia_orientation;
  return desc;
}

Velocity velocity_of(const Body& body) {
  if (body.is(PLUMB_STATIC)) return {};
  if (body.is(PLUMB_KINEMATIC)) return {body.desc.linear_velocity, body.desc.angular_velocity};
  return {to_plumb(body.dynamic().getLinearVelocity()), to_plumb(body.dynamic().getAngularVelocity())};
}

/// As the body moves now, and goes on with another centre of mass.
void keep_moving(const Body& at, PlumbBodyDesc& desc) {
  const Velocity now = velocity_of(at);
  desc.linear_velocity = desc.angular_velocity = {};
  if (desc.motion != PLUMB_DYNAMIC) return;
  const PlumbVec3 before = at.is(PLUMB_DYNAMIC) ? at.desc.centre_of_mass : PlumbVec3{};
  const PlumbVec3 shift = backend::rotate(desc.pose.orientation, backend::sub(desc.centre_of_mass, before));
  desc.angular_velocity = now.angular;
  desc.linear_velocity = backend::velocity_of_moved_centre(now.linear, now.angular, shift);
}

}  // namespace

PlumbResult World::modify_bodies(std::span<const PlumbBodyChange> changes) {
  std::vector<std::unique_ptr<Body>> made;
  try {
    for (const PlumbBodyChange& change : changes) {
      const Body& at = body(change.body);
      auto other = std::make_unique<Body>();
      other->handle = at.handle;
      other->desc = changed(at.desc, change);
      other->desc.pose = at.pose();
      keep_moving(at, other->desc);
      other->shape = other->desc.shape == 0 ? nullptr : &shape(other->desc.shape);
      check_body(other->desc);
      make_actor(*other, common_);
      made.push_back(std::move(other));
    }
  } catch (...) {
    for (const auto& other : made) release_actor(*other);
    throw;
  }
  const backend::ChangedBodies bodies(changes);
  std::vector<Joint*> held;
  for (const auto& joint : joints_)
    if (joint && bodies.joined_by(joint->desc)) held.push_back(joint.get());
  for (Joint* joint : held) drop_native(*joint);
  listener_.forget_all();
  for (auto& other : made) {
    std::unique_ptr<Body>& place = bodies_[slot_of(other->handle)];
    const bool was_asleep = place->was_asleep;
    wake_around(*place);
    remove_body(*place);
    place = std::move(other);
    add_body(*place);
    place->was_asleep = was_asleep && place->is(PLUMB_DYNAMIC);
    wake_around(*place);
  }
  for (Joint* joint : held) {
    make_native(*joint, ends_of(joint->desc));
    wake_joint(*joint);
  }
  return PLUMB_OK;
}

PlumbResult World::modify_joints(std::span<const PlumbJointChange> changes) {
  std::vector<std::unique_ptr<Joint>> made;
  for (const PlumbJointChange& change : changes) {
    const Joint& at = joint(change.joint);
    auto other = std::make_unique<Joint>();
    other->handle = at.handle;
    other->desc = at.desc;
    backend::apply(change, other->desc);
    other->enabled = (change.what & PLUMB_MODIFY_ENABLED) != 0 ? change.enabled != 0 : at.enabled;
    check_joint(other->desc);
    make_native(*other, ends_of(other->desc));
    made.push_back(std::move(other));
  }
  for (auto& other : made) {
    std::unique_ptr<Joint>& place = joints_[slot_of(other->handle)];
    remove_joint(*place);
    place = std::move(other);
    add_joint(*place);
  }
  return PLUMB_OK;
}

/// Bodies get the new geometry under their actors.
PlumbResult World::modify_shapes(std::span<const PlumbShape> shapes, std::span<const PlumbShapeDesc> descs) {
  std::vector<std::unique_ptr<Shape>> made;
  for (const PlumbShapeDesc& desc : descs) made.push_back(make_shape(desc, {}));
  for (std::size_t i = 0; i < made.size(); ++i) {
    const std::unique_ptr<Shape>& at = shapes_[slot_of(shapes[i])];
    at->swap(*made[i]);
    for (const auto& body : bodies_) {
      if (!body || body->shape != at.get()) continue;
      wake_around(*body);
      attach_anew(*body, common_);
      wake_around(*body);
    }
  }
  return PLUMB_OK;
}

}  // namespace plumb::px
