// Bodies of a world: made, listed, taken apart.
#include <algorithm>

#include "plumb/assert.hpp"
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
      put(slots_.bodies, ids[i], make_body(descs[i], ids[i]));
      enlist(body(ids[i]));
    }
    return PLUMB_OK;
  });
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  return inside_ode([&] {
    for (const PlumbBody id : ids) {
      std::erase(lists_.all, &body(id));
      strike_off(body(id));
      dismantle(body(id));
      slots_.bodies[slot_of(id)].reset();
    }
    return PLUMB_OK;
  });
}

PlumbResult World::set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) {
  for (const PlumbBodyPair& pair : pairs) (touch ? let_touch : keep_apart)(body(pair.body_a), body(pair.body_b));
  return PLUMB_OK;
}

std::unique_ptr<Body> World::make_body(const PlumbBodyDesc& desc, PlumbBody handle) {
  auto body = stocks_.bodies.take();
  body->handle = handle;
  body->surface.material = desc.material;
  body->surface.rolling_friction = desc.rolling_friction;
  body->surface.spinning_friction = desc.spinning_friction;
  body->filter = desc.filter;
  body->gravity_scale = desc.gravity_scale;
  body->damping.linear = desc.linear_damping;
  body->damping.angular = desc.angular_damping;
  embody(*body, desc);
  if ((desc.flags & PLUMB_BODY_ASLEEP) != 0 && body->dynamic()) dBodyDisable(body->body);
  body->sleep.was_awake = !body->asleep();
  return body;
}

/// What ODE has of a body, of the motion, shape, mass, flags, locks, pose and velocities of a descriptor.
void World::embody(Body& body, const PlumbBodyDesc& desc) {
  PLUMB_ASSERT(body.body == nullptr && body.geoms.empty());
  body.motion = desc.motion;
  body.sensor = (desc.flags & PLUMB_BODY_SENSOR) != 0;
  body.shows_contacts = (desc.flags & PLUMB_BODY_MODIFY_CONTACTS) != 0;
  body.shape = desc.shape == 0 ? nullptr : slots_.shapes[slot_of(desc.shape)].get();
  if (desc.motion != PLUMB_STATIC) body.body = dBodyCreate(world_);
  if (desc.motion == PLUMB_KINEMATIC) {
    dBodySetKinematic(body.body);
    dBodySetGravityMode(body.body, 0);
    dBodySetFiniteRotationMode(body.body, 1);
  }
  if (desc.motion == PLUMB_DYNAMIC) {
    set_mass(body, desc);
    body.locks.axes = desc.locks;
  }
  make_body_geoms(body);
  body.set_frame(desc.pose);
  body.set_velocity(desc.linear_velocity, desc.angular_velocity);
  if (desc.motion != PLUMB_DYNAMIC) return;
  apply_body_settings(body);
  body.wake();
  if (substep_.h != 0 && !body.damping.none()) set_damping(body, substep_.h);
  if (body.locks.axes != 0) make_locks(body, world_);
  const bool sleeps = init_.needs(PLUMB_NEED_SLEEPING) && (desc.flags & PLUMB_BODY_NEVER_SLEEPS) == 0;
  dBodySetAutoDisableFlag(body.body, sleeps ? 1 : 0);
}

/// Another body of ODE's in the place of the one there is, moving as that did.
void World::remake(Body& at, const PlumbBodyChange& change) {
  PlumbBodyDesc desc = backend::described(change);
  desc.pose = at.frame();
  if (change.motion == PLUMB_DYNAMIC) {
    const PlumbVec3 shift = rotate(desc.pose.orientation, sub(desc.centre_of_mass, at.mass.centre));
    desc.angular_velocity = at.angular_velocity();
    desc.linear_velocity = backend::velocity_of_moved_centre(at.linear_velocity(), desc.angular_velocity, shift);
    if ((change.flags & PLUMB_BODY_NO_ROTATION) != 0) desc.angular_velocity = {};
  }
  const bool pushed = at.push.any && at.dynamic() && change.motion == PLUMB_DYNAMIC;
  const Body::Push push = at.push;
  strike_off(at);
  dismantle(at);
  at.geoms.clear();
  at.body = nullptr;
  at.locks.linear = at.locks.angular = nullptr;
  at.mass = {};
  at.push = {};
  at.idle_spin = {};
  at.turns = false;
  at.locks.axes = 0;
  at.target.moving = Body::Moving::as_told;
  embody(at, desc);
  list(at);
  if (change.motion != PLUMB_DYNAMIC) at.sleep.was_awake = true;
  if (!pushed) return;
  at.push = push;
  lists_.pushed.push_back(&at);
}

PlumbResult World::modify_bodies(std::span<const PlumbBodyChange> changes) {
  return inside_ode([&] {
    const backend::ChangedBodies changed(changes);
    std::vector<Joint*> joints;
    for (Joint* joint : joint_lists_.all)
      if (changed.joined_by(joint->desc)) joints.push_back(joint);
    for (Joint* joint : joints) unbind(*joint);
    for (const PlumbBodyChange& change : changes) remake(body(change.body), change);
    for (Joint* joint : joints) bind(*joint);
    return PLUMB_OK;
  });
}

