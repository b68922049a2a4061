#include "contacts/match.hpp"

#include "contacts/contact_normals.hpp"
#include "exec/atomic.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

struct Match {
  MatchWork work;

  PLUMB_HD void operator()(std::uint32_t row) const {
    const auto& [cache, last, woken, bodies, proxies, parameters, counters, mechanisms, masks] = work;
    const std::uint32_t candidate = cache.candidate[row];
    const Pair pair = cache.pairs[candidate];
    const Manifold& found = cache.found[candidate];
    const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];

    CachedManifold kept;
    kept.normal = found.normal;
    kept.tangent = perpendicular(found.normal);
    kept.count = found.count;
    kept.colour = kNone;
    kept.owner_a = pushed_owner(a.body);
    kept.owner_b = pushed_owner(b.body);
    for (std::uint32_t i = 0; i < kManifoldPoints; ++i) {
      kept.feature[i] = i < found.count ? found.points[i].feature : 0;
      kept.normal_impulse[i] = kept.tangent_impulse[0][i] = kept.tangent_impulse[1][i] = 0;
    }
    const std::uint32_t previous = cache.previous[candidate];
    const CachedManifold* old =
        previous != kNone && last.touching[previous] != 0 ? &last.kept[last.row[previous]] : nullptr;
    if (old == nullptr && woken != nullptr)
      old = find_kept(woken, parameters->woken_contacts, pair,
                      cache.triangles == nullptr ? 0U : cache.triangles[candidate]);
    if (old != nullptr) remember(*old, found, kept);
    PLUMB_ASSERT(kept.count >= 1);
    cache.kept[row] = kept;
    atomic_add(&counters->points, kept.count);
    if (kept.colour == kNone) return;
    const std::uint64_t bit = std::uint64_t{1} << kept.colour;
    if (kept.owner_a != kNone) atomic_or(&masks[kept.owner_a], bit);
    if (kept.owner_b != kNone) atomic_or(&masks[kept.owner_b], bit);
  }

 private:
  PLUMB_HD std::uint32_t pushed_owner(std::uint32_t body) const {
    return work.bodies.velocity[body].inverse_mass > 0 ? work.mechanisms.owner(body) : kNone;
  }
  /// Whether a point starts cold because it is deep: what squeezes a body from two sides braces itself, and if one side
  /// goes, the other would shoot the body away.
  PLUMB_HD bool is_let_go(const ManifoldPoint& point) const {
    const StepParameters& step = *work.parameters;
    return step.lets_go && point.separation * step.contact.bias_rate < -kDeepSpeed;
  }
  /// Impulses of points that are still there; those across the normal keep their direction in the world.
  PLUMB_HD void remember(const CachedManifold& old, const Manifold& found, CachedManifold& kept) const {
    if (old.colour < kOverflow && old.owner_a == kept.owner_a && old.owner_b == kept.owner_b) kept.colour = old.colour;
    const Vec old_bitangent = cross(old.normal, old.tangent), bitangent = cross(kept.normal, kept.tangent);
    for (std::uint32_t i = 0; i < kept.count; ++i)
      for (std::uint32_t j = 0; j < old.count; ++j) {
        if (kept.feature[i] != old.feature[j] || is_let_go(found.points[i])) continue;
        const Vec friction = old.tangent_impulse[0][j] * old.tangent + old.tangent_impulse[1][j] * old_bitangent;
        // Impulses of a body that came out not finite must not reach the next step.
        const bool sane = is_finite(friction) && is_finite(old.normal_impulse[j]);
        kept.normal_impulse[i] = sane ? old.normal_impulse[j] : 0;
        kept.tangent_impulse[0][i] = sane ? dot(friction, kept.tangent) : 0;
        kept.tangent_impulse[1][i] = sane ? dot(friction, bitangent) : 0;
        break;
      }
  }
};

}  // namespace

void match(Executor& executor, const MatchWork& work, std::uint32_t capacity) {
  executor.run(Count{&work.counters->manifolds, capacity}, Match{work});
}

}  // namespace plumb::impulse
