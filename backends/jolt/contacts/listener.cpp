#include "contacts/listener.hpp"

#include <algorithm>

#include "materials.hpp"

namespace plumb::jolt {
namespace {

/// World axes.
JPH::Vec3 surface_velocity(const JPH::Body& body, JPH::SubShapeID part) {
  const PlumbVec3& v = material_of(body, part).surface_velocity;
  return body.GetRotation() * JPH::Vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
}

}  // namespace

double Manifold::depth(std::size_t point) const {
  return backend::dot(backend::sub(on_a[point], on_b[point]), to_plumb(normal));
}

double Manifold::deepest() const {
  double most = depth(0);
  for (std::size_t i = 1; i < count; ++i) most = std::max(most, depth(i));
  return most;
}

bool Manifold::touches() const { return deepest() >= -static_cast<double>(JPH::cDefaultCollisionTolerance); }

void Listener::look_at(const JPH::Body& a, const JPH::Body& b, const JPH::ContactManifold& manifold,
                       JPH::ContactSettings& settings) {
  if (moves_)
    settings.mRelativeLinearSurfaceVelocity =
        surface_velocity(b, manifold.mSubShapeID2) - surface_velocity(a, manifold.mSubShapeID1);
  if (!keeps_ || settings.mIsSensor) return;
  Manifold kept;
  kept.a = &owner(a);
  kept.b = &owner(b);
  kept.parts = {a.GetID(), manifold.mSubShapeID1, b.GetID(), manifold.mSubShapeID2};
  kept.normal = manifold.mWorldSpaceNormal;
  kept.count = std::min<std::size_t>(manifold.mRelativeContactPointsOn1.size(), Manifold::kMostPoints);
  for (std::size_t i = 0; i < kept.count; ++i) {
    kept.on_a[i] = to_plumb(manifold.GetWorldSpaceContactPointOn1(static_cast<JPH::uint>(i)));
    kept.on_b[i] = to_plumb(manifold.GetWorldSpaceContactPointOn2(static_cast<JPH::uint>(i)));
  }
  const std::lock_guard lock(mutex_);
  found_.push_back(kept);
}

/// A body with continuous collision is told of by the search for overlap and again by its cast.
void Listener::finish_step() {
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Manifold& a, const Manifold& b) { return a.parts < b.parts; });
  const auto same = [](const Manifold& a, const Manifold& b) { return a.parts == b.parts; };
  found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
}

}  // namespace plumb::jolt
