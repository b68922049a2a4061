#include "materials.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <algorithm>
#include <mutex>

#include "plumb/assert.hpp"

namespace plumb::bullet {
namespace {

CalculateCombinedCallback next_friction = nullptr;
CalculateCombinedCallback next_restitution = nullptr;
CalculateCombinedCallback next_rolling = nullptr;
CalculateCombinedCallback next_spinning = nullptr;
ContactAddedCallback next_contact_added = nullptr;

bool ours(const btCollisionObject* a, const btCollisionObject* b) {
  return a->getUserIndex3() == kOurMark && b->getUserIndex3() == kOurMark;
}

btScalar combine_friction(const btCollisionObject* a, const btCollisionObject* b) {
  return ours(a, b) ? btSqrt(a->getFriction() * b->getFriction()) : next_friction(a, b);
}

btScalar combine_restitution(const btCollisionObject* a, const btCollisionObject* b) {
  return ours(a, b) ? std::max(a->getRestitution(), b->getRestitution()) : next_restitution(a, b);
}

btScalar combine_spinning(const btCollisionObject* a, const btCollisionObject* b) {
  return ours(a, b) ? std::max(a->getSpinningFriction(), b->getSpinningFriction()) : next_spinning(a, b);
}

/// Bullet looks at the spinning friction only where there is some rolling friction.
btScalar combine_rolling(const btCollisionObject* a, const btCollisionObject* b) {
  if (!ours(a, b)) return next_rolling(a, b);
  const btScalar least = combine_spinning(a, b) > 0 ? btScalar(1e-12) : btScalar(0);
  return std::max({a->getRollingFriction(), b->getRollingFriction(), least});
}

struct Coefficients {
  btScalar friction, restitution;
};

/// Of the part of a body's shape that is touched; null: the body's. index: as Bullet numbers parts, which it does not
/// do with the triangles of a height field. place: in the world.
const PlumbMaterial* own_material(const Body& body, int index, const btVector3& place) {
  if (!body.shape) return nullptr;
  if (body.shape->type == PLUMB_HEIGHT_FIELD) {
    const btVector3 local = body.frame_pose().invXform(place);
    return body.shape->materials.at(static_cast<double>(local.x()), static_cast<double>(local.z()));
  }
  const auto part = static_cast<std::size_t>(index);
  if (index < 0) return nullptr;
  if (body.shape->type == PLUMB_TRIANGLE_MESH) return body.shape->materials.of(part);
  if (part >= body.shape->children.size() || !body.shape->children[part].has_material) return nullptr;
  return &body.shape->children[part].material;
}

Coefficients coefficients_at(const btCollisionObject* object, int index, const btVector3& place) {
  const Body& body = *our_body(object);
  const PlumbMaterial* own = own_material(body, index, place);
  if (own == nullptr) return {body.getFriction(), body.getRestitution()};
  return {static_cast<btScalar>(own->friction), static_cast<btScalar>(own->restitution)};
}

void combine(btManifoldPoint& point, const btCollisionObject* a, int index_a, const btCollisionObject* b, int index_b) {
  PLUMB_ASSERT(ours(a, b));
  const Coefficients of_a = coefficients_at(a, index_a, point.m_positionWorldOnA),
                     of_b = coefficients_at(b, index_b, point.m_positionWorldOnB);
  point.m_combinedFriction = btSqrt(of_a.friction * of_b.friction);
  point.m_combinedRestitution = std::max(of_a.restitution, of_b.restitution);
  point.m_combinedRollingFriction = combine_rolling(a, b);
  point.m_combinedSpinningFriction = combine_spinning(a, b);
}

bool contact_added(btManifoldPoint& point, const btCollisionObjectWrapper* a, int part_a, int index_a,
                   const btCollisionObjectWrapper* b, int part_b, int index_b) {
  const btCollisionObject *object_a = a->getCollisionObject(), *object_b = b->getCollisionObject();
  if (ours(object_a, object_b))
    combine(point, object_a, index_a, object_b, index_b);
  else if (next_contact_added != nullptr)
    return next_contact_added(point, a, part_a, index_a, b, part_b, index_b);
  return true;
}

/// Velocity of a body's moving surface relative to the body, world axes.
btVector3 surface_velocity(const Body& body) {
  const PlumbVec3& v = body.surface_velocity;
  return body.frame_pose().getBasis() *
         btVector3(static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z));
}

void direct_friction(btManifoldPoint& point, const Body& a, const Body& b, const btVector3& surface_slip) {
  const btVector3& normal = point.m_normalWorldOnB;
  const btVector3 slip = a.getVelocityInLocalPoint(point.m_positionWorldOnA - a.getWorldTransform().getOrigin()) -
                         b.getVelocityInLocalPoint(point.m_positionWorldOnB - b.getWorldTransform().getOrigin()) +
                         surface_slip;
  PLUMB_ASSERT(std::abs(normal.length2() - 1) < btScalar(1e-3));
  const btVector3 along = slip - normal * normal.dot(slip);
  if (along.length2() > SIMD_EPSILON) {
    point.m_lateralFrictionDir1 = along.normalized();
    point.m_lateralFrictionDir2 = point.m_lateralFrictionDir1.cross(normal);
  } else {
    btPlaneSpace1(normal, point.m_lateralFrictionDir1, point.m_lateralFrictionDir2);
  }
  point.m_contactMotion1 = -point.m_lateralFrictionDir1.dot(surface_slip);
  point.m_contactMotion2 = -point.m_lateralFrictionDir2.dot(surface_slip);
  point.m_contactPointFlags |= BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
}

}  // namespace

