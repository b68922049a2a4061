#include "narrowphase/contact_recycling.hpp"

#include "geometry/tolerance.hpp"
#include "narrowphase/carried_manifold.hpp"

namespace plumb::impulse {

namespace {

struct RecycleContact {
  NarrowPhaseWork work;

  PLUMB_HD void operator()(std::uint32_t p) const {
    const ContactCache &cache = work.cache, &last = work.last;
    const Proxies& proxies = work.proxies;
    cache.collided.clear(p);
    cache.previous[p] = kNone;
    const Pair pair = cache.pairs[p];
    const bool of_surface = has_surface(proxies, pair);
    const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];
    if (a.first_step == work.parameters->step || b.first_step == work.parameters->step) return;
    const std::uint32_t triangle = cache.triangles == nullptr ? 0U : cache.triangles[p];
    const std::uint32_t previous = find_candidate(last, pair, triangle, place_in_list(cache, p));
    cache.previous[p] = previous;
    if (previous == kNone || !last.collided.is_recyclable(previous)) return;
    if (of_surface && cache.touching[p] != kCarried) return;
    const CollidedManifold before = last.collided.load(previous);
    const bool touched = before.manifold.count != 0;
    if (touched ? !carry(work, before, pair, cache.found[p]) : !are_apart(before, a, b, work.margin(pair))) return;
    cache.collided.store(p, before);
    if (of_surface)
      cache.point_triangles[p] = last.point_triangles[previous];
    else
      cache.touching[p] = touched ? 1 : 0;
  }

 private:
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
