// Rays, casts and overlaps against the world as it stands.
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "plumb/backend/hit_collector.hpp"
#include "plumb/backend/small_math.hpp"
#include "queries/exact_rays.hpp"
#include "world.hpp"

namespace plumb::bullet {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

thread_local std::vector<PlumbHit> found;

bool sees(const PlumbFilter& filter, const btBroadphaseProxy* proxy) {
  const Body& body = *our_body(static_cast<const btCollisionObject*>(proxy->m_clientObject));
  return body.shape && !body.is_sensor() && may_touch(filter, body.filter);
}

std::uint32_t child_of(const Body& body, const btCollisionWorld::LocalShapeInfo* info) {
  const PlumbShapeType type = body.shape->type;
  if (info == nullptr || info->m_triangleIndex < 0 || (type != PLUMB_COMPOUND && type != PLUMB_TRIANGLE_MESH)) return 0;
  return static_cast<std::uint32_t>(info->m_triangleIndex);
}

/// One hit a body, its nearest, for one query of a batch.
class Collector {
 public:
  Collector(std::uint32_t query, PlumbHitMode mode) : query_(query), mode_(mode), first_(found.size()) {}

  void add(const Body& body, std::uint32_t child, double fraction, const PlumbVec3& position, const PlumbVec3& normal) {
    const PlumbHit hit{body.handle, query_, child, fraction, position, normal};
    for (std::size_t i = first_; i < found.size(); ++i) {
      PlumbHit& other = found[i];
      if (mode_ == PLUMB_HIT_ALL && other.body != hit.body) continue;
      if (nearer(hit, other)) other = hit;
      return;
    }
    found.push_back(hit);
  }

  [[nodiscard]] bool has(const Body& body) const {
    return std::any_of(found.begin() + static_cast<std::ptrdiff_t>(first_), found.end(),
                       [&](const PlumbHit& hit) { return hit.body == body.handle; });
  }
  [[nodiscard]] bool any() const { return found.size() > first_; }

  void finish() {
    if (mode_ == PLUMB_HIT_CLOSEST && !any())
      found.push_back({0, query_, 0, kUnknown, {kUnknown, kUnknown, kUnknown}, {kUnknown, kUnknown, kUnknown}});
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(first_), found.end(), nearer);
  }

 private:
  static bool nearer(const PlumbHit& a, const PlumbHit& b) {
    return a.fraction != b.fraction ? a.fraction < b.fraction : slot_of(a.body) < slot_of(b.body);
  }

  std::uint32_t query_;
  PlumbHitMode mode_;
  std::size_t first_;
};

btVector3 world_normal(const Body& body, const btVector3& normal, bool in_world) {
  return in_world ? normal : body.getWorldTransform().getBasis() * normal;
}

struct RayCallback final : btCollisionWorld::RayResultCallback {
  RayCallback(const PlumbRay& r, Collector& c) : ray(r), collector(c) {
    m_flags |= btTriangleRaycastCallback::kF_UseGjkConvexCastRaytest;
  }

  btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool in_world) override {
    const Body& body = *our_body(result.m_collisionObject);
    const double fraction = first + static_cast<double>(result.m_hitFraction) * (last - first);
    const PlumbVec3 &o = ray.origin, &t = ray.translation;
    collector.add(body, child_of(body, result.m_localShapeInfo), fraction,
                  {o.x + fraction * t.x, o.y + fraction * t.y, o.z + fraction * t.z},
                  to_plumb(world_normal(body, result.m_hitNormalLocal, in_world).normalized()));
    m_closestHitFraction = std::min(m_closestHitFraction, result.m_hitFraction);
    return m_closestHitFraction;
  }

  const PlumbRay& ray;
  Collector& collector;
  double first = 0, last = 1;  ///< fractions of the ray between which Bullet is asked
};

/// A ray inside of a body's box, in the body's axes.
struct Clipped {
  double first = 0, last = 1;  ///< fractions
  double level = 0;            ///< m that are covered along x and z
};

/// The box is widened a little; nothing where the ray misses it.
std::optional<Clipped> clip(const Body& body, const PlumbRay& ray) {
  btVector3 lower, upper;
  body.getCollisionShape()->getAabb(btTransform::getIdentity(), lower, upper);
  const btVector3 slack = (upper - lower) * btScalar(0.01) + btVector3(1, 1, 1) * btScalar(0.01);
  const backend::Matrix3 to_body = backend::transpose(to_matrix(body.getWorldTransform().getBasis()));
  const PlumbVec3 o =
      backend::multiply(to_body, backend::sub(ray.origin, to_plumb(body.getWorldTransform().getOrigin())));
  const PlumbVec3 d = backend::multiply(to_body, ray.translation);
  const double origin[3] = {o.x, o.y, o.z}, along[3] = {d.x, d.y, d.z};
  Clipped part;
  for (int i = 0; i < 3; ++i) {
    const auto low = static_cast<double>(lower[i] - slack[i]), high = static_cast<double>(upper[i] + slack[i]);
    if (along[i] == 0) {
      if (origin[i] < low || origin[i] > high) return std::nullopt;
      continue;
    }
    const double a = (low - origin[i]) / along[i], b = (high - origin[i]) / along[i];
    part.first = std::max(part.first, std::min(a, b));
    part.last = std::min(part.last, std::max(a, b));
  }
  if (!(part.first < part.last)) return std::nullopt;
  part.level = (part.last - part.first) * std::hypot(d.x, d.z);
  return part;
}

