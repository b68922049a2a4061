#include "continuous/impacts.hpp"

#include "continuous/find_impacts.hpp"

namespace plumb::impulse {

namespace {

/// Two convex shapes; of all pairs that there is no time yet.
struct FindImpacts {
  ImpactSearch search;

  PLUMB_HD void operator()(std::uint32_t p) const {
    search.times[p].time = 0;
    const ContactCache& cache = search.cache;
    const Pair pair = cache.pairs[p];
    const bool flagged = search.is_continuous(pair), bounces = search.bounces(p);
    if (!(flagged || bounces) || !search.is_convex(pair.a) || !search.is_convex(pair.b)) return;
    const MovingShape a = search.moving(pair.a), b = search.moving(pair.b);
    const bool may_pass = flagged && search.is_fast(pair, a, b);
    if (!may_pass && !(bounces && search.glances_off(a, b))) return;
    const Real close = kCloseShare * min(a.shape->reach, b.shape->reach);
    if (search.touches_within(p, close)) return;
    Impact impact;
    const Course course =
        find_impact(a, b, search.apart(pair), search.parameters->dt, close, search.proxies.hulls, impact);
    search.note(p, course, impact, close, may_pass);
  }
};

}  // namespace

void Impacts::find(Executor& executor, Count candidates, const NarrowPhaseWork& work, bool uses_midphase) {
  const ImpactSearch search = {work, times_.data()};
  executor.run(candidates, FindImpacts{search});
  if (uses_midphase) find_piece_impacts(executor, candidates, search);
}

}  // namespace plumb::impulse
