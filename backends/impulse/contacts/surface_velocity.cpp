#include "contacts/surface_velocity.hpp"

namespace plumb::impulse {

namespace {

struct PutSurfaceSpeeds {
  SurfaceSpeedWork work;

  /// Place j in the order by colour.
  PLUMB_HD void operator()(std::uint32_t j) const {
    const auto& [cache, bodies, proxies, surface_velocities, order, keys, rows, counters, changes] = work;
    const std::uint32_t row = order[j], key = keys[j];
    if (key == kSettledKey) return;
    const std::uint32_t slot = counters->first_slot[key] + (j - counters->first_in_colour[key]);
    const std::uint32_t candidate = cache.candidate[row];
    const Pair pair = cache.pairs[candidate];
    const CachedManifold& kept = cache.kept[row];
    const ManifoldChange* change = changes.find(candidate, PLUMB_MANIFOLD_SURFACE_VELOCITY);
    const Vec slip = change != nullptr ? change->surface_velocity : speed(pair.b) - speed(pair.a);
    Real* const numbers = rows.at(slot);
    numbers[place_of(kSurfaceSpeed)] = dot(slip, kept.tangent);
    numbers[place_of(kSurfaceSpeed + 1)] = dot(slip, cross(kept.normal, kept.tangent));
  }

 private:
  [[nodiscard]] PLUMB_HD Vec speed(std::uint32_t proxy) const {
    return rotate(work.bodies.orientation[work.proxies.rows[proxy].body], work.surface_velocities[proxy]);
  }
};

}  // namespace

void put_surface_speeds(Executor& executor, const SurfaceSpeedWork& work, std::uint32_t capacity) {
  executor.run(Count{&work.counters->manifolds, capacity}, PutSurfaceSpeeds{work});
}

}  // namespace plumb::impulse