/// Bullet walks a height field's grid cell by cell along the whole ray, also where rounding has moved its end far away.
/// Where that could take long all cells in the ray's box are asked instead, of which there are no more than in the
/// field.
bool can_walk_grid(const Body& body, const PlumbRay& ray, const Clipped& part) {
  if (body.shape->type != PLUMB_HEIGHT_FIELD) return true;
  constexpr double epsilon = std::numeric_limits<btScalar>::epsilon();
  const PlumbVec3 &o = ray.origin, &t = ray.translation, at = to_plumb(body.getWorldTransform().getOrigin());
  const double size = backend::length(o) + part.last * backend::length(t) + backend::length(at);
  const btVector3& spacing = body.getCollisionShape()->getLocalScaling();
  const auto cell = static_cast<double>(std::min(spacing.x(), spacing.z()));
  return part.level + 100 * epsilon * size < 1e4 * cell;
}

/// Walks the broad phase; bodies that can be answered exactly are, the others go through Bullet's own test.
struct RayWalk final : btBroadphaseRayCallback {
  RayWalk(const PlumbRay& r, Collector& c, RayCallback& b, const btVector3& start, const btVector3& end)
      : ray(r), collector(c), bullet(b) {
    const btVector3 along = (end - start).normalized();
    for (int i = 0; i < 3; ++i) {
      m_rayDirectionInverse[i] = along[i] == 0 ? btScalar(BT_LARGE_FLOAT) : 1 / along[i];
      m_signs[i] = m_rayDirectionInverse[i] < 0 ? 1 : 0;
    }
    m_lambda_max = along.dot(end - start);
  }

  bool process(const btBroadphaseProxy* proxy) override {
    if (!sees(ray.filter, proxy)) return true;
    auto* object = static_cast<btCollisionObject*>(proxy->m_clientObject);
    const Body& body = *our_body(object);
    if (!has_exact_ray(body)) {
      ask_bullet(*object, body);
    } else if (const auto entry = ray_enters(body, ray.origin, ray.translation)) {
      const PlumbVec3 &o = ray.origin, &t = ray.translation;
      collector.add(body, 0, entry->fraction,
                    {o.x + entry->fraction * t.x, o.y + entry->fraction * t.y, o.z + entry->fraction * t.z},
                    entry->normal);
    }
    return true;
  }

  /// Only for the part of the ray that is inside of the body's box, so that little is lost to rounding.
  void ask_bullet(btCollisionObject& object, const Body& body) {
    const std::optional<Clipped> part = clip(body, ray);
    if (!part) return;
    bullet.first = part->first;
    bullet.last = part->last;
    bullet.m_closestHitFraction = 1;
    constexpr unsigned int all_cells = btTriangleRaycastCallback::kF_DisableHeightfieldAccelerator;
    bullet.m_flags = can_walk_grid(body, ray, *part) ? bullet.m_flags & ~all_cells : bullet.m_flags | all_cells;
    btCollisionWorld::rayTestSingle(at(bullet.first), at(bullet.last), &object, object.getCollisionShape(),
                                    object.getWorldTransform(), bullet);
  }

  [[nodiscard]] btTransform at(double fraction) const {
    const PlumbVec3 &o = ray.origin, &t = ray.translation;
    return btTransform(
        btQuaternion::getIdentity(),
        vector(PlumbVec3{o.x + fraction * t.x, o.y + fraction * t.y, o.z + fraction * t.z}, "a point of a ray"));
  }

  const PlumbRay& ray;
  Collector& collector;
  RayCallback& bullet;
};

struct CastCallback final : btCollisionWorld::ConvexResultCallback {
  CastCallback(const PlumbFilter& f, Collector& c, PlumbHitMode m) : filter(f), collector(c), mode(m) {}

  bool needsCollision(btBroadphaseProxy* proxy) const override {
    return sees(filter, proxy) &&
           !collector.has(*our_body(static_cast<const btCollisionObject*>(proxy->m_clientObject)));
  }

  btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool in_world) override {
    const Body& body = *our_body(result.m_hitCollisionObject);
    hits.push_back({&body, child_of(body, result.m_localShapeInfo), static_cast<double>(result.m_hitFraction),
                    to_plumb(result.m_hitPointLocal),
                    to_plumb(world_normal(body, result.m_hitNormalLocal, in_world).normalized())});
    if (mode == PLUMB_HIT_CLOSEST) m_closestHitFraction = std::min(m_closestHitFraction, result.m_hitFraction);
    return m_closestHitFraction;
  }

  struct Hit {
    const Body* body;
    std::uint32_t child;
    double fraction;
    PlumbVec3 position, normal;
  };
  const PlumbFilter& filter;
  Collector& collector;
  PlumbHitMode mode;
  std::vector<Hit> hits;
};

