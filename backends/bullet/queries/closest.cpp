// plumb.closest/1: bodies near a shape, by Bullet's GJK over what its broad phase finds in the box about it.
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "plumb/backend/small_math.hpp"
#include "queries/sharp_shape.hpp"
#include "world.hpp"

namespace plumb::bullet {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
constexpr PlumbVec3 kNowhere = {kNotMeasured, kNotMeasured, kNotMeasured};

thread_local std::vector<PlumbClosest> closest_rows;

bool nearer(const PlumbClosest& a, const PlumbClosest& b) {
  return a.distance != b.distance ? a.distance < b.distance : slot_of(a.body) < slot_of(b.body);
}

/// A box, as a broad phase has it.
struct Bounds {
  btVector3 low, high;

  [[nodiscard]] Bounds grown(double by) const {
    const auto far = static_cast<btScalar>(std::min(by, kLargest));
    const btVector3 more = btVector3(far, far, far) + (low.absolute() + high.absolute()) * (8 * SIMD_EPSILON);
    return {low - more, high + more};
  }
  /// No point of one is nearer to a point of the other; a little less for rounding.
  [[nodiscard]] double distance(const Bounds& other) const {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
      const double gap = std::max({0.0, static_cast<double>(other.low[i]) - static_cast<double>(high[i]),
                                   static_cast<double>(low[i]) - static_cast<double>(other.high[i])});
      square += gap * gap;
    }
    return std::sqrt(square) * (1 - 1e-5);
  }
};

/// What is near a probe of one body, seen from the probe's place with the world's axes: there Bullet's numbers are
/// small wherever in the world that is.
class Nearest {
 public:
  /// Nothing beyond `most` counts.
  Nearest(const SharpShape& probe, const btMatrix3x3& turn, double most) : probe_(probe), turn_(turn), most_(most) {}

  [[nodiscard]] double most() const { return most_; }
  [[nodiscard]] const std::optional<PlumbClosest>& found() const { return found_; }

  /// shape: at `pose`, of which all parts have the child's number but the triangles of a mesh.
  void look(const Shape& shape, const btTransform& pose, std::uint32_t child) {
    switch (shape.type) {
      case PLUMB_COMPOUND:
        for (std::uint32_t i = 0; i < shape.children.size(); ++i)
          look(*shape.children[i].shape, pose * shape.children[i].pose, i);
        return;
      case PLUMB_PLANE: return look_at_plane(pose, child);
      case PLUMB_TRIANGLE_MESH:
      case PLUMB_HEIGHT_FIELD: return look_at_triangles(shape, pose);
      default: look_at_convex(SharpShape(shape), pose, child);
    }
  }

 private:
  struct Triangles final : btTriangleCallback {
    Triangles(Nearest& n, const btTransform& p, const Bounds& b, bool told)
        : nearest(n), pose(p), probe(b), numbered(told) {}

    void processTriangle(btVector3* corners, int /*part*/, int index) override {
      Bounds bounds = {corners[0], corners[0]};
      for (int k = 1; k < 3; ++k) {
        bounds.low.setMin(corners[k]);
        bounds.high.setMax(corners[k]);
      }
      if (probe.distance(bounds) > nearest.most_) return;
      // About its own middle, so that a small triangle far from the surface's origin is as sharp as any.
      const btVector3 middle = (corners[0] + corners[1] + corners[2]) / 3;
      btTriangleShape triangle(corners[0] - middle, corners[1] - middle, corners[2] - middle);
      triangle.setMargin(0);
      nearest.look_at_convex(triangle, btTransform(pose.getBasis(), pose * middle),
                             numbered ? static_cast<std::uint32_t>(index) : 0);
    }

    Nearest& nearest;
    const btTransform& pose;
    Bounds probe;  ///< in the surface's axes
    bool numbered;
  };

  void look_at_triangles(const Shape& shape, const btTransform& pose) {
    Bounds probe{};
    probe_.getAabb(pose.inverseTimes(btTransform(turn_)), probe.low, probe.high);
    const Bounds around = probe.grown(most_);
    Triangles triangles(*this, pose, probe, shape.type == PLUMB_TRIANGLE_MESH);
    static_cast<const btConcaveShape&>(*shape.bullet).processAllTriangles(&triangles, around.low, around.high);
  }

  void look_at_plane(const btTransform& pose, std::uint32_t child) {
    const btVector3 normal = pose.getBasis().getColumn(1);
    const btVector3 lowest = turn_ * probe_.localGetSupportingVertexWithoutMargin(-normal * turn_);
    const btVector3 on_probe = lowest - probe_.getMargin() * normal;
    const btScalar height = normal.dot(on_probe - pose.getOrigin());
    add(static_cast<double>(height), on_probe, on_probe - height * normal, -normal, child);
  }

  /// Both of Bullet's GJKs end at points of the two cores, and in single precision either may end early: the nearer
  /// counts.
  void look_at_convex(const btConvexShape& shape, const btTransform& pose, std::uint32_t child) {
    btVoronoiSimplexSolver simplex;
    btGjkPairDetector detector(&probe_, &shape, &simplex, nullptr);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = btTransform(turn_);
    input.m_transformB = pose;
    btPointCollector collector;
    detector.getClosestPoints(input, collector, nullptr);
    if (!collector.m_hasResult) return add(0, {}, {}, {}, child);  // the cores overlap
    btScalar distance = collector.m_distance;
    btVector3 on_body = collector.m_pointInWorld, normal = -collector.m_normalOnBInWorld;
    btGjkEpaSolver2::sResults other;
    if (btGjkEpaSolver2::Distance(&probe_, input.m_transformA, &shape, pose, -normal, other)) {
      const btVector3 way = other.witnesses[1] - other.witnesses[0];
      const btScalar length = way.length(), margins = probe_.getMargin() + shape.getMargin();
      if (length > SIMD_EPSILON && length - margins < distance) {
        distance = length - margins;
        normal = way / length;
        on_body = other.witnesses[1] - shape.getMargin() * normal;
      }
    }
    add(static_cast<double>(distance), on_body - distance * normal, on_body, normal, child);
  }