void install_material_callbacks() {
  static std::once_flag once;
  std::call_once(once, [] {
    next_friction = gCalculateCombinedFrictionCallback;
    next_restitution = gCalculateCombinedRestitutionCallback;
    next_rolling = gCalculateCombinedRollingFrictionCallback;
    next_spinning = gCalculateCombinedSpinningFrictionCallback;
    next_contact_added = gContactAddedCallback;
    gCalculateCombinedFrictionCallback = &combine_friction;
    gCalculateCombinedRestitutionCallback = &combine_restitution;
    gCalculateCombinedRollingFrictionCallback = &combine_rolling;
    gCalculateCombinedSpinningFrictionCallback = &combine_spinning;
    gContactAddedCallback = &contact_added;
  });
}

bool needs_contact_material(const Body& body) { return body.shape && body.shape->has_own_material(); }

void refresh_materials(btDispatcher& dispatcher, const Body& body) {
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getBody0() == &body || manifold.getBody1() == &body) refresh_materials(manifold);
  }
}

void refresh_materials(btPersistentManifold& manifold) {
  for (int k = 0; k < manifold.getNumContacts(); ++k) {
    btManifoldPoint& point = manifold.getContactPoint(k);
    combine(point, manifold.getBody0(), point.m_index0, manifold.getBody1(), point.m_index1);
  }
}

btVector3 surface_velocity_between(const Body& a, const Body& b) { return surface_velocity(b) - surface_velocity(a); }

void run_surface(btPersistentManifold& manifold, const btVector3& b_over_a) {
  const Body &a = *our_body(manifold.getBody0()), &b = *our_body(manifold.getBody1());
  for (int k = 0; k < manifold.getNumContacts(); ++k) direct_friction(manifold.getContactPoint(k), a, b, -b_over_a);
}

void stop_surface(btPersistentManifold& manifold) {
  for (int k = 0; k < manifold.getNumContacts(); ++k) {
    btManifoldPoint& point = manifold.getContactPoint(k);
    point.m_contactMotion1 = point.m_contactMotion2 = 0;
    point.m_contactPointFlags &= ~static_cast<int>(BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED);
  }
}

void apply_surface_velocities(btDispatcher& dispatcher) {
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const Body &a = *our_body(manifold.getBody0()), &b = *our_body(manifold.getBody1());
    if (a.conveys || b.conveys) run_surface(manifold, surface_velocity_between(a, b));
  }
}

}  // namespace plumb::bullet
