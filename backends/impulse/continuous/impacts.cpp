#include "continuous/impacts.hpp"

#include "continuous/find_impacts.hpp"
#include "narrowphase/collide.hpp"

namespace plumb::impulse {

namespace {

/// Two convex shapes.
struct FindImpacts {
  ImpactSearch search;

  PLUMB_HD void operator()(std::uint32_t p) const {
    search.times[p] = 0;
    const ContactCache& cache = search.cache;
    const Pair pair = cache.pairs[p];
    const bool flagged = search.is_flagged(pair), bounces = search.bounces(p);
    if (!(flagged || bounces) || !search.is_convex(pair.a) || !search.is_convex(pair.b)) return;
    const MovingShape a = search.moving(pair.a), b = search.moving(pair.b);
    const bool may_pass = flagged && search.is_fast(pair, a, b);
    if (!may_pass && !(bounces && search.glances_off(a, b))) return;
    const Real close = kCloseShare * min(a.shape->reach, b.shape->reach);
    if (search.touches_within(p, close)) return;
    const Vec apart = search.apart(pair);
    const Hulls& hulls = search.proxies.hulls;
    Impact impact;
    const Course course = find_impact(a, b, apart, search.parameters->dt, close, hulls, impact);
    if (course == Course::kNear) return;
    if (may_pass) cache.touching[p] = 0;
    if (course == Course::kMiss) return;
    const ShapePose pose_a = a.pose(impact.time), pose_b = b.pose(impact.time);
    const Vec d = apart + impact.time * (b.way.linear - a.way.linear) + pose_b.offset - pose_a.offset;
    Manifold manifold;
    if (!collide({*a.shape, *b.shape, pose_a.orientation, pose_b.orientation, d, 2 * impact.gap + close}, hulls,
                 manifold))
      return;
    cache.found[p] = manifold;
    cache.touching[p] = 1;
    search.times[p] = impact.time;
  }
};

}  // namespace

void Impacts::find(Executor& executor, const ContactCache& cache, Count candidates, const Bodies& bodies,
                   const Proxies& proxies, const Real* margins, const StepParameters* parameters, bool uses_midphase) {
  const ImpactSearch search = {cache, bodies, proxies, margins, parameters, times_.data()};
  executor.run(candidates, FindImpacts{search});
  if (uses_midphase) find_piece_impacts(executor, candidates, search);
}

}  // namespace plumb::impulse
