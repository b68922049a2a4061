#include "contacts/match.hpp"

#include "contacts/contact_normals.hpp"
#include "exec/atomic.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

/// Cosine of the angle between the normals of two contacts up to which they touch the same side of a surface.
constexpr Real kSameSide = Real(0.99);

/// Impulses of points that are still there; those across the normal keep their direction in the world.
class Remembered {
 public:
  PLUMB_HD Remembered(CachedManifold& kept, const Manifold& found, const StepParameters* parameters)
      : kept_(kept), found_(found), step_(*parameters), wanting_((1U << found.count) - 1) {}

  /// Whether there are points that nothing was remembered of.
  [[nodiscard]] PLUMB_HD bool is_wanting() const { return wanting_ != 0; }
  PLUMB_HD void add_if_same_side(const CachedManifold& old) {
    if (is_wanting() && dot(old.normal, kept_.normal) > kSameSide) add(old);
  }
  PLUMB_HD void add(const CachedManifold& old) {
    const Vec old_bitangent = cross(old.normal, old.tangent), bitangent = cross(kept_.normal, kept_.tangent);
    for (std::uint32_t i = 0; i < kept_.count; ++i)
      for (std::uint32_t j = 0; j < old.count && (wanting_ >> i & 1U) != 0; ++j) {
        if (kept_.feature[i] != old.feature[j] || is_let_go(found_.points[i])) continue;
        const Vec friction = old.tangent_impulse[0][j] * old.tangent + old.tangent_impulse[1][j] * old_bitangent;
        // Impulses of a body that came out not finite must not reach the next step.
        const bool sane = is_finite(friction) && is_finite(old.normal_impulse[j]);
        kept_.normal_impulse[i] = sane ? old.normal_impulse[j] : 0;
        kept_.tangent_impulse[0][i] = sane ? dot(friction, kept_.tangent) : 0;
        kept_.tangent_impulse[1][i] = sane ? dot(friction, bitangent) : 0;
        wanting_ &= ~(1U << i);
        if (is_finite(old.moment)) kept_.moment = old.moment;
      }
  }

 private:
  /// Whether a point starts cold because it is deep: what squeezes a body from two sides braces itself, and if one side
  /// goes, the other would shoot the body away.
  [[nodiscard]] PLUMB_HD bool is_let_go(const ManifoldPoint& point) const {
    return step_.lets_go && point.separation * step_.contact.bias_rate < -kDeepSpeed;
  }

  CachedManifold& kept_;
  const Manifold& found_;
  const StepParameters& step_;
  std::uint32_t wanting_;  ///< a bit a point
};

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
    kept.moment = {0, 0, 0};
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
    Remembered remembered(kept, found, work.parameters);
    if (old != nullptr) {
      if (old->colour < kOverflow && old->owner_a == kept.owner_a && old->owner_b == kept.owner_b)
        kept.colour = old->colour;
      remembered.add(*old);
    }
    if (cache.triangles != nullptr && remembered.is_wanting()) ask_other_pieces(pair, candidate, remembered);
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
  /// What a point remembers of the triangle that it has come from: the other pieces of a pair that were touched from
  /// the same side in the last step.
  PLUMB_HD void ask_other_pieces(Pair pair, std::uint32_t candidate, Remembered& remembered) const {
    const auto& [cache, last, woken, bodies, proxies, parameters, counters, mechanisms, masks] = work;
    if (!has_surface(proxies, pair)) return;
    const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];
    if (a.first_step == parameters->step || b.first_step == parameters->step) return;
    const std::uint32_t owners[2] = {pair.a, pair.b};
    for (const std::uint32_t owner : owners) {
      const PairRange range = last.ranges[owner];
      for (std::uint32_t p = range.first; p < range.first + range.count; ++p)
        if (is_same(last.pairs[p], pair) && last.touching[p] != 0 && p != cache.previous[candidate])
          remembered.add_if_same_side(last.kept[last.row[p]]);
    }
  }
};

}  // namespace

void match(Executor& executor, const MatchWork& work, std::uint32_t capacity) {
  executor.run(Count{&work.counters->manifolds, capacity}, Match{work});
}

}  // namespace plumb::impulse
