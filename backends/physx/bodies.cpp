// Shapes and bodies of a world: made and taken away, and which pairs of bodies are kept apart.
#include "world.hpp"

namespace plumb::px {

PlumbResult World::create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) {
  std::vector<std::unique_ptr<Shape>> made;
  for (const PlumbShapeDesc& desc : descs) {
    std::vector<const Shape*> children;
    for (std::uint32_t i = 0; desc.type == PLUMB_COMPOUND && i < desc.child_count; ++i)
      children.push_back(&shape(desc.children[i].shape));
    made.push_back(make_shape(desc, children));
  }
  for (std::size_t i = 0; i < made.size(); ++i) put(shapes_, ids[i], std::move(made[i]));
  return PLUMB_OK;
}

PlumbResult World::destroy_shapes(std::span<const PlumbShape> ids) {
  for (const PlumbShape id : ids) shapes_[slot_of(id)].reset();
  return PLUMB_OK;
}

PlumbResult World::create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) {
  for (const PlumbBodyDesc& desc : descs) check_body(desc);
  std::vector<std::unique_ptr<Body>> made;
  try {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      auto body = std::make_unique<Body>();
      body->handle = ids[i];
      body->desc = descs[i];
      body->shape = descs[i].shape == 0 ? nullptr : &shape(descs[i].shape);
      make_actor(*body, common_);
      made.push_back(std::move(body));
    }
  } catch (...) {
    for (const auto& body : made) release_actor(*body);
    throw;
  }
  for (auto& body : made) {
    rules_.set_filter(slot_of(body->handle), body->desc.filter);
    add_body(*body);
    put(bodies_, body->handle, std::move(body));
  }
  return PLUMB_OK;
}

void World::add_body(Body& body) {
  scene_->addActor(*body.actor);
  if (body.is(PLUMB_KINEMATIC)) kinematic_.push_back(&body);
  sort_scaled(body);
  if (!body.is(PLUMB_DYNAMIC)) return;
  body.was_asleep = (body.desc.flags & PLUMB_BODY_ASLEEP) != 0;
  if (body.was_asleep)
    body.dynamic().putToSleep();
  else
    body.dynamic().wakeUp();
}

/// PhysX wakes whom it touched.
void World::remove_body(Body& body) {
  std::erase(kinematic_, &body);
  std::erase(scaled_, &body);
  scene_->removeActor(*body.actor);
  release_actor(body);
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  touches_.forget(ids, pending_events_);
  listener_.forget_all();
  for (const PlumbBody id : ids) {
    remove_body(body(id));
    bodies_[slot_of(id)].reset();
  }
  return PLUMB_OK;
}

PlumbResult World::set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) {
  for (const PlumbBodyPair& pair : pairs) keep_apart(body(pair.body_a), body(pair.body_b), touch ? -1 : 1);
  return PLUMB_OK;
}

void World::keep_apart(const Body& a, const Body& b, int reasons) {
  if (!rules_.keep_apart(slot_of(a.handle), slot_of(b.handle), reasons)) return;
  for (const Body* at : {&a, &b}) scene_->resetFiltering(*at->actor);
}

void World::wake_around(const Body& body) {
  if (!needs(PLUMB_NEED_SLEEPING) || body.shape == nullptr) return;
  PxBounds3 around = body.actor->getWorldBounds();
  around.fattenFast(static_cast<float>(2 * common_.settings.contacts.offset));
  for (const auto& at : bodies_)
    if (at && at->asleep() && at->shape != nullptr && at->actor->getWorldBounds().intersects(around))
      at->dynamic().wakeUp();
}

}  // namespace plumb::px