  void add(double distance, const btVector3& on_probe, const btVector3& on_body, const btVector3& normal,
           std::uint32_t child) {
    distance = std::max(distance, 0.0);
    if (distance > most_ || (found_ && distance == found_->distance && child >= found_->child)) return;
    most_ = distance;
    found_ = PlumbClosest{0, 0, child, distance, kNowhere, kNowhere, kNowhere};
    if (distance == 0) return;
    found_->on_probe = to_plumb(on_probe);
    found_->on_body = to_plumb(on_body);
    found_->normal = to_plumb(normal);
  }

  const SharpShape& probe_;
  btMatrix3x3 turn_;
  double most_;
  std::optional<PlumbClosest> found_;
};

/// Bodies whose boxes are near, the nearest box first.
class Candidates final : public btBroadphaseAabbCallback {
 public:
  struct Row {
    const Body* body;
    double least;  ///< m, distance at least
  };

  Candidates(const PlumbFilter& filter, const Bounds& probe) : filter_(filter), probe_(probe) {}

  bool process(const btBroadphaseProxy* proxy) override {
    const Body& body = *our_body(static_cast<const btCollisionObject*>(proxy->m_clientObject));
    if (body.shape && !body.is_sensor() && may_touch(filter_, body.filter))
      rows_.push_back({&body, probe_.distance({proxy->m_aabbMin, proxy->m_aabbMax})});
    return true;
  }

  const std::vector<Row>& nearest_first() {
    std::sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.least < b.least; });
    return rows_;
  }

 private:
  const PlumbFilter& filter_;
  Bounds probe_;
  std::vector<Row> rows_;
};

PlumbVec3 moved(const PlumbVec3& from, const PlumbVec3& by) { return {from.x + by.x, from.y + by.y, from.z + by.z}; }

/// Appends what a probe finds no further away than `reach`: one body a row, in no order.
void find_within(double reach, btBroadphaseInterface& broad_phase, const PlumbProbe& probe, const SharpShape& sharp,
                 PlumbHitMode mode) {
  const btTransform pose = transform(probe.pose, "pose");
  Bounds bounds{};
  sharp.getAabb(pose, bounds.low, bounds.high);
  Candidates candidates(probe.filter, bounds);
  const Bounds around = bounds.grown(reach);
  broad_phase.aabbTest(around.low, around.high, candidates);
  for (const Candidates::Row& candidate : candidates.nearest_first()) {
    if (candidate.least > reach) break;
    const btTransform at = candidate.body->frame_pose();
    const PlumbVec3 apart = backend::sub(to_plumb(at.getOrigin()), probe.pose.position);
    Nearest nearest(sharp, pose.getBasis(), reach);
    nearest.look(*candidate.body->shape, btTransform(at.getBasis(), vector(apart, "the way to a body")), 0);
    if (!nearest.found()) continue;
    PlumbClosest row = *nearest.found();
    row.body = candidate.body->handle;
    row.on_probe = moved(probe.pose.position, row.on_probe);
    row.on_body = moved(probe.pose.position, row.on_body);
    closest_rows.push_back(row);
    if (mode == PLUMB_HIT_CLOSEST) reach = row.distance;
  }
}

/// Appends the rows of a probe. What is nearest is looked for in boxes that grow, so that a large distance
/// costs little.
void find(btBroadphaseInterface& broad_phase, const PlumbProbe& probe, const Shape& shape, std::uint32_t number,
          PlumbHitMode mode) {
  constexpr double kGrowth = 4;
  const std::size_t first = closest_rows.size();
  const SharpShape sharp(shape);
  double reach = probe.most_distance;
  if (mode == PLUMB_HIT_CLOSEST) {
    btVector3 middle;
    btScalar radius = 0;
    shape.bullet->getBoundingSphere(middle, radius);
    reach = std::min(reach, std::max(static_cast<double>(radius), kSmallest));
  }
  for (;; reach = std::min(kGrowth * reach, probe.most_distance)) {
    find_within(reach, broad_phase, probe, sharp, mode);
    if (closest_rows.size() > first || reach == probe.most_distance) break;
  }
  for (std::size_t i = first; i < closest_rows.size(); ++i) closest_rows[i].probe = number;
  std::sort(closest_rows.begin() + static_cast<std::ptrdiff_t>(first), closest_rows.end(), nearer);
  if (mode == PLUMB_HIT_ALL) return;
  if (closest_rows.size() == first) closest_rows.push_back({0, number, 0, kNotMeasured, kNowhere, kNowhere, kNowhere});
  closest_rows.resize(first + 1);
}

}  // namespace

ClosestBodies World::closest_bodies(PlumbHitMode mode, std::span<const PlumbProbe> probes) {
  const std::lock_guard lock(query_mutex_);
  closest_rows.clear();
  for (std::uint32_t i = 0; i < probes.size(); ++i)
    find(parts_.broadphase, probes[i], *shape(probes[i].shape), i, mode);
  return {PLUMB_OK, closest_rows};
}

}  // namespace plumb::bullet
