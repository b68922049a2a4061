// Shapes and bodies of a world: made and taken away, and which pairs of bodies are kept apart.
#include "world.hpp"

namespace plumb::dart6 {

PlumbResult World::create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) {
  std::vector<std::unique_ptr<Shape>> made;
  for (const PlumbShapeDesc& desc : descs) {
    std::vector<const Shape*> children;
    for (std::uint32_t k = 0; desc.type == PLUMB_COMPOUND && k < desc.child_count; ++k)
      children.push_back(&shape(desc.children[k].shape));
    made.push_back(make_shape(desc, std::move(children)));
  }
  for (std::size_t i = 0; i < made.size(); ++i) put_in(shapes_, ids[i], std::move(made[i]));
  return PLUMB_OK;
}

PlumbResult World::destroy_shapes(std::span<const PlumbShape> ids) {
  for (const PlumbShape id : ids) shapes_[slot_of(id)].reset();
  return PLUMB_OK;
}

PlumbResult World::create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) {
  for (std::size_t i = 0; i < descs.size(); ++i) {
    auto body = std::make_unique<Body>();
    body->handle = ids[i];
    body->desc = descs[i];
    body->shape = descs[i].shape == 0 ? nullptr : &shape(descs[i].shape);
    body->pose = {descs[i].pose.position, normalized(descs[i].pose.orientation)};
    if (descs[i].motion != PLUMB_STATIC) {
      body->velocity = descs[i].linear_velocity;
      body->spin = descs[i].angular_velocity;
    }
    put_in(bodies_, ids[i], std::move(body));
  }
  make_stale();
  return PLUMB_OK;
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  make_stale();
  touches_.forget(ids, pending_events_);
  for (const PlumbBody id : ids) bodies_[slot_of(id)].reset();
  meeting_.impulses.clear();
  meeting_.rows.clear();
  return PLUMB_OK;
}

PlumbResult World::set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) {
  for (const PlumbBodyPair& pair : pairs) {
    const std::pair slots(slot_of(pair.body_a), slot_of(pair.body_b));
    if (touch) {
      excepted_.erase(slots);
    } else {
      excepted_.insert(slots);
    }
  }
  return PLUMB_OK;
}

}  // namespace plumb::dart6
