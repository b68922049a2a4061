// Bodies, joints and shapes of a world that become others while they live. A body is made anew under its number, with
// the constraints that hold it.
#include "plumb/backend/modify.hpp"

#include "make_body.hpp"
#include "materials.hpp"
#include "world.hpp"

namespace plumb::jolt {
namespace {

/// What the change leaves as it is, and what it says.
PlumbBodyDesc changed(const PlumbBodyDesc& before, const PlumbBodyChange& change) {
  const PlumbBodyDesc with = backend::described(change);
  PlumbBodyDesc desc = before;
  desc.motion = with.motion;
  desc.flags = with.flags;
  desc.locks = with.locks;
  desc.shape = with.shape;
  desc.mass = with.mass;
  desc.centre_of_mass = with.centre_of_mass;
  desc.inertia = with.inertia;
  desc.inertia_orientation = with.inertia_orientation;
  return desc;
}

/// As the body moves now, and goes on with another centre of mass.
void put_velocity(const Body& at, PlumbBodyDesc& desc) {
  desc.linear_velocity = desc.angular_velocity = {0, 0, 0};
  if (desc.motion != PLUMB_DYNAMIC || at.is(PLUMB_STATIC)) return;
  const PlumbVec3 before = to_plumb(at.jolt->GetShape()->GetCenterOfMass());
  const PlumbVec3 shift = backend::rotate(desc.pose.orientation, backend::sub(desc.centre_of_mass, before));
  desc.angular_velocity = to_plumb(at.jolt->GetAngularVelocity());
  desc.linear_velocity =
      backend::velocity_of_moved_centre(to_plumb(at.jolt->GetLinearVelocity()), desc.angular_velocity, shift);
}

}  // namespace

PlumbResult World::modify_bodies(std::span<const PlumbBodyChange> changes) {
  std::vector<std::pair<PlumbBodyDesc, JPH::BodyCreationSettings>> made;
  for (const PlumbBodyChange& change : changes) {
    const Body& at = body(change.body);
    PlumbBodyDesc desc = changed(at.desc, change);
    desc.pose = at.pose();
    put_velocity(at, desc);
    const Shape* with = desc.shape == 0 ? nullptr : &shape(desc.shape);
    made.emplace_back(desc, body_settings(desc, with, settings_, needs(PLUMB_NEED_GYROSCOPIC)));
  }
  const backend::ChangedBodies bodies(changes);
  std::vector<Joint*> held;
  for (const auto& joint : joints_)
    if (joint && bodies.joined_by(joint->desc)) held.push_back(joint.get());
  for (const Joint* joint : held) take_constraints(*joint);
  for (std::size_t i = 0; i < changes.size(); ++i) remake_body(body(changes[i].body), made[i].first, made[i].second);
  for (Joint* joint : held) {
    joint->main = joint->helper = nullptr;
    make_constraints(*joint, ends_of(joint->desc));
    give_constraints(*joint);
  }
  return PLUMB_OK;
}

void World::remake_body(Body& at, const PlumbBodyDesc& desc, JPH::BodyCreationSettings& made) {
  const bool pushed = at.jolt->IsDynamic() && desc.motion == PLUMB_DYNAMIC;
  const JPH::Vec3 force = pushed ? at.jolt->GetAccumulatedForce() : JPH::Vec3::sZero(),
                  torque = pushed ? at.jolt->GetAccumulatedTorque() : JPH::Vec3::sZero();
  const JPH::BodyID id = at.id();
  made.mUserData = at.jolt->GetUserData();
  made.mCollisionGroup = at.jolt->GetCollisionGroup();
  made.mPosition = at.jolt->GetPosition();
  made.mRotation = at.jolt->GetRotation();
  touch_anew(at);
  std::erase(kinematic_, &at);
  interface().RemoveBody(id);
  interface().DestroyBody(id);
  at.desc = desc;
  at.shape = desc.shape == 0 ? nullptr : &shape(desc.shape);
  at.moving = Body::Moving::as_told;
  at.jolt = interface().CreateBodyWithID(id, made);
  if (at.jolt == nullptr) throw Error(PLUMB_E_WORLD_LOST, "Jolt could not make a body that it had made before");
  set_inertia(*at.jolt, desc);
  if (at.shape != nullptr && at.shape->has_materials()) ask_for_materials(system_);
  if (at.is(PLUMB_KINEMATIC)) kinematic_.push_back(&at);
  interface().AddBody(id, at.is(PLUMB_STATIC) ? JPH::EActivation::DontActivate : JPH::EActivation::Activate);
  touch_anew(at);
  if (!pushed || !at.jolt->IsDynamic()) return;
  at.jolt->AddForce(force);
  at.jolt->AddTorque(torque);
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
    make_constraints(*other, ends_of(other->desc));
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

PlumbResult World::modify_shapes(std::span<const PlumbShape> shapes, std::span<const PlumbShapeDesc> descs) {
  std::vector<std::unique_ptr<Shape>> made;
  for (const PlumbShapeDesc& desc : descs) made.push_back(make_shape(desc, {}, settings_.convex_radius));
  for (std::size_t i = 0; i < made.size(); ++i) {
    Shape& at = *shapes_[slot_of(shapes[i])];
    std::swap(at, *made[i]);
    if (at.has_materials()) ask_for_materials(system_);
    for (const auto& body : bodies_) {
      if (!body || body->shape != &at) continue;
      wake_where_other(*body, *made[i]);
      interface().SetShape(body->id(), at.jolt, false, JPH::EActivation::DontActivate);
      interface().InvalidateContactCache(body->id());
    }
  }
  return PLUMB_OK;
}

}  // namespace plumb::jolt
