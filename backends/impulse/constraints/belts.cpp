#include "constraints/belts.hpp"

namespace plumb::impulse {

namespace {

struct PutDrift {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const Vec* belts;
  const std::uint32_t *order, *colours;
  ContactRows rows;
  const StepCounters* counters;

  /// Place j in the order by colour.
  PLUMB_HD void operator()(std::uint32_t j) const {
    const std::uint32_t row = order[j], colour = colours[j];
    const std::uint32_t slot = counters->first_slot[colour] + (j - counters->first_in_colour[colour]);
    const Pair pair = cache.pairs[cache.candidate[row]];
    const CachedManifold& kept = cache.kept[row];
    const Vec drift = speed(pair.b) - speed(pair.a);
    Real* const numbers = rows.at(slot);
    numbers[place_of(kDrift)] = dot(drift, kept.tangent);
    numbers[place_of(kDrift + 1)] = dot(drift, cross(kept.normal, kept.tangent));
  }

 private:
  [[nodiscard]] PLUMB_HD Vec speed(std::uint32_t proxy) const {
    return rotate(bodies.orientation[proxies.rows[proxy].body], belts[proxy]);
  }
};

}  // namespace

void put_drifts(Executor& executor, const ContactCache& cache, std::uint32_t capacity, const Bodies& bodies,
                const Proxies& proxies, const Vec* belts, const std::uint32_t* order, const std::uint32_t* colours,
                const ContactRows& rows, const StepCounters* counters) {
  executor.run(Count{&counters->manifolds, capacity},
               PutDrift{cache, bodies, proxies, belts, order, colours, rows, counters});
}

}  // namespace plumb::impulse
