#include "contacts/belts.hpp"

namespace plumb::impulse {

namespace {

struct PutDrift {
  DriftWork work;

  /// Place j in the order by colour.
  PLUMB_HD void operator()(std::uint32_t j) const {
    const auto& [cache, bodies, proxies, belts, order, colours, rows, counters] = work;
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
    return rotate(work.bodies.orientation[work.proxies.rows[proxy].body], work.belts[proxy]);
  }
};

}  // namespace

void put_drifts(Executor& executor, const DriftWork& work, std::uint32_t capacity) {
  executor.run(Count{&work.counters->manifolds, capacity}, PutDrift{work});
}

}  // namespace plumb::impulse
