#include "narrowphase/sweep_rims.hpp"

#include "math/angle.hpp"
#include "narrowphase/convex/cylinder.hpp"
#include "narrowphase/feature.hpp"

namespace plumb::impulse {

namespace {

/// A point that runs so little, of the radius, that it rises by less is one point.
constexpr Real kLeastRise = Real(1e-4);

/// A cylinder from its centre, in world axes.
struct Rim {
  Vec axis;
  Real radius, half_height;

  /// Its foremost point along a direction.
  PLUMB_HD Vec foremost(const Vec& along) const {
    const Real up = dot(along, axis);
    const Vec across = normalized_or(along - up * axis, {0, 0, 0});
    return radius * across + (up < 0 ? -half_height : half_height) * axis;
  }
};

struct SweepRims {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const StepParameters* parameters;

  PLUMB_HD void operator()(std::uint32_t p) const {
    if (cache.touching[p] == 0 || cache.found[p].count != 1) return;
    const Pair pair = cache.pairs[p];
    const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];
    const Vec turn = bodies.velocity[a.body].angular - bodies.velocity[b.body].angular;
    Manifold& manifold = cache.found[p];
    if (proxies.shapes[a.shape].type == ShapeType::kCylinder) sweep(a, turn, manifold.normal, manifold);
    if (proxies.shapes[b.shape].type == ShapeType::kCylinder) sweep(b, -turn, -manifold.normal, manifold);
  }

 private:
  /// towards: the other shape. turn: the cylinder's against it, rad/s.
  PLUMB_HD void sweep(const Proxy& proxy, const Vec& turn, const Vec& towards, Manifold& manifold) const {
    if (manifold.count != 1) return;
    const Shape& shape = proxies.shapes[proxy.shape];
    const Quat orientation = shape_pose(proxy, bodies.orientation[proxy.body]).orientation;
    const Rim rim = {rotate(orientation, Vec{0, 1, 0}), shape.size.x, shape.size.y};
    // One that lies on its side rolls along with the point, where an edge cuts its line short.
    if (abs(dot(rim.axis, towards)) < cylinder::kNearSide) return;
    const ManifoldPoint first = manifold.points[0];
    const Vec from = rim.foremost(towards);
    for (std::uint32_t k = kManifoldPoints - 1; k > 0; --k) {
      const Real time = parameters->dt * static_cast<Real>(k) / (kManifoldPoints - 1);
      // Where the body then has what is foremost now turned round.
      const Vec way = rim.foremost(rotate(conjugate(turn_by(time * turn)), towards)) - from;
      const Real rise = -dot(way, towards);
      if (k == kManifoldPoints - 1 && !(rise > kLeastRise * rim.radius)) return;
      ManifoldPoint& point = manifold.points[k];
      point.separation = first.separation + rise;
      point.position = first.position + way + (rise / 2) * towards;
      point.feature = feature_id(Part::kVertex, k, Part::kFace, kSwept);
    }
    manifold.count = kManifoldPoints;
  }
  /// No face of this number touches a rim.
  static constexpr std::uint32_t kSwept = 1;
};

}  // namespace

void sweep_rims(Executor& executor, Count candidates, const ContactCache& cache, const Bodies& bodies,
                const Proxies& proxies, const StepParameters* parameters) {
  executor.run(candidates, SweepRims{cache, bodies, proxies, parameters});
}

}  // namespace plumb::impulse
