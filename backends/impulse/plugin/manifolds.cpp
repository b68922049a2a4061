// plumb.manifolds/1: what a step has found is shown, and solved as the host says.
#include "plugin/ranges.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

PlumbResult World::read_manifolds(std::span<const PlumbManifold>& manifolds) {
  lent_.manifolds.clear();
  if (!advance())
    for (const ShownManifold& shown : simulation_.shown()) {
      const ContactRecord& contact = shown.contact;
      PlumbManifold manifold{};
      manifold.body_a = bodies_[contact.bodies.a].id;
      manifold.body_b = bodies_[contact.bodies.b].id;
      manifold.child_a = child_of(contact.pair.a, contact.triangle[0]);
      manifold.child_b = child_of(contact.pair.b, contact.triangle[0]);
      manifold.point_count = contact.count;
      manifold.normal = to_plumb(contact.normal);
      manifold.velocity = to_plumb(shown.velocity);
      for (std::uint32_t p = 0; p < contact.count; ++p) {
        manifold.position[p] = plumb_vec(contact.position[p]);
        manifold.depth[p] = -static_cast<double>(contact.separation[p]);
      }
      manifold.friction = static_cast<double>(shown.friction);
      manifold.restitution = static_cast<double>(shown.restitution);
      manifold.surface_velocity = to_plumb(shown.surface_velocity);
      lent_.manifolds.push_back(manifold);
    }
  manifolds = lent_.manifolds;
  return PLUMB_OK;
}

PlumbResult World::modify_manifolds(std::span<const PlumbManifoldChange> changes) {
  std::vector<ManifoldChange> rows(lent_.manifolds.size());
  for (const PlumbManifoldChange& change : changes) {
    if ((change.what & PLUMB_MANIFOLD_SURFACE_VELOCITY) != 0)
      require_speed("changes.surface_velocity", change.surface_velocity);
    rows[change.manifold] = {change.what, static_cast<Real>(change.friction), static_cast<Real>(change.restitution),
                             to_vec(change.surface_velocity)};
  }
  simulation_.respond(rows);
  return PLUMB_OK;
}

}  // namespace plumb::impulse
