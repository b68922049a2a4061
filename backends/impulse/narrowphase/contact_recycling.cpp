#include "narrowphase/contact_recycling.hpp"

#include "geometry/tolerance.hpp"
#include "narrowphase/convex/polyhedron.hpp"

namespace plumb::impulse {

namespace {

/// How far a point may have slid, as a share of the thinner shape's inner radius: where edges cross, or an edge ends,
/// the true point has gone along one body and not along the other.
constexpr Real kMostSlide = Real(2e-3);

/// What counts of a shape's size, m.
struct ShapeSize {
  Real reach;         ///< from its origin to what is furthest
  Real inner_radius;  ///< of a ball about its middle that it holds

  PLUMB_HD ShapeSize(const Shape& shape, const Hulls& hulls) : reach(shape.reach), inner_radius(kHuge) {
    if (shape.type == ShapeType::kBox) inner_radius = BoxView{shape.size}.inner_radius();
    if (shape.type == ShapeType::kCylinder) inner_radius = min(shape.size.x, shape.size.y);
    if (shape.type == ShapeType::kHull) inner_radius = hulls.ranges[shape.hull].inner_radius;
    if (shape.type == ShapeType::kPlane) reach = kHuge;
  }
};

/// The turn from then to now.
PLUMB_HD Quat turn_since(const Quat& then, const Quat& now) { return now * conjugate(then); }
/// Between two turns, rad, where it is small; a quaternion and its negative are the same turn, and count as far apart.
PLUMB_HD Real angle_between(const Quat& a, const Quat& b) {
  const Vec u = vector_part(b) - vector_part(a);
  const Real w = b.w - a.w;
  return 2 * sqrt(length_squared(u) + w * w);
}

struct RecycleContact {
  NarrowPhaseWork work;

  PLUMB_HD void operator()(std::uint32_t p) const {
    const auto& [cache, last, bodies, proxies, margins, parameters] = work;
    cache.collided.clear(p);
    cache.previous[p] = kNone;
    const Pair pair = cache.pairs[p];
    const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];
    if (a.first_step == parameters->step || b.first_step == parameters->step) return;
    const std::uint32_t triangle = cache.triangles == nullptr ? 0U : cache.triangles[p];
    const std::uint32_t previous = find_candidate(last, pair, triangle, place_in_list(cache, p));
    cache.previous[p] = previous;
    if (previous == kNone || !last.collided.is_recyclable(previous)) return;
    const CollidedManifold before = last.collided.load(previous);
    const bool touched = before.manifold.count != 0;
    if (touched ? !carry(before, a, b, work.margin(pair), cache.found[p]) : !are_apart(before, a, b, work.margin(pair)))
      return;
    cache.collided.store(p, before);
    cache.touching[p] = touched ? 1 : 0;
  }

 private:
  /// The manifold as the bodies lie now; false where a point of it has slid too far, or more may be in reach by now.
  PLUMB_HD bool carry(const CollidedManifold& before, const Proxy& a, const Proxy& b, Real margin,
                      Manifold& out) const {
    const Bodies& bodies = work.bodies;
    const ShapeSize size_a(work.proxies.shapes[a.shape], work.proxies.hulls);
    const ShapeSize size_b(work.proxies.shapes[b.shape], work.proxies.hulls);
    const Real reach = min(size_a.reach, size_b.reach);
    const Real most = kMostSlide * min(size_a.inner_radius, size_b.inner_radius);
    const Quat turn_a = turn_since(before.orientation_a, bodies.orientation[a.body]);
    const Quat turn_b = turn_since(before.orientation_b, bodies.orientation[b.body]);
    if (!(angle_between(turn_a, turn_b) * reach <= most) || !(margin <= before.margin + most)) return false;

    const Vec moved = between(before.apart, bodies.position[b.body] - bodies.position[a.body]);
    const Vec apart_then = between({0, 0, 0}, before.apart);
    const Vec origin_then = rotate(before.orientation_a, a.frame.position);
    const Vec origin = rotate(bodies.orientation[a.body], a.frame.position);
    const Manifold& then = before.manifold;
    out.normal = then.normal + change_by_turn(turn_b, then.normal);
    out.count = then.count;
    PLUMB_UNROLL
    for (std::uint32_t i = 0; i < kManifoldPoints; ++i) {
      if (i >= then.count) break;
      const ManifoldPoint& point = then.points[i];
      const Vec arm_a = origin_then + point.position, arm_b = arm_a - apart_then;
      const Vec by_a = change_by_turn(turn_a, arm_a);
      const Vec slide = moved + change_by_turn(turn_b, arm_b) - by_a;
      if (!(length_squared(slide) <= most * most)) return false;
      out.points[i] = {arm_a + by_a + Real(0.5) * slide - origin, point.separation + dot(slide, out.normal),
                       point.feature};
    }
    return true;
  }
  /// Whether shapes that did not touch have not come so near since that they may.
  PLUMB_HD bool are_apart(const CollidedManifold& before, const Proxy& a, const Proxy& b, Real margin) const {
    const Bodies& bodies = work.bodies;
    const Real reach_a = work.proxies.shapes[a.shape].reach, reach_b = work.proxies.shapes[b.shape].reach;
    const Real most = before.manifold.gap - margin - kTie * (reach_a + reach_b);
    const Quat turn_a = turn_since(before.orientation_a, bodies.orientation[a.body]);
    const Quat turn_b = turn_since(before.orientation_b, bodies.orientation[b.body]);
    // As seen from a, b's shape turns about its origin, and its origin goes this way.
    const Vec to_b = rotate(before.orientation_b, b.frame.position);
    const Vec between_then = between({0, 0, 0}, before.apart) + to_b;
    const Vec way = between(before.apart, bodies.position[b.body] - bodies.position[a.body]) +
                    change_by_turn(turn_b, to_b) - change_by_turn(turn_a, between_then);
    return length(way) + angle_between(turn_a, turn_b) * reach_b < most;
  }
};

}  // namespace

void recycle_contacts(Executor& executor, Count candidates, const NarrowPhaseWork& work) {
  executor.run(candidates, RecycleContact{work});
}

}  // namespace plumb::impulse
