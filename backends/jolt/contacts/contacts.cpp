// Contact points of the last step, with their impulses.
#include <algorithm>
#include <optional>

#include "contacts/saved_contacts.hpp"
#include "world.hpp"

namespace plumb::jolt {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Jolt rubs a manifold at the mean of its points, along it and about its normal. Here that is shared out by how much
/// each point pushes, so that force and moment stay what they are.
class Friction {
 public:
  Friction(const SavedManifold& saved, const Manifold& manifold) : saved_(saved), normal_(to_plumb(manifold.normal)) {
    const JPH::Vec3 along = manifold.normal.GetNormalizedPerpendicular(), across = manifold.normal.Cross(along);
    force_ = to_plumb(saved.friction[0] * along + saved.friction[1] * across);
    count_ = std::min(saved.count, manifold.count);
    double all = 0;
    for (std::size_t i = 0; i < count_; ++i) all += static_cast<double>(saved.points[i].impulse);
    PlumbVec3 mean{}, centre{};
    for (std::size_t i = 0; i < count_; ++i) {
      shares_[i] = all > 0 ? static_cast<double>(saved.points[i].impulse) / all : 0;
      arms_[i] = backend::scale(0.5, backend::add(manifold.on_a[i], manifold.on_b[i]));
      mean = backend::add(mean, backend::scale(1 / static_cast<double>(count_), arms_[i]));
      centre = backend::add(centre, backend::scale(shares_[i], arms_[i]));
    }
    double spread = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      arms_[i] = backend::cross(normal_, backend::sub(arms_[i], centre));
      spread += shares_[i] * backend::dot(arms_[i], arms_[i]);
    }
    const double moment =
        static_cast<double>(saved.torsion) + backend::dot(normal_, backend::cross(backend::sub(mean, centre), force_));
    turns_ = spread > 0 ? moment / spread : 0;
  }

  [[nodiscard]] bool tells(std::size_t point) const { return point < count_; }
  [[nodiscard]] double push(std::size_t point) const { return static_cast<double>(saved_.points[point].impulse); }
  [[nodiscard]] PlumbVec3 rub(std::size_t point) const {
    return backend::scale(shares_[point], backend::add(force_, backend::scale(turns_, arms_[point])));
  }

 private:
  const SavedManifold& saved_;
  PlumbVec3 normal_, force_{};
  std::size_t count_ = 0;
  double shares_[Manifold::kMostPoints]{};
  PlumbVec3 arms_[Manifold::kMostPoints]{};  ///< m: from the centre of what pushes, a quarter turn about the normal
  double turns_ = 0;                         ///< N s for each m
};

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
  const double parts = settings_.collision_steps;
  std::vector<SavedManifold> saved;
  if (needs(PLUMB_NEED_CONTACT_IMPULSES)) saved = saved_contacts(system_);
  lent_.contacts.clear();
  for (const Manifold& manifold : listener_.manifolds()) {
    const SavedManifold* with = find(saved, manifold.parts);
    std::optional<Friction> friction;
    if (with != nullptr) friction.emplace(*with, manifold);
    for (std::size_t i = 0; i < manifold.count; ++i) {
      PlumbContact contact = contact_of(manifold, i);
      if (friction && friction->tells(i)) {
        contact.normal_impulse = parts * friction->push(i);
        contact.tangent_impulse = backend::scale(parts, friction->rub(i));
      }
      lent_.contacts.push_back(contact);
    }
  }
}

std::span<const PlumbContact> World::contacts() {
  if (!last_.contacts_fresh) gather_contacts();
  last_.contacts_fresh = true;
  return lent_.contacts;
}

}  // namespace plumb::jolt
