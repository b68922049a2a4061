// plumb.manifolds/1: what a sub-step has found, and what the host makes of it.
#include "contacts.hpp"
#include "plumb/assert.hpp"
#include "world.hpp"

namespace plumb::bullet {
namespace {

bool asks(const Body& body) { return (body.flags & PLUMB_BODY_MODIFY_CONTACTS) != 0; }

btVector3 velocity_at(const Body& body, const btVector3& point) {
  return body.getVelocityInLocalPoint(point - body.getWorldTransform().getOrigin());
}

/// The points stand as Bullet has them; where a mesh has several triangles in a manifold, it is named by the first.
PlumbManifold shown(const btPersistentManifold& manifold, std::span<const PlumbContact> points) {
  const Body &a = *our_body(manifold.getBody0()), &b = *our_body(manifold.getBody1());
  PLUMB_ASSERT(!points.empty() && points.size() <= PLUMB_MANIFOLD_POINTS);
  PlumbManifold row{};
  row.body_a = a.handle;
  row.body_b = b.handle;
  row.child_a = points[0].child_a;
  row.child_b = points[0].child_b;
  row.point_count = static_cast<std::uint32_t>(points.size());
  row.normal = points[0].normal;
  btVector3 middle(0, 0, 0);
  for (std::size_t k = 0; k < points.size(); ++k) {
    row.position[k] = points[k].position;
    row.depth[k] = points[k].depth;
    const btManifoldPoint& point = manifold.getContactPoint(static_cast<int>(k));
    middle += (point.m_positionWorldOnA + point.m_positionWorldOnB) / static_cast<btScalar>(2 * points.size());
  }
  row.velocity = to_plumb(velocity_at(b, middle) - velocity_at(a, middle));
  row.friction = static_cast<double>(manifold.getContactPoint(0).m_combinedFriction);
  row.restitution = static_cast<double>(manifold.getContactPoint(0).m_combinedRestitution);
  row.surface_velocity = to_plumb(surface_velocity_between(a, b));
  return row;
}

}  // namespace

PlumbResult World::read_manifolds(std::span<const PlumbManifold>& manifolds) {
  modification_.manifolds.clear();
  modification_.shown.clear();
  while (sub_step_.left > 0) {
    btDispatcher& dispatcher = parts_.dispatcher;
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      const Body &a = *our_body(manifold.getBody0()), &b = *our_body(manifold.getBody1());
      if (manifold.getNumContacts() == 0 || !(asks(a) || asks(b)) || !is_solved(manifold)) continue;
      std::vector<PlumbContact> points;
      for (int k = 0; k < manifold.getNumContacts(); ++k)
        points.push_back(contact_of(manifold.getContactPoint(k), a, b, false));
      modification_.manifolds.push_back(shown(manifold, points));
      modification_.shown.push_back(&manifold);
    }
    if (!modification_.shown.empty()) break;
    respond();
  }
  PLUMB_ASSERT(modification_.manifolds.size() == modification_.shown.size());
  manifolds = modification_.manifolds;
  return PLUMB_OK;
}

PlumbResult World::modify_manifolds(std::span<const PlumbManifoldChange> changes) {
  for (const PlumbManifoldChange& change : changes) {
    if ((change.what & PLUMB_MANIFOLD_FRICTION) != 0) static_cast<void>(scalar(change.friction, "changes.friction"));
    if ((change.what & PLUMB_MANIFOLD_SURFACE_VELOCITY) != 0)
      static_cast<void>(vector(change.surface_velocity, "changes.surface_velocity"));
  }
  for (const PlumbManifoldChange& change : changes) {
    PLUMB_ASSERT(change.manifold < modification_.shown.size());
    btPersistentManifold* manifold = modification_.shown[change.manifold];
    if ((change.what & PLUMB_MANIFOLD_DISABLED) != 0)
      manifold->clearManifold();
    else
      modification_.changed.emplace_back(manifold, change);
  }
  respond();
  return PLUMB_OK;
}

void World::apply_manifold_changes() {
  for (const auto& [manifold, change] : modification_.changed) {
    for (int k = 0; k < manifold->getNumContacts(); ++k) {
      btManifoldPoint& point = manifold->getContactPoint(k);
      if ((change.what & PLUMB_MANIFOLD_FRICTION) != 0)
        point.m_combinedFriction = static_cast<btScalar>(change.friction);
      if ((change.what & PLUMB_MANIFOLD_RESTITUTION) != 0)
        point.m_combinedRestitution = static_cast<btScalar>(change.restitution);
    }
    if ((change.what & PLUMB_MANIFOLD_SURFACE_VELOCITY) != 0)
      run_surface(*manifold, vector(change.surface_velocity, "surface_velocity"));
  }
}

void World::take_back_manifold_changes() {
  for (const auto& [manifold, change] : modification_.changed) {
    refresh_materials(*manifold);
    if ((change.what & PLUMB_MANIFOLD_SURFACE_VELOCITY) != 0) stop_surface(*manifold);
  }
  modification_.changed.clear();
}

}  // namespace plumb::bullet
