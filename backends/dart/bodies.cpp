// Shapes and bodies of a world: made and taken away, and which pairs of bodies are kept apart.
#include <sstream>

#include "world.hpp"

namespace plumb::dart6 {
namespace {

/// DART multiplies and divides by them, and checks by assertions, which end the process.
void require_weight(const PlumbBodyDesc& desc) {
  if (desc.motion != PLUMB_DYNAMIC) return;
  const PlumbVec3 &i = desc.inertia, &c = desc.centre_of_mass;
  const auto require = [](const char* what, double value, double least, double most) {
    if (value >= least && value <= most) return;
    std::ostringstream text;
    text << "a body's " << what << " is " << value << ", and DART's are from " << least << " to " << most
         << "; scale the world's units of length or mass";
    throw Error(PLUMB_E_UNSUPPORTED, text.str());
  };
  constexpr double least = 1e-50, most = 1e50;
  require("mass", desc.mass, least, most);
  require("centre of mass", length(c), 0, 1e8);
  if ((desc.flags & PLUMB_BODY_NO_ROTATION) != 0) return;
  const PlumbQuat& q = desc.inertia_orientation;
  require("orientation of inertia, its length squared", q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 0.5, 2);
  for (const double moment : {i.x, i.y, i.z}) require("moment of inertia", moment, least, most);
}

}  // namespace

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
  for (const PlumbBodyDesc& desc : descs) require_weight(desc);
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