/// keep(body, child, depth, position, normal) of every point of contact.
template <class Keep>
struct OverlapCallback final : btCollisionWorld::ContactResultCallback {
  OverlapCallback(const btCollisionObject& o, const PlumbFilter& f, const Keep& k) : object(o), filter(f), keep(k) {}

  bool needsCollision(btBroadphaseProxy* proxy) const override { return sees(filter, proxy); }

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int /*part_a*/, int index_a,
                           const btCollisionObjectWrapper* b, int /*part_b*/, int index_b) override {
    if (point.getDistance() > 0) return 0;
    const bool first = a->getCollisionObject() == &object;
    const Body& body = *our_body((first ? b : a)->getCollisionObject());
    const btCollisionWorld::LocalShapeInfo info{-1, first ? index_b : index_a};
    // On B and towards A, in the order of the arguments; wanted is the normal of the body's surface.
    const btVector3 normal = first ? point.m_normalWorldOnB : -point.m_normalWorldOnB;
    keep(body, child_of(body, &info), -static_cast<double>(point.getDistance()), to_plumb(point.getPositionWorldOnB()),
         to_plumb(normal));
    return 0;
  }

  const btCollisionObject& object;
  const PlumbFilter& filter;
  const Keep& keep;
};

template <class Keep>
void overlap(btCollisionWorld& world, const Shape& shape, const PlumbPose& pose, const PlumbFilter& filter,
             const Keep& keep) {
  btCollisionObject object;
  object.setCollisionShape(shape.bullet.get());
  object.setWorldTransform(transform(pose, "pose"));
  OverlapCallback<Keep> callback(object, filter, keep);
  world.contactTest(&object, callback);
}

btVector3 end_of(const btVector3& from, const PlumbVec3& translation) {
  return from + vector(translation, "translation");
}

}  // namespace

Hits World::cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) {
  const std::lock_guard lock(query_mutex_);
  found.clear();
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    Collector collector(i, mode);
    RayCallback callback(rays[i], collector);
    const btVector3 from = vector(rays[i].origin, "origin");
    const btVector3 to = end_of(from, rays[i].translation);
    RayWalk walk(rays[i], collector, callback, from, to);
    parts_.broadphase.rayTest(from, to, walk);
    collector.finish();
  }
  return {PLUMB_OK, found};
}

/// Bullet's sweep is not to be trusted where the shape overlaps at the start: that is asked apart.
Hits World::cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) {
  const std::lock_guard lock(query_mutex_);
  found.clear();
  for (std::uint32_t i = 0; i < casts.size(); ++i) {
    const PlumbCast& cast = casts[i];
    const Shape& moved = *shape(cast.shape);
    Collector collector(i, mode);
    overlap(world_, moved, cast.pose, cast.filter,
            [&](const Body& body, std::uint32_t child, double /*depth*/, const PlumbVec3& position,
                const PlumbVec3& normal) { collector.add(body, child, 0, position, normal); });
    if (mode == PLUMB_HIT_ALL || !collector.any()) {
      const btTransform from = transform(cast.pose, "pose");
      const btTransform to(from.getBasis(), end_of(from.getOrigin(), cast.translation));
      CastCallback callback(cast.filter, collector, mode);
      world_.convexSweepTest(static_cast<const btConvexShape*>(moved.bullet.get()), from, to, callback);
      for (const CastCallback::Hit& hit : callback.hits)
        collector.add(*hit.body, hit.child, hit.fraction, hit.position, hit.normal);
    }
    collector.finish();
  }
  return {PLUMB_OK, found};
}

Hits World::overlap_shapes(std::span<const PlumbOverlap> overlaps) {
  const std::lock_guard lock(query_mutex_);
  found.clear();
  for (std::uint32_t i = 0; i < overlaps.size(); ++i) {
    Collector collector(i, PLUMB_HIT_ALL);
    overlap(world_, *shape(overlaps[i].shape), overlaps[i].pose, overlaps[i].filter,
            [&](const Body& body, std::uint32_t child, double, const PlumbVec3&, const PlumbVec3&) {
              constexpr PlumbVec3 nowhere{kUnknown, kUnknown, kUnknown};
              collector.add(body, child, 0, nowhere, nowhere);
            });
    collector.finish();
  }
  return {PLUMB_OK, found};
}

Penetrations World::penetrations(std::span<const PlumbOverlap> overlaps) {
  const std::lock_guard lock(query_mutex_);
  thread_local std::vector<PlumbPenetration> touches;
  touches.clear();
  for (std::uint32_t i = 0; i < overlaps.size(); ++i)
    overlap(
        world_, *shape(overlaps[i].shape), overlaps[i].pose, overlaps[i].filter,
        [&](const Body& body, std::uint32_t child, double depth, const PlumbVec3& position, const PlumbVec3& normal) {
          touches.push_back({body.handle, i, child, depth, position, normal});
        });
  return {PLUMB_OK, backend::deepest_of_bodies(touches)};
}

}  // namespace plumb::bullet