PlumbResult World::modify_shapes(std::span<const PlumbShape> shapes, std::span<const PlumbShapeDesc> descs) {
  return inside_ode([&] {
    std::vector<std::unique_ptr<Shape>> made;
    for (const PlumbShapeDesc& desc : descs) fill_shape(*made.emplace_back(std::make_unique<Shape>()), desc, {});
    for (std::size_t i = 0; i < made.size(); ++i) {
      std::unique_ptr<Shape>& place = slots_.shapes[slot_of(shapes[i])];
      for (Body* const body : lists_.all)
        if (body->shape == place.get()) reshape(*body, *made[i]);
      place = std::move(made[i]);
    }
    return PLUMB_OK;
  });
}

/// Gives a body the geoms of another shape in the place of those that it has.
void World::reshape(Body& at, const Shape& other) {
  wake_neighbours(at);
  for (const auto& geom : at.geoms) dGeomDestroy(geom->placed.geom);
  at.geoms.clear();
  at.shape = &other;
  make_body_geoms(at);
  if (at.body == nullptr) at.set_frame(at.frame());
  if (at.dynamic()) at.wake();
}

void World::make_body_geoms(Body& body) {
  if (space_ == nullptr || body.shape == nullptr) return;
  std::vector<PlacedGeom> placed;
  make_geoms(*body.shape, space_, placed);
  for (const PlacedGeom& geom : placed) {
    body.geoms.push_back(stocks_.tags.take());
    GeomTag& tag = *body.geoms.back();
    tag.placed = geom;
    if (geom.material != nullptr) tag.own_material = *geom.material;
    dGeomSetData(geom.geom, &tag);
    dGeomSetCategoryBits(geom.geom, body.body == nullptr ? still_bit : moving_bit);
    dGeomSetCollideBits(geom.geom, body.body == nullptr ? moving_bit : still_bit | moving_bit);
    if (body.body == nullptr) continue;
    dGeomSetBody(geom.geom, body.body);
    offset_geom(geom, body.mass.centre);
  }
  refresh_tags(body);
}

void World::apply_body_settings(Body& body) {
  if (body.turns) {
    dBodySetGyroscopicMode(body.body, settings_.gyroscopic && init_.needs(PLUMB_NEED_GYROSCOPIC) ? 1 : 0);
    dBodySetFiniteRotationMode(body.body, settings_.finite_rotation ? 1 : 0);
  }
  dBodySetAutoDisableLinearThreshold(body.body, settings_.sleep.linear);
  dBodySetAutoDisableAngularThreshold(body.body, settings_.sleep.angular);
  dBodySetAutoDisableSteps(body.body, settings_.sleep.steps);
  dBodySetAutoDisableTime(body.body, settings_.sleep.time);
}

void World::enlist(Body& body) {
  lists_.all.push_back(&body);
  slots_.plain.resize(slots_.bodies.size());
  list(body);
}

/// Into the lists of those that a step must look at.
void World::list(Body& body) {
  PLUMB_ASSERT(&this->body(body.handle) == &body && slots_.plain.size() == slots_.bodies.size());
  const bool plain = is_zero(body.mass.centre) && (body.turns || body.motion == PLUMB_KINEMATIC);
  slots_.plain[slot_of(body.handle)] = plain ? body.body : nullptr;
  if (body.motion == PLUMB_KINEMATIC) lists_.kinematic.push_back(&body);
  if (!body.dynamic()) return;
  PLUMB_ASSERT(std::find(lists_.dynamic.begin(), lists_.dynamic.end(), &body) == lists_.dynamic.end());
  lists_.dynamic.push_back(&body);
  lists_.dynamic_ids.push_back(body.body);
  if (body.locks.axes != 0) lists_.locked.push_back(&body);
  if (!body.damping.none()) lists_.damped.push_back(&body);
  set_gravity_scale(body, body.gravity_scale);
}

void World::strike_off(const Body& body) {
  for (auto* list :
       {&lists_.dynamic, &lists_.kinematic, &lists_.damped, &lists_.locked, &lists_.weighed, &lists_.pushed})
    std::erase(*list, &body);
  std::erase(lists_.dynamic_ids, body.body);
  PLUMB_ASSERT(lists_.dynamic_ids.size() == lists_.dynamic.size());
}

void World::dismantle(Body& body) {
  wake_neighbours(body);
  for (const auto& geom : body.geoms) dGeomDestroy(geom->placed.geom);
  if (body.locks.linear != nullptr) dJointDestroy(body.locks.linear);
  if (body.locks.angular != nullptr) dJointDestroy(body.locks.angular);
  if (body.body != nullptr) dBodyDestroy(body.body);
}

void World::set_gravity_scale(Body& body, double scale) {
  body.gravity_scale = scale;
  std::erase(lists_.weighed, &body);
  if (scale != 0 && scale != 1) lists_.weighed.push_back(&body);
  dBodySetGravityMode(body.body, scale == 1 ? 1 : 0);
}

/// Whatever sleeps against a body must notice that it goes or comes.
void World::wake_neighbours(const Body& body) {
  if (space_ == nullptr || !init_.needs(PLUMB_NEED_SLEEPING)) return;
  const auto wake = [](void* self, dGeomID one, dGeomID two) {
    for (const dGeomID geom : {one, two}) {
      Body& met = *tag_of(geom).body;
      if (&met != self && met.asleep()) met.wake();
    }
  };
  for (const auto& geom : body.geoms)
    dSpaceCollide2(geom->placed.geom, reinterpret_cast<dGeomID>(space_), const_cast<Body*>(&body), wake);
}

}  // namespace plumb::ode
