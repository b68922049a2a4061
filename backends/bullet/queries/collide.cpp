// Collision without a step: the contact algorithm that a step would use, on two posed shapes.
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <algorithm>
#include <mutex>

#include "moving_mesh.hpp"
#include "world.hpp"

namespace plumb::bullet {
namespace {

constexpr double kUnknownDistance = std::numeric_limits<double>::quiet_NaN();

thread_local std::vector<PlumbPairPoint> pair_points;

/// Takes points as they are found. The algorithm's manifold says which body is meant by "on B".
class PointCollector final : public btManifoldResult {
 public:
  PointCollector(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b)
      : btManifoldResult(a, b), object_a_(a->getCollisionObject()) {}

  void addContactPoint(const btVector3& normal_on_b, const btVector3& point_on_b, btScalar distance) override {
    if (distance > m_manifoldPtr->getContactBreakingThreshold()) return;
    const btVector3 normal = m_manifoldPtr->getBody0() == object_a_ ? -normal_on_b : normal_on_b;
    pair_points.push_back(
        {to_plumb(point_on_b + normal_on_b * (distance / 2)), to_plumb(normal), -static_cast<double>(distance), 0});
  }

 private:
  const btCollisionObject* object_a_;
};

/// The distance of shapes that are apart, from the algorithms that Bullet keeps for closest points.
struct DistanceCallback final : btCollisionWorld::ContactResultCallback {
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    const auto at = static_cast<double>(point.getDistance());
    if (!(distance <= at)) distance = at;
    return 0;
  }
  double distance = kUnknownDistance;
};

void collide_objects(btDispatcher& dispatcher, const btDispatcherInfo& info, btCollisionObject& a,
                     btCollisionObject& b) {
  const btCollisionObjectWrapper wrap_a(nullptr, a.getCollisionShape(), &a, a.getWorldTransform(), -1, -1);
  const btCollisionObjectWrapper wrap_b(nullptr, b.getCollisionShape(), &b, b.getWorldTransform(), -1, -1);
  btCollisionAlgorithm* algorithm = dispatcher.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  if (algorithm == nullptr) return;
  PointCollector collector(&wrap_a, &wrap_b);
  algorithm->processCollision(&wrap_a, &wrap_b, info, &collector);
  algorithm->~btCollisionAlgorithm();
  dispatcher.freeCollisionAlgorithm(algorithm);
}

/// A mesh for this call alone, where the other shape meets none but moving meshes; else null.
std::unique_ptr<btCollisionShape> moving_mesh_for(const Shape& mesh, const Shape& other) {
  const bool surface =
      other.type == PLUMB_TRIANGLE_MESH || other.type == PLUMB_HEIGHT_FIELD || other.type == PLUMB_PLANE;
  if (mesh.type != PLUMB_TRIANGLE_MESH || !surface) return nullptr;
  return make_moving_mesh(mesh, btTransform::getIdentity());
}

}  // namespace

PlumbResult World::collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                                 std::span<const PlumbPairPoint>& points) {
  const std::lock_guard lock(query_mutex_);
  pair_points.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Shape &shape_a = *shape(pairs[i].shape_a), &shape_b = *shape(pairs[i].shape_b);
    const auto mesh_a = moving_mesh_for(shape_a, shape_b);
    const auto mesh_b = mesh_a ? nullptr : moving_mesh_for(shape_b, shape_a);
    btCollisionObject a, b;
    a.setCollisionShape(mesh_a ? mesh_a.get() : shape_a.bullet.get());
    b.setCollisionShape(mesh_b ? mesh_b.get() : shape_b.bullet.get());
    a.setWorldTransform(transform(pairs[i].pose_a, "pose_a"));
    b.setWorldTransform(transform(pairs[i].pose_b, "pose_b"));
    const std::size_t first = pair_points.size();
    collide_objects(parts_.dispatcher, world_.getDispatchInfo(), a, b);
    double distance = kUnknownDistance;
    for (std::size_t k = first; k < pair_points.size(); ++k)
      if (!(distance <= -pair_points[k].depth)) distance = -pair_points[k].depth;
    if (pair_points.size() == first && a.getCollisionShape()->isConvex() && b.getCollisionShape()->isConvex()) {
      DistanceCallback callback;
      callback.m_closestDistanceThreshold = static_cast<btScalar>(kLargest) / 1000;
      world_.contactPairTest(&a, &b, callback);
      distance = callback.distance;
    }
    results[i] = {distance, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(pair_points.size() - first)};
  }
  points = pair_points;
  return PLUMB_OK;
}

}  // namespace plumb::bullet
