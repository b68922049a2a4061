#include "world/validate.hpp"

#include "exec/atomic.hpp"
#include "plumb/assert.hpp"
#include "world/step_context.hpp"

namespace plumb::impulse {

namespace {

[[maybe_unused]] PLUMB_HD inline bool same(const Position& x, const Position& y) {
  return x.x == y.x && x.y == y.y && x.z == y.z;
}
[[maybe_unused]] PLUMB_HD inline bool same(const Quat& x, const Quat& y) {
  return x.x == y.x && x.y == y.y && x.z == y.z && x.w == y.w;
}

struct RememberStill {
  Bodies bodies;
  Position* position;
  Quat* orientation;
  PLUMB_HD void operator()(std::uint32_t body) const {
    position[body] = bodies.position[body];
    orientation[body] = bodies.orientation[body];
  }
};

/// By mover: the pairs that it found.
struct CheckPairs {
  const Pair* pairs;
  const PairRange* ranges;
  ProxyRows movers;
  PairFilter filter;
  const Box* boxes;
  const StepCounters* counters;
  std::uint32_t capacity;

  PLUMB_HD void operator()(std::uint32_t i) const {
    if (counters->pairs > capacity) return;
    const std::uint32_t mover = movers[i];
    const PairRange range = ranges[mover];
    PLUMB_ASSERT(range.first + range.count <= counters->pairs);
    for (std::uint32_t p = range.first; p < range.first + range.count; ++p) {
      const Pair pair = pairs[p];
      PLUMB_ASSERT(pair.a == mover || pair.b == mover);
      PLUMB_ASSERT(filter(pair.a, pair.b));
      PLUMB_ASSERT(overlap(boxes[pair.a], boxes[pair.b]));
      for (std::uint32_t q = range.first; q < p; ++q) PLUMB_ASSERT(pairs[q].a != pair.a || pairs[q].b != pair.b);
    }
  }
};

/// By row of the contact cache.
struct CheckManifold {
  ContactCache cache;
  Proxies proxies;
  const StepCounters* counters;
  std::uint32_t candidates;  // room for them

  PLUMB_HD void operator()(std::uint32_t row) const {
    const std::uint32_t candidate = cache.candidate[row];
    PLUMB_ASSERT(candidate < candidates);
    PLUMB_ASSERT(cache.touching[candidate] == 1);
    PLUMB_ASSERT(cache.row[candidate] == row);
    const Pair pair = cache.pairs[candidate];
    PLUMB_ASSERT(proxies.rows[pair.a].shape != kNone);
    PLUMB_ASSERT(proxies.rows[pair.b].shape != kNone);
    const Manifold& found = cache.found[candidate];
    [[maybe_unused]] const CachedManifold& kept = cache.kept[row];
    PLUMB_ASSERT(found.count >= 1 && found.count <= static_cast<std::uint32_t>(kManifoldPoints));
    PLUMB_ASSERT(kept.count == found.count);
    PLUMB_ASSERT(abs(length_squared(found.normal) - 1) < Real(1e-3));
    PLUMB_ASSERT(abs(dot(kept.normal, kept.tangent)) < Real(1e-3));
    for (std::uint32_t p = 0; p < found.count; ++p) {
      PLUMB_ASSERT(is_finite(found.points[p].position));
      PLUMB_ASSERT(is_finite(found.points[p].separation));
      PLUMB_ASSERT(kept.normal_impulse[p] >= 0 && is_finite(kept.normal_impulse[p]));
    }
  }
};

struct ClearColours {
  std::uint64_t* colours;
  PLUMB_HD void operator()(std::uint32_t body) const { colours[body] = 0; }
};

struct CheckColour {
  ContactCache cache;
  std::uint64_t* colours;

