#include "contacts/rolling_friction.hpp"

namespace plumb::impulse {

namespace {

struct PutMoments {
  MomentWork work;

  /// Place j in the order by colour.
  PLUMB_HD void operator()(std::uint32_t j) const {
    const std::uint32_t row = work.order[j], key = work.keys[j];
    if (key == kSettledKey) return;
    const std::uint32_t slot = work.counters->first_slot[key] + (j - work.counters->first_in_colour[key]);
    const Pair pair = work.cache.pairs[work.cache.candidate[row]];
    const std::uint32_t a = work.proxies.rows[pair.a].body, b = work.proxies.rows[pair.b].body;
    const CachedManifold& kept = work.cache.kept[row];
    const Vec moment = work.levels.warm_start(*work.parameters, work.bodies.velocity, a, b) * kept.moment;
    const RollingFriction &of_a = work.rolling_frictions[a], &of_b = work.rolling_frictions[b];
    const Real numbers[kMomentFields] = {dot(moment, kept.tangent), dot(moment, cross(kept.normal, kept.tangent)),
                                         dot(moment, kept.normal), max(of_a.rolling, of_b.rolling),
                                         max(of_a.spinning, of_b.spinning)};
    for (std::uint32_t copy = 0; copy < kContactThreads; ++copy)
      for (std::uint32_t f = 0; f < kMomentFields; ++f) *work.rows.moment_at(slot, copy, f) = numbers[f];
  }
};

struct KeepMoments {
  ContactCache cache;
  ContactRows rows;

  PLUMB_HD void operator()(std::uint32_t slot) const {
    const std::uint32_t row = rows.row[slot];
    if (row == kNone) return;
    CachedManifold& kept = cache.kept[row];
    const auto at = [&](std::uint32_t f) { return *rows.moment_at(slot, 0, kMoment + f); };
    kept.moment = at(0) * kept.tangent + at(1) * cross(kept.normal, kept.tangent) + at(2) * kept.normal;
  }
};

}  // namespace

void put_moments(Executor& executor, const MomentWork& work, std::uint32_t capacity) {
  executor.run(Count{&work.counters->manifolds, capacity}, PutMoments{work});
}

void keep_moments(Executor& executor, const ContactCache& cache, const ContactRows& rows, const StepCounters* counters,
                  std::uint32_t capacity) {
  executor.run(Count{&counters->slots, capacity}, KeepMoments{cache, rows});
}

}  // namespace plumb::impulse
