// Contact points of the last step, with their impulses.
#include "contacts/saved_contacts.hpp"
#include "world.hpp"

namespace plumb::jolt {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double pushed(const SavedManifold& manifold) {
  double sum = 0;
  for (std::size_t i = 0; i < manifold.count; ++i) sum += static_cast<double>(manifold.points[i].impulse);
  return sum;
}

/// Friction is one impulse for all points of a manifold: it is shared out by how much each point pushes.
void put_impulses(const SavedManifold& saved, JPH::Vec3 normal, std::size_t point, double parts,
                  PlumbContact& contact) {
  const auto impulse = static_cast<double>(saved.points[point].impulse);
  const JPH::Vec3 along = normal.GetNormalizedPerpendicular(), across = normal.Cross(along);
  const double all = pushed(saved);
  contact.normal_impulse = parts * impulse;
  contact.tangent_impulse = backend::scale(all > 0 ? parts * impulse / all : 0,
                                           to_plumb(saved.friction[0] * along + saved.friction[1] * across));
}

PlumbContact contact_of(const Manifold& manifold, std::size_t point) {
  PlumbContact contact{};
  contact.body_a = manifold.a->handle;
  contact.body_b = manifold.b->handle;
  contact.child_a = manifold.a->shape->child_of(manifold.parts.GetSubShapeID1());
  contact.child_b = manifold.b->shape->child_of(manifold.parts.GetSubShapeID2());
  contact.position = backend::scale(0.5, backend::add(manifold.on_a[point], manifold.on_b[point]));
  contact.normal = to_plumb(manifold.normal);
  contact.depth = manifold.depth(point);
  contact.normal_impulse = kUnknown;
  contact.tangent_impulse = {kUnknown, kUnknown, kUnknown};
  return contact;
}

}  // namespace

/// Jolt keeps the impulses of the last part of a step: the other parts count as it does.
void World::gather_contacts() {
  const bool with_impulses = needs(PLUMB_NEED_CONTACT_IMPULSES);
  const std::vector<SavedManifold> saved = with_impulses ? saved_contacts(system_) : std::vector<SavedManifold>();
  lent_.contacts.clear();
  for (const Manifold& manifold : listener_.manifolds()) {
    const SavedManifold* with = find(saved, manifold.parts);
    for (std::size_t i = 0; i < manifold.count; ++i) {
      lent_.contacts.push_back(contact_of(manifold, i));
      if (with != nullptr && i < with->count)
        put_impulses(*with, manifold.normal, i, settings_.collision_steps, lent_.contacts.back());
    }
  }
}

std::span<const PlumbContact> World::contacts() {
  if (!last_.contacts_fresh) gather_contacts();
  last_.contacts_fresh = true;
  return lent_.contacts;
}

}  // namespace plumb::jolt
