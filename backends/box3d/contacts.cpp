// Contact points of the last step, with their impulses.
#include "manifolds.hpp"

namespace plumb::box3d {
namespace {

/// Box3D adds up what a point has pushed with after the solve and again after the relaxation of each sub-step.
constexpr double kCountedTwice = 0.5;

double pushed(const b3Manifold& manifold) {
  double sum = 0;
  for (int i = 0; i < manifold.pointCount; ++i) sum += static_cast<double>(manifold.points[i].totalNormalImpulse);
  return sum;
}

}  // namespace

/// Friction is one impulse for all points of a manifold, and known of the last sub-step: it is shared out by how much
/// each point pushes, times the sub-steps.
void World::gather_contacts() {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const bool with_impulses = needs(PLUMB_NEED_CONTACT_IMPULSES);
  contacts_.clear();
  each_manifold([&](const b3ContactData& data, const Body& a, const Body& b, const b3Manifold& manifold) {
    const PlumbVec3 centre = to_plumb(b3Body_GetWorldCenter(a.id));
    const double all = pushed(manifold);
    for (int i = 0; i < manifold.pointCount; ++i) {
      const b3ManifoldPoint& point = manifold.points[i];
      PlumbContact contact{};
      contact.body_a = a.handle;
      contact.body_b = b.handle;
      contact.child_a = child_of(a, data.shapeIdA, point.triangleIndex);
      contact.child_b = child_of(b, data.shapeIdB, point.triangleIndex);
      contact.position = backend::add(centre, to_plumb(point.anchorA));
      contact.normal = to_plumb(manifold.normal);
      contact.depth = -static_cast<double>(point.separation);
      contact.normal_impulse = unknown;
      contact.tangent_impulse = {unknown, unknown, unknown};
      if (with_impulses) {
        const auto total = static_cast<double>(point.totalNormalImpulse);
        contact.normal_impulse = kCountedTwice * total;
        contact.tangent_impulse =
            backend::scale(all > 0 ? total / all * settings_.substeps : 0, to_plumb(manifold.frictionImpulse));
      }
      contact.feature = (std::uint64_t{static_cast<std::uint32_t>(data.contactId.index1)} << 32 | point.featureId) + 1;
      contacts_.push_back(contact);
    }
  });
}

std::span<const PlumbContact> World::contacts() {
  if (!contacts_fresh_) gather_contacts();
  contacts_fresh_ = true;
  return contacts_;
}

}  // namespace plumb::box3d
