// What PhysX lets be seen: the bounds of bodies, the axes of contacts. Its trees, candidate pairs and islands stay
// within.
#include <algorithm>

#include "world.hpp"

namespace plumb::px {

PlumbResult World::candidate_pairs(std::span<const PlumbDebugPair>&) {
  throw Error(PLUMB_E_UNSUPPORTED, "PhysX does not tell candidate pairs, only those that touch");
}

PlumbResult World::tree_boxes(std::span<const PlumbDebugBox>& boxes) {
  constexpr std::int32_t of_no_tree = -1;
  lent_.boxes.clear();
  for (const auto& body : bodies_) {
    if (!body || body->shape == nullptr) continue;
    const PxBounds3 bounds = body->actor->getWorldBounds(1);
    lent_.boxes.push_back({to_plumb(bounds.minimum), to_plumb(bounds.maximum), body->handle, of_no_tree, 0});
  }
  boxes = lent_.boxes;
  return PLUMB_OK;
}

/// Of the last step's contacts, one for each pair of bodies and normal: where they are deepest.
PlumbResult World::separating_axes(std::span<const PlumbDebugAxis>& axes) {
  if (!needs(PLUMB_NEED_CONTACTS | PLUMB_NEED_EVENTS))
    throw Error(PLUMB_E_UNSUPPORTED, "PhysX tells contacts where the world needs PLUMB_NEED_CONTACTS");
  lent_.axes.clear();
  for (const PlumbContact& contact : contacts()) {
    const auto same = [&](const PlumbDebugAxis& axis) {
      return axis.body_a == contact.body_a && axis.body_b == contact.body_b &&
             backend::dot(axis.axis, contact.normal) > 1 - 1e-6;
    };
    const bool known = !lent_.axes.empty() && same(lent_.axes.back());
    if (known)
      lent_.axes.back().separation = std::min(lent_.axes.back().separation, -contact.depth);
    else
      lent_.axes.push_back({contact.body_a, contact.body_b, contact.normal, -contact.depth});
  }
  axes = lent_.axes;
  return PLUMB_OK;
}

}  // namespace plumb::px
