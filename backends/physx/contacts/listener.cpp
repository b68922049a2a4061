#include "contacts/listener.hpp"

#include <algorithm>
#include <tuple>

namespace plumb::px {
namespace {

std::uint32_t child_of(const Part& part, PxU32 face) {
  const Shape& shape = *part.body->shape;
  return shape.type == PLUMB_TRIANGLE_MESH ? shape.triangle_of(face) : part.piece->child;
}

PlumbContact contact_of(const Part& a, const Part& b, const PxContactPairPoint& point) {
  PlumbContact contact{};
  contact.body_a = a.body->handle;
  contact.body_b = b.body->handle;
  contact.child_a = child_of(a, point.internalFaceIndex0);
  contact.child_b = child_of(b, point.internalFaceIndex1);
  contact.position = to_plumb(point.position);
  contact.normal = to_plumb(-point.normal);  // PhysX's is from b to a
  contact.depth = -static_cast<double>(point.separation);
  contact.normal_impulse = static_cast<double>(point.impulse.magnitude());
  return contact;
}

}  // namespace

void Listener::onContact(const PxContactPairHeader& header, const PxContactPair* pairs, PxU32 count) {
  if (header.flags & (PxContactPairHeaderFlag::eREMOVED_ACTOR_0 | PxContactPairHeaderFlag::eREMOVED_ACTOR_1)) return;
  for (const PxContactPair* pair = pairs; pair != pairs + count; ++pair)
    if (!(pair->flags & (PxContactPairFlag::eREMOVED_SHAPE_0 | PxContactPairFlag::eREMOVED_SHAPE_1))) add(*pair);
}

/// PhysX rubs at anchors of its own, each of which has the impulse that is told at the point next to it.
void Listener::add(const PxContactPair& pair) {
  points_.resize(pair.contactCount);
  points_.resize(pair.extractContacts(points_.data(), pair.contactCount));
  if (points_.empty()) return;
  const Part &a = part_of(*pair.shapes[0]), &b = part_of(*pair.shapes[1]);
  const auto first = static_cast<std::ptrdiff_t>(contacts_.size());
  for (const PxContactPairPoint& point : points_) contacts_.push_back(contact_of(a, b, point));
  anchors_.resize(kMostAnchors);
  anchors_.resize(pair.extractFrictionAnchors(anchors_.data(), kMostAnchors));
  for (const PxContactPairFrictionAnchor& anchor : anchors_) {
    const PlumbVec3 place = to_plumb(anchor.position);
    const auto distance = [&](const PlumbContact& contact) {
      return backend::length(backend::sub(contact.position, place));
    };
    auto& at = *std::min_element(contacts_.begin() + first, contacts_.end(),
                                 [&](const auto& one, const auto& other) { return distance(one) < distance(other); });
    at.tangent_impulse = backend::sub(at.tangent_impulse, to_plumb(anchor.impulse));
  }
}

void Listener::finish_step() {
  const auto place = [](const PlumbContact& contact) {
    return std::tuple(slot_of(contact.body_a), slot_of(contact.body_b), contact.child_a, contact.child_b);
  };
  std::stable_sort(contacts_.begin(), contacts_.end(),
                   [&](const PlumbContact& one, const PlumbContact& other) { return place(one) < place(other); });
}

}  // namespace plumb::px
