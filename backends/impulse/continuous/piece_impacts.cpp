// Impacts on planes, and on the triangles of surfaces.
#include "continuous/find_impacts.hpp"

namespace plumb::impulse {

namespace {

struct FindPieceImpacts {
  ImpactSearch search;

  PLUMB_HD void operator()(std::uint32_t p) const {
    const ContactCache& cache = search.cache;
    const Pair pair = cache.pairs[p];
    const bool flagged = search.is_continuous(pair), bounces = search.bounces(p);
    if (!(flagged || bounces) || search.is_convex(pair.a) == search.is_convex(pair.b)) return;
    const bool swapped = search.is_convex(pair.b);
    const MovingShape own = search.moving(swapped ? pair.b : pair.a), on = search.moving(swapped ? pair.a : pair.b);
    const bool may_pass = flagged && search.is_fast(pair, own, on);
    if (!may_pass && !(bounces && search.glances_off(own, on))) return;
    const Vec apart = swapped ? -search.apart(pair) : search.apart(pair);  // to the piece
    const std::uint32_t triangle = cache.triangles[p];
    // A plane has no reach.
    const Real close = kCloseShare * (on.shape->reach > 0 ? min(own.shape->reach, on.shape->reach) : own.shape->reach);
    if (search.touches_within(p, close)) return;
    Impact impact;
    const Course course = find(own, on, apart, close, triangle, search.proxies.hulls, impact);
    search.note(p, course, impact, close, may_pass);
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
