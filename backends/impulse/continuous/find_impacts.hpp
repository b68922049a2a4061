// What the searches for impacts have in common, of convex pairs and of pieces.
#pragma once

#include "continuous/impacts.hpp"
#include "narrowphase/collide_candidates.hpp"
#include "narrowphase/contact_material.hpp"

namespace plumb::impulse {

/// How far a round shape comes, in radii, before its contact is that of its impact.
constexpr Real kGlanceShare = Real(0.02);
PLUMB_HD inline Real radius_of_round(const Shape& shape) {
  return shape.type == ShapeType::kSphere || shape.type == ShapeType::kCapsule ? shape.size.x : kHuge;
}

/// How far any point of a shape goes, at most, m.
PLUMB_HD inline Real travel(const MovingShape& shape, Real dt) {
  return dt * (length(shape.way.linear) + shape.reach() * length(shape.way.angular));
}

/// A pair of candidates, as a kernel looks at it.
struct ImpactSearch : NarrowPhaseWork {
  PairTime* times;

  [[nodiscard]] PLUMB_HD const Shape& shape(std::uint32_t proxy) const {
    return proxies.shapes[proxies.rows[proxy].shape];
  }
  [[nodiscard]] PLUMB_HD bool is_convex(std::uint32_t proxy) const { return impulse::is_convex(shape(proxy).type); }
  [[nodiscard]] PLUMB_HD MovingShape moving(std::uint32_t proxy) const {
    return moving_shape(bodies, proxies, *parameters, proxy);
  }
  [[nodiscard]] PLUMB_HD Vec apart(const Pair& pair) const {
    return between(bodies.position[proxies.rows[pair.a].body], bodies.position[proxies.rows[pair.b].body]);
  }
  /// Whether they go further than the narrow phase looks ahead.
  [[nodiscard]] PLUMB_HD bool is_fast(const Pair& pair, const MovingShape& a, const MovingShape& b) const {
    return travel(a, parameters->dt) + travel(b, parameters->dt) > margin(pair);
  }
  /// Whether the narrow phase foresees that they touch, and they bounce where they do.
  [[nodiscard]] PLUMB_HD bool bounces(std::uint32_t p) const {
    return cache.touching[p] != 0 && contact_material(cache, proxies, p).restitution > 0;
  }
  /// Whether one is round, and comes so far that the normal where they touch is not that of now.
  [[nodiscard]] PLUMB_HD bool glances_off(const MovingShape& a, const MovingShape& b) const {
    const Real radius = min(radius_of_round(*a.shape), radius_of_round(*b.shape));
    return parameters->dt * length(a.way.linear - b.way.linear) > kGlanceShare * radius;
  }
  /// Whether one is a sheet, and the other behind it as the step begins.
  [[nodiscard]] PLUMB_HD bool starts_behind(const Pair& pair, std::uint32_t p) const {
    const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];
    const ShapePair shapes = shapes_at(*this, a, b, place_at_start(*this, a, b, margin(pair)));
    return (is_surface(shapes.a.type) || is_surface(shapes.b.type)) &&
           is_behind(shapes, proxies.hulls, proxies.surfaces, cache.triangles[p]);
  }
  /// What has been found of pair p: where it comes near, it is to be collided there, its points not further off than
  /// what was left then, twice. may_pass: what was found of it as it lies counts only if it is near.
  PLUMB_HD void note(std::uint32_t p, Course course, const Impact& impact, Real close, bool may_pass) const {
    if (course == Course::kNear) return;
    if (may_pass) cache.touching[p] = 0;
    if (course == Course::kMiss) return;
    const Pair pair = cache.pairs[p];
    const MovingShape a = moving(pair.a), b = moving(pair.b);
    const ShapePose pose_a = a.pose(impact.time), pose_b = b.pose(impact.time);
    const Vec d = apart(pair) + impact.time * (b.way.linear - a.way.linear) + pose_b.offset - pose_a.offset;
    times[p] = {impact.time,
                {pose_a.orientation, pose_b.orientation, d, 2 * impact.gap + close, starts_behind(pair, p)}};
  }
  [[nodiscard]] PLUMB_HD bool touches_within(std::uint32_t p, Real close) const {
    if (cache.touching[p] == 0) return false;
    const Manifold& manifold = cache.found[p];
    Real least = manifold.points[0].separation;
    for (std::uint32_t i = 1; i < manifold.count; ++i) least = min(least, manifold.points[i].separation);
    return least <= close;
  }
};

/// Of the smaller shape: what is nearer touches.
constexpr Real kCloseShare = Real(0.0001);

/// Of the pairs of which one is a plane or a surface.
void find_piece_impacts(Executor& executor, Count candidates, const ImpactSearch& search);

}  // namespace plumb::impulse
