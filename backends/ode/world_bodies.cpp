// Bodies of a world: made, listed, taken apart.
#include <algorithm>

#include "plumb/backend/modify.hpp"
#include "slots.hpp"
#include "world.hpp"

namespace plumb::ode {
namespace {

/// Geoms that never move are not asked about each other.
constexpr unsigned long still_bit = 1, moving_bit = 2;

}  // namespace

PlumbResult World::create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) {
  return inside_ode([&] {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      put(bodies_, ids[i], make_body(descs[i], ids[i]));
      enlist(body(ids[i]));
    }
    return PLUMB_OK;
  });
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  return inside_ode([&] {
    for (const PlumbBody id : ids) {
      std::erase(order_, &body(id));
      strike_off(body(id));
      dismantle(body(id));
      bodies_[slot_of(id)].reset();
    }
    return PLUMB_OK;
  });
}

PlumbResult World::set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) {
  for (const PlumbBodyPair& pair : pairs) (touch ? let_touch : keep_apart)(body(pair.body_a), body(pair.body_b));
  return PLUMB_OK;
}

std::unique_ptr<Body> World::make_body(const PlumbBodyDesc& desc, PlumbBody handle) {
  auto body = body_stock_.take();
  body->handle = handle;
  body->material = desc.material;
  body->filter = desc.filter;
  body->gravity_scale = desc.gravity_scale;
  body->linear_damping = desc.linear_damping;
  body->angular_damping = desc.angular_damping;
  embody(*body, desc);
  if ((desc.flags & PLUMB_BODY_ASLEEP) != 0 && body->dynamic()) dBodyDisable(body->body);
  body->was_awake = !body->asleep();
  return body;
}

/// What ODE has of a body, of the motion, shape, mass, flags, locks, pose and velocities of a descriptor.
void World::embody(Body& body, const PlumbBodyDesc& desc) {
  body.motion = desc.motion;
  body.sensor = (desc.flags & PLUMB_BODY_SENSOR) != 0;
  body.shows_contacts = (desc.flags & PLUMB_BODY_MODIFY_CONTACTS) != 0;
  body.shape = desc.shape == 0 ? nullptr : shapes_[slot_of(desc.shape)].get();
  if (desc.motion != PLUMB_STATIC) body.body = dBodyCreate(world_);
  if (desc.motion == PLUMB_KINEMATIC) {
    dBodySetKinematic(body.body);
    dBodySetGravityMode(body.body, 0);
    dBodySetFiniteRotationMode(body.body, 1);
  }
  if (desc.motion == PLUMB_DYNAMIC) {
    set_mass(body, desc);
    body.locks = desc.locks;
  }
  make_body_geoms(body);
  body.set_frame(desc.pose);
  body.set_velocity(desc.linear_velocity, desc.angular_velocity);
  if (desc.motion != PLUMB_DYNAMIC) return;
  apply_body_settings(body);
  body.wake();
  if (substep_ != 0 && (body.linear_damping != 0 || body.angular_damping != 0)) set_damping(body, substep_);
  if (body.locks != 0) make_locks(body, world_);
  const bool sleeps = init_.needs(PLUMB_NEED_SLEEPING) && (desc.flags & PLUMB_BODY_NEVER_SLEEPS) == 0;
  dBodySetAutoDisableFlag(body.body, sleeps ? 1 : 0);
}

/// Another body of ODE's in the place of the one there is, moving as that did.
void World::remake(Body& at, const PlumbBodyChange& change) {
  PlumbBodyDesc desc = backend::described(change);
  desc.pose = at.frame();
  if (change.motion == PLUMB_DYNAMIC) {
    const PlumbVec3 shift = rotate(desc.pose.orientation, sub(desc.centre_of_mass, at.centre_of_mass));
    desc.angular_velocity = at.angular_velocity();
    desc.linear_velocity = backend::velocity_of_moved_centre(at.linear_velocity(), desc.angular_velocity, shift);
    if ((change.flags & PLUMB_BODY_NO_ROTATION) != 0) desc.angular_velocity = {};
  }
  const bool pushed = at.pushed && at.dynamic() && change.motion == PLUMB_DYNAMIC;
  const PlumbVec3 force = at.force, torque = at.torque;
  strike_off(at);
  dismantle(at);
  at.geoms.clear();
  at.body = nullptr;
  at.linear_lock = at.angular_lock = nullptr;
  at.centre_of_mass = at.idle_spin = at.force = at.torque = {};
  at.inverse_mass = 0;
  at.inverse_inertia = {};
  at.turns = at.pushed = false;
  at.locks = 0;
  at.moving = Body::Moving::as_told;
  embody(at, desc);
  list(at);
  if (change.motion != PLUMB_DYNAMIC) at.was_awake = true;
  if (!pushed) return;
  at.force = force;
  at.torque = torque;
  at.pushed = true;
  pushed_.push_back(&at);
}

