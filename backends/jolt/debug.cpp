// What Jolt lets be seen: the bounds and islands of bodies, the axes of manifolds. Its trees and candidate pairs stay
// within.
#include <algorithm>

#include "contacts/saved_contacts.hpp"
#include "world.hpp"

namespace plumb::jolt {

PlumbResult World::candidate_pairs(std::span<const PlumbDebugPair>&) {
  throw Error(PLUMB_E_UNSUPPORTED, "Jolt does not tell candidate pairs, only those that touch");
}

PlumbResult World::tree_boxes(std::span<const PlumbDebugBox>& boxes) {
  constexpr std::int32_t of_no_tree = -1;
  lent_.boxes.clear();
  for (const auto& body : bodies_) {
    if (!body || body->shape == nullptr) continue;
    const JPH::AABox& bounds = body->jolt->GetWorldSpaceBounds();
    lent_.boxes.push_back({to_plumb(bounds.mMin), to_plumb(bounds.mMax), body->handle, of_no_tree, 0});
  }
  boxes = lent_.boxes;
  return PLUMB_OK;
}

/// Jolt numbers the islands of each step anew; who sleeps is in none.
PlumbResult World::body_states(std::span<const PlumbDebugBody>& bodies) {
  lent_.bodies.clear();
  for (const auto& body : bodies_) {
    if (!body) continue;
    const bool in_island = body->jolt->IsDynamic() && body->jolt->IsActive();
    const JPH::uint32 island =
        in_island ? body->jolt->GetMotionProperties()->GetIslandIndexInternal() : JPH::Body::cInactiveIndex;
    lent_.bodies.push_back({body->handle, island == JPH::Body::cInactiveIndex ? -1 : static_cast<std::int32_t>(island),
                            body->asleep() ? 1u : 0u});
  }
  bodies = lent_.bodies;
  return PLUMB_OK;
}

/// Of the contacts that Jolt keeps, where the bodies are now.
PlumbResult World::separating_axes(std::span<const PlumbDebugAxis>& axes) {
  if (!kReadsSavedContacts)
    throw Error(PLUMB_E_UNSUPPORTED, "the adapter knows how Jolt 5.5.1 keeps its contacts alone");
  lent_.axes.clear();
  for (const SavedManifold& manifold : saved_contacts(system_)) {
    const auto& first = bodies_[manifold.parts.GetBody1ID().GetIndex()];
    const auto& second = bodies_[manifold.parts.GetBody2ID().GetIndex()];
    if (!first || !second || manifold.count == 0) continue;  // one of them is gone since
    const Body &a = *first, &b = *second;
    if (a.is_sensor() || b.is_sensor()) continue;
    const JPH::RMat44 at_a = a.jolt->GetCenterOfMassTransform(), at_b = b.jolt->GetCenterOfMassTransform();
    const PlumbVec3 axis = to_plumb(b.jolt->GetRotation() * JPH::Vec3(manifold.normal));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < manifold.count; ++i)
      least = std::min(least, backend::dot(axis, backend::sub(to_plumb(at_b * JPH::Vec3(manifold.points[i].in_b)),
                                                              to_plumb(at_a * JPH::Vec3(manifold.points[i].in_a)))));
    lent_.axes.push_back({a.handle, b.handle, axis, least});
  }
  axes = lent_.axes;
  return PLUMB_OK;
}

}  // namespace plumb::jolt
