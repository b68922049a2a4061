// Impacts on planes, and on the triangles of surfaces.
#include "continuous/find_impacts.hpp"
#include "continuous/sided_surface.hpp"

namespace plumb::impulse {

namespace {

struct FindPieceImpacts {
  ImpactSearch search;

  PLUMB_HD void operator()(std::uint32_t p) const {
    const ContactCache& cache = search.cache;
    const Pair pair = cache.pairs[p];
    const bool flagged = search.is_flagged(pair), bounces = search.bounces(p);
    if (!(flagged || bounces) || search.is_convex(pair.a) == search.is_convex(pair.b)) return;
    const bool swapped = search.is_convex(pair.b);
    const MovingShape own = search.moving(swapped ? pair.b : pair.a), on = search.moving(swapped ? pair.a : pair.b);
    const bool may_pass = flagged && search.is_fast(pair, own, on);
    const bool glances = bounces && search.glances_off(own, on);
    if (!flagged && !glances) return;
    const Vec apart = swapped ? -search.apart(pair) : search.apart(pair);  // to the piece
    const std::uint32_t triangle = cache.triangles[p];
    const Hulls& hulls = search.proxies.hulls;
    const Real close = kCloseShare * (on.shape->reach > 0 ? min(own.shape->reach, on.shape->reach) : own.shape->reach);

    Impact impact = {0, 0};
    Real margin = search.margins[pair.a] + search.margins[pair.b];
    const bool behind = is_behind(own, on, apart, search.proxies, triangle);
    // At first, where the narrow phase may have taken the side for the other, what touches at the start; then what
    // will.
    for (int round = flagged && behind && cache.touching[p] != 0 ? 0 : 1; round < 2; ++round) {
      if (round == 1) {
        if ((!may_pass && !glances) || search.touches_within(p, close)) return;
        const Course course = find(own, on, apart, close, triangle, hulls, impact);
        if (course == Course::kNear) return;
        if (may_pass) cache.touching[p] = 0;
        if (course == Course::kMiss) return;
        margin = 2 * impact.gap + close;
      }
      const ShapePose pose_own = own.pose(impact.time), pose_on = on.pose(impact.time);
      const Vec d = apart + impact.time * (on.way.linear - own.way.linear) + pose_on.offset - pose_own.offset;
      Manifold manifold;
      const bool touches =
          collide_with_side({*own.shape, *on.shape, pose_own.orientation, pose_on.orientation, d, margin},
                            search.proxies, triangle, behind, manifold);
      if (!touches) {
        if (flagged) cache.touching[p] = 0;
        continue;
      }
      cache.touching[p] = 1;
      if (swapped) swap_sides(-d, manifold);
      cache.found[p] = manifold;
      search.times[p] = impact.time;
    }
  }

 private:
  PLUMB_HD Course find(const MovingShape& own, const MovingShape& on, const Vec& apart, Real close,
                       std::uint32_t triangle, const Hulls& hulls, Impact& impact) const {
    const Real end = search.parameters->dt;
    if (on.shape->type == ShapeType::kPlane) return find_impact_on_plane(on, own, -apart, end, close, hulls, impact);
    return find_impact_on_triangle(on, triangle_of(*on.shape, search.proxies.surfaces, triangle), own, -apart, end,
                                   close, hulls, impact);
  }
};

}  // namespace

void find_piece_impacts(Executor& executor, Count candidates, const ImpactSearch& search) {
  executor.run(candidates, FindPieceImpacts{search});
}

}  // namespace plumb::impulse