PlumbResult World::modify_bodies(std::span<const PlumbBodyChange> changes) {
  return inside_ode([&] {
    const backend::ChangedBodies changed(changes);
    std::vector<Joint*> joints;
    for (Joint* joint : joint_order_)
      if (changed.joined_by(joint->desc)) joints.push_back(joint);
    for (Joint* joint : joints) unbind(*joint);
    for (const PlumbBodyChange& change : changes) remake(body(change.body), change);
    for (Joint* joint : joints) bind(*joint);
    return PLUMB_OK;
  });
}

void World::make_body_geoms(Body& body) {
  if (space_ == nullptr || body.shape == nullptr) return;
  std::vector<PlacedGeom> placed;
  make_geoms(*body.shape, space_, placed);
  for (const PlacedGeom& geom : placed) {
    body.geoms.push_back(tag_stock_.take());
    GeomTag& tag = *body.geoms.back();
    tag.placed = geom;
    if (geom.material != nullptr) tag.own_material = *geom.material;
    dGeomSetData(geom.geom, &tag);
    dGeomSetCategoryBits(geom.geom, body.body == nullptr ? still_bit : moving_bit);
    dGeomSetCollideBits(geom.geom, body.body == nullptr ? moving_bit : still_bit | moving_bit);
    if (body.body == nullptr) continue;
    dGeomSetBody(geom.geom, body.body);
    offset_geom(geom, body.centre_of_mass);
  }
  refresh_tags(body);
}

void World::apply_body_settings(Body& body) {
  if (body.turns) {
    dBodySetGyroscopicMode(body.body, settings_.gyroscopic && init_.needs(PLUMB_NEED_GYROSCOPIC) ? 1 : 0);
    dBodySetFiniteRotationMode(body.body, settings_.finite_rotation ? 1 : 0);
  }
  dBodySetAutoDisableLinearThreshold(body.body, settings_.sleep_linear);
  dBodySetAutoDisableAngularThreshold(body.body, settings_.sleep_angular);
  dBodySetAutoDisableSteps(body.body, settings_.sleep_steps);
  dBodySetAutoDisableTime(body.body, settings_.sleep_time);
}

void World::enlist(Body& body) {
  order_.push_back(&body);
  plain_.resize(bodies_.size());
  list(body);
}

/// Into the lists of those that a step must look at.
void World::list(Body& body) {
  const bool plain = is_zero(body.centre_of_mass) && (body.turns || body.motion == PLUMB_KINEMATIC);
  plain_[slot_of(body.handle)] = plain ? body.body : nullptr;
  if (body.motion == PLUMB_KINEMATIC) kinematic_.push_back(&body);
  if (!body.dynamic()) return;
  dynamic_.push_back(&body);
  dynamic_ids_.push_back(body.body);
  if (body.locks != 0) locked_.push_back(&body);
  if (body.linear_damping != 0 || body.angular_damping != 0) damped_.push_back(&body);
  set_gravity_scale(body, body.gravity_scale);
}

void World::strike_off(const Body& body) {
  for (auto* list : {&dynamic_, &kinematic_, &damped_, &locked_, &weighed_, &pushed_}) std::erase(*list, &body);
  std::erase(dynamic_ids_, body.body);
}

void World::dismantle(Body& body) {
  wake_neighbours(body);
  for (const auto& geom : body.geoms) dGeomDestroy(geom->placed.geom);
  if (body.linear_lock != nullptr) dJointDestroy(body.linear_lock);
  if (body.angular_lock != nullptr) dJointDestroy(body.angular_lock);
  if (body.body != nullptr) dBodyDestroy(body.body);
}

void World::set_gravity_scale(Body& body, double scale) {
  body.gravity_scale = scale;
  std::erase(weighed_, &body);
  if (scale != 0 && scale != 1) weighed_.push_back(&body);
  dBodySetGravityMode(body.body, scale == 1 ? 1 : 0);
}

/// Whatever sleeps against a body must notice that it goes or comes.
void World::wake_neighbours(const Body& body) {
  if (space_ == nullptr || !init_.needs(PLUMB_NEED_SLEEPING)) return;
  const auto wake = [](void* self, dGeomID one, dGeomID two) {
    for (const dGeomID geom : {one, two}) {
      Body& met = *static_cast<const GeomTag*>(dGeomGetData(geom))->body;
      if (&met != self && met.asleep()) met.wake();
    }
  };
  for (const auto& geom : body.geoms)
    dSpaceCollide2(geom->placed.geom, reinterpret_cast<dGeomID>(space_), const_cast<Body*>(&body), wake);
}

}  // namespace plumb::ode