  PLUMB_HD void operator()(std::uint32_t row) const {
    const CachedManifold& kept = cache.kept[row];
    PLUMB_ASSERT(kept.colour <= kOverflow);
    if (kept.colour == kOverflow) return;
    claim(kept.owner_a, kept.colour);
    // Of two bodies of one mechanism the mechanism is pushed once.
    if (kept.owner_b != kept.owner_a) claim(kept.owner_b, kept.colour);
  }

 private:
  PLUMB_HD void claim(std::uint32_t owner, std::uint32_t colour) const {
    if (owner == kNone) return;
    const std::uint64_t bit = std::uint64_t{1} << colour;
    [[maybe_unused]] const std::uint64_t before = atomic_or(&colours[owner], bit);
    PLUMB_ASSERT((before & bit) == 0);
  }
};

struct CheckBody {
  Bodies bodies;
  const Position* position;
  const Quat* orientation;

  PLUMB_HD void operator()(std::uint32_t body) const {
    [[maybe_unused]] const Velocity& velocity = bodies.velocity[body];
    if ((bodies.mass[body].flags & kBodyDynamic) != 0) {
      PLUMB_ASSERT(is_finite(velocity.linear) && is_finite(velocity.angular));
      [[maybe_unused]] const Quat& turn = bodies.orientation[body];
      PLUMB_ASSERT(abs(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z + turn.w * turn.w - 1) < Real(1e-3));
    }
    if ((bodies.mass[body].flags & kBodyMoves) != 0) return;
    PLUMB_ASSERT(same(bodies.position[body], position[body]));
    PLUMB_ASSERT(same(bodies.orientation[body], orientation[body]));
  }
};

/// Friction is held within the cone of the load under which it was solved; the pass that takes off what pushing out of
/// overlaps added may leave less load, and so says nothing of the cone.
struct CheckImpulses {
  ContactCache cache;

  PLUMB_HD void operator()(std::uint32_t row) const {
    const CachedManifold& kept = cache.kept[row];
    for (std::uint32_t p = 0; p < kept.count; ++p) PLUMB_ASSERT(!(kept.normal_impulse[p] < 0));
  }
};

}  // namespace

void remember_still(const StepContext& step) {
  if constexpr (!kAsserts) return;
  ValidationMemory& memory = step.stages.validation;
  step.executor.run(step.body_rows, RememberStill{step.bodies, memory.position.data(), memory.orientation.data()});
}

void validate_pairs(const StepContext& step) {
  if constexpr (!kAsserts) return;
  Stages& of = step.stages;
  step.executor.run(step.movers.count,
                    CheckPairs{step.uses_midphase ? of.midphase.pairs() : step.now.pairs,
                               step.uses_midphase ? of.midphase.ranges() : step.now.ranges, step.movers, step.filter,
                               of.boxes.data(), step.counters, step.pair_capacity});
}

void validate_manifolds(const StepContext& step) {
  if constexpr (!kAsserts) return;
  step.executor.run(Count{&step.counters->manifolds, step.pair_capacity},
                    CheckManifold{step.now, step.proxies, step.counters, step.pair_capacity});
}

void validate_colours(const StepContext& step) {
  if constexpr (!kAsserts) return;
  if (!step.stages.solver.needs_colours()) return;
  ValidationMemory& memory = step.stages.validation;
  step.executor.run(static_cast<std::uint32_t>(memory.colours.size()), ClearColours{memory.colours.data()});
  step.executor.run(Count{&step.counters->manifolds, step.pair_capacity}, CheckColour{step.now, memory.colours.data()});
}

void validate_bodies(const StepContext& step) {
  if constexpr (!kAsserts) return;
  const ValidationMemory& memory = step.stages.validation;
  step.executor.run(step.body_rows, CheckBody{step.bodies, memory.position.data(), memory.orientation.data()});
}

void validate_impulses(const StepContext& step) {
  if constexpr (!kAsserts) return;
  step.executor.run(Count{&step.counters->manifolds, step.pair_capacity}, CheckImpulses{step.now});
}

}  // namespace plumb::impulse
