#include "solver/choose_substeps.hpp"

#include "bodies/axis_locks.hpp"
#include "bodies/motion_lanes.hpp"
#include "exec/atomic.hpp"
#include "exec/union_find.hpp"
#include "math/bits.hpp"
#include "math/ordered_bits.hpp"
#include "solver/columns.hpp"

namespace plumb::impulse {

namespace {

/// Sub-steps in the time that a load's frequency takes for a radian: between bodies by themselves, and of bodies that
/// joints hold.
constexpr Real kSubstepsOfContact = 40, kSubstepsOfMechanism = 14;
/// Tension asks for no more than so many times the fewest sub-steps: the lightest part of a machine is not worth more,
/// and has a larger inertia beyond that.
constexpr Real kMostByTension = 2;
/// A body presses on another by itself with no more than so many times its weight, with what lies on it: more is a
/// blow.
constexpr Real kMostWeights = 8;
/// What cannot be pushed bears a weight where this share of gravity and more is along the contact's normal; from the
/// side it squeezes.
constexpr Real kBears = Real(0.5);
/// A contact that asks for so many times the most that there can be would do no better with those, and gets none: the
/// pebble under the wheel of a truck.
constexpr Real kHopeless = 4;
/// Loads ask for whole multiples of that share of the fewest sub-steps: for a little more than there are nobody needs
/// twice as many.
constexpr Real kShares = 8;
/// A column that had more sub-steps keeps them until it wants so much less than that: it would be shaken by each
/// change.
constexpr Real kColumnStays = Real(0.85);
/// What columns ask for grows e-fold in no less than this, s: it sways as they take up their load.
constexpr Real kColumnGrows = 1;
/// Sub-steps times contacts beyond which there are no more sub-steps: they are for machines, and not for a pile of many
/// thousands; of an island, and of all that want so many or more: a crowd of figures does without, and one crane beside
/// them does not have to. A joint takes as long as so many contacts.
constexpr std::uint32_t kMostWork = 65536, kWorkOfJoint = 8;
/// A star that is shaken asks for sub-steps, up to this level; it rests where it has relaxations instead.
constexpr std::uint32_t kShakenLevel = 1;
/// What was asked is forgotten within that time, s.
constexpr Real kLoadFades = 1;
/// What asks for so much more than there is, relative to that, has it.
constexpr Real kAsksEnough = Real(1e-5);

struct LoadParents {
  IslandLoad* loads;
  PLUMB_HD std::uint32_t* operator()(std::uint32_t i) const { return &loads[i].parent; }
};

struct ChooseLevels {
  LoadWork work;

  PLUMB_DEVICE void operator()(Team& team) const {
    StepCounters* const counters = work.counters;
    if (is_undone(*counters, work.pair_capacity)) return;
    const ChooseLevels self = *this;
    const std::uint32_t bodies = work.body_count;
    team.each(bodies, [self](std::uint32_t i) { self.begin(i); });
    team.each(counters->manifolds, [self](std::uint32_t row) { self.ask_for_contact(row); });
    team.barrier();
    const bool any_asks = counters->levels.loaded != 0,
               any_settled = work.settled != nullptr && work.parameters->is_repeat;
    if (any_asks)
      choose_for_islands(team);
    else
      team.single([self] { self.note_levels(0); });
    if (any_settled) team.each(bodies, [self](std::uint32_t i) { self.leave_settled_out(i); });
    if (any_asks || any_settled) team.each(body_groups(bodies), [self](std::uint32_t group) { self.list(group); });
  }

 private:
  PLUMB_DEVICE void choose_for_islands(Team& team) const {
    const StepCounters* const counters = work.counters;
    const ChooseLevels self = *this;
    const std::uint32_t bodies = work.body_count;
    team.each(counters->manifolds, [self](std::uint32_t row) { self.join_contact(row); });
    team.each(work.joint_count, [self](std::uint32_t j) { self.join_joint(j); });
    team.each(bodies, [self](std::uint32_t i) { self.find_root(i); });
    team.each(counters->manifolds, [self](std::uint32_t row) { self.add_contact(row); });
    team.each(work.joint_count, [self](std::uint32_t j) { self.add_joint(j); });
    team.each(bodies, [self](std::uint32_t i) { self.want(i); });
    team.each(bodies, [self](std::uint32_t i) { self.choose(i); });
  }
  PLUMB_HD Real substeps(std::uint32_t level) const { return static_cast<Real>(work.levels->of[level].substeps); }
  PLUMB_HD bool is_pushed(std::uint32_t body) const {
    return body != kWorld && work.bodies.velocity[body].inverse_mass > 0;
  }

  PLUMB_HD void begin(std::uint32_t i) const {
    const BodyPace before = work.paces[i];
    const bool pushed = is_pushed(i);
    const Real rate = pushed ? before.load_rate : Real(0),
               asked = pushed ? asked_by_tension(i, before.last_h) : Real(0);
    work.loads[i] = {i, i, ordered_bits(asked), ordered_bits(rate), 0, 0, {}, 0};
    note_asked(max(asked, rate * work.parameters->dt));
    if (pushed && before.last_h != work.levels->of[0].h) atomic_raise(&work.counters->levels.other_substeps, 1U);
    put_level(i, is_kinematic(work.bodies.mass[i]) ? kEveryLevel : 0, before, 0, 0);
  }
  /// Sub-steps in each of which what tension turns back turns by no more than a radian, where that are more than the
  /// fewest: its own moments are no less then than what tension asks of them.
  PLUMB_HD Real asked_by_tension(std::uint32_t i, Real last_h) const {
    if (work.joint_count == 0 || !(last_h > 0) || !work.mechanisms.hold(i)) return 0;
    const Vec inverse = inverse_moments(work.bodies.mass[i], work.gyroscopic);
    const Real ratio = work.least_moments[i] * max(max(inverse.x, inverse.y), inverse.z);
    const Real asked = min(work.parameters->dt / last_h * sqrt(ratio), kMostByTension * substeps(0));
    return asked > substeps(0) ? asked : Real(0);
  }
  PLUMB_HD void note_asked(Real asked) const {
    if (asked > substeps(0) && work.levels->count > 1) atomic_raise(&work.counters->levels.loaded, 1U);
  }

  /// For the contact in a row of the cache: by the force of the last step, or where it is new by the weight that may
  /// come to rest there.
  PLUMB_HD void ask_for_contact(std::uint32_t row) const {
    if (work.levels->count <= 1) return;
    const Pair pair = work.cache.pairs[work.cache.candidate[row]];
    const Proxy &a = work.proxies.rows[pair.a], &b = work.proxies.rows[pair.b];
    const CachedManifold& kept = work.cache.kept[row];
    const Real downward = dot(work.parameters->gravity, kept.normal);
    ask(kept, downward, b, a);
    ask(kept, -downward, a, b);
    add_spoke(downward, b.body, a.body);
    add_spoke(-downward, a.body, b.body);
    if (is_column(a.body) && is_column(b.body) && are_alike(a.body, b.body))
      ask_for_column(row, downward, downward > 0 ? b.body : a.body, downward > 0 ? a.body : b.body);
  }
  /// Whether a body has no contact but one above and one below. Others are held by those beside them.
  PLUMB_HD bool is_column(std::uint32_t body) const {
    return is_pushed(body) && !work.mechanisms.hold(body) && bit_count(work.masks[body]) <= 2;
  }
  PLUMB_HD bool are_alike(std::uint32_t a, std::uint32_t b) const {
    const Velocity* const all = work.bodies.velocity;
    return alike_masses(all[a].inverse_mass, all[b].inverse_mass);
  }
  /// What is known of the column above in one step is known one body further down in the next.
  PLUMB_HD void ask_for_column(std::uint32_t row, Real downward, std::uint32_t on, std::uint32_t by) const {
    const Real gravity = length(work.parameters->gravity);
    if (!(max(downward, -downward) > kColumnUpright * gravity)) return;
    const Velocity* const all = work.bodies.velocity;
    const Real above = number_of(work.body_levels[by].before.column) + Real(1) / all[by].inverse_mass;
    atomic_max(&work.paces[on].column, ordered_bits(above));
    const CachedManifold& kept = work.cache.kept[row];
    const Manifold& found = work.cache.found[work.cache.candidate[row]];
    const Real n = above * all[on].inverse_mass;
    if (!(n > kLeastColumn) || found.count < 3) return;
    const Real apart = dot(between(work.bodies.position[by], work.bodies.position[on]), kept.normal);
    const ContactPatch patch = patch_of(found, kept);
    if (!(patch.gyration2 > 0)) return;
    const Real most = substeps(work.levels->count - 1);
    const Real wanted = work.parameters->dt * column_rate(n, max(apart, -apart), gravity, patch);
    if (!(wanted > kColumnStays * substeps(0)) || wanted > kHopeless * most) return;
    atomic_max(&work.loads[on].asked, ordered_bits(min(as_before(on, wanted), most)));
    atomic_raise(&work.counters->levels.loaded, 1U);
  }
  /// Sub-steps wanted for a column: what was enough for the next lower level by a little is what it had; and no load is
  /// one that has just come.
  PLUMB_HD Real as_before(std::uint32_t body, Real wanted) const {
    const BodyPace& before = work.body_levels[body].before;
    const Real dt = work.parameters->dt, last = max(dt * before.load_rate, substeps(0) / 2);
    for (std::uint32_t level = 1; level < work.levels->count; ++level) {
      const Real below = substeps(level - 1);
      if (before.last_h < (1 + kAsksEnough) * work.levels->of[level].h && wanted > kColumnStays * below)
        wanted = max(wanted, (1 + 2 * kAsksEnough) * below);
    }
    return min(wanted, (1 + dt / kColumnGrows) * last);
  }
  /// downward: gravity along the way from one body to the other, m/s2.
  PLUMB_HD void add_spoke(Real downward, std::uint32_t on, std::uint32_t by) const {
    const Velocity* const all = work.bodies.velocity;
    const Real own = all[on].inverse_mass, others = all[by].inverse_mass;
    if (!(others > 0 && own > kLeastSpoke * others && downward > kSpokeUpright * length(work.parameters->gravity)))
      return;
    if (work.loads[on].star.add(own / others)) atomic_raise(&work.counters->levels.loaded, 1U);
  }
  /// By which two bodies pressed on each other in the last step.
  PLUMB_HD Real force_of(const CachedManifold& kept, std::uint32_t a, std::uint32_t b) const {
    Real impulse = 0;
    for (std::uint32_t p = 0; p < kept.count; ++p) impulse = impulse + kept.normal_impulse[p];
    const auto last_h = [&](std::uint32_t i) { return is_pushed(i) ? work.body_levels[i].before.last_h : Real(0); };
    const Real h = max(last_h(a), last_h(b));
    return h > 0 ? impulse / h : Real(0);
  }
  /// Of the force by which one body presses on another. downward: gravity along that way, m/s2.
  PLUMB_HD void ask(const CachedManifold& kept, Real downward, const Proxy& on, const Proxy& by) const {
    const Mechanisms& mechanisms = work.mechanisms;
    const Real own = work.bodies.velocity[on.body].inverse_mass, others = work.bodies.velocity[by.body].inverse_mass;
    const bool joined = mechanisms.hold(on.body), in_one = joined || mechanisms.hold(by.body);
    if (!in_one && !(others > 0)) return;  // what lies on the ground is asked where it is loaded
    const Real lighter = in_one ? own : own - kAlikeMasses * others;
    if (!(lighter > 0)) return;
    const Real gravity = length(work.parameters->gravity);
    const bool squeezed = !(others > 0) && max(downward, -downward) < kBears * gravity;
    const Real weight = squeezed ? gravity / own : others > 0 ? max(downward, Real(0)) / others : Real(0);
    const Real force = force_of(kept, on.body, by.body);
    Real load = force > 0 ? force : weight;
    if (!in_one || squeezed || mechanisms.together(on.body, by.body)) load = min(load, kMostWeights * weight);
    load = load - kAlikeMasses * gravity / own;
    if (!(load > 0)) return;
    const Real squared = lighter / work.proxies.shapes[on.shape].reach;
    const Real per_frequency = work.parameters->dt * (joined ? kSubstepsOfMechanism : kSubstepsOfContact);
    const Real most = substeps(work.levels->count - 1);
    if (per_frequency * sqrt(max(load, weight) * squared) > kHopeless * most) return;
    const Real shares = min(per_frequency * sqrt(load * squared), most) / substeps(0) * kShares;
    const Real asked = static_cast<Real>(static_cast<std::uint32_t>(shares)) / kShares * substeps(0);
    if (!(asked > substeps(0))) return;
    atomic_max(&work.loads[on.body].asked, ordered_bits(asked));
    note_asked(asked);
  }

  PLUMB_HD void join(std::uint32_t a, std::uint32_t b) const {
    if (is_pushed(a) && is_pushed(b)) unite(LoadParents{work.loads}, a, b);
  }
  PLUMB_HD void join_contact(std::uint32_t row) const {
    const Pair pair = work.cache.pairs[work.cache.candidate[row]];
    join(work.proxies.rows[pair.a].body, work.proxies.rows[pair.b].body);
  }
  PLUMB_HD void join_joint(std::uint32_t j) const { join(work.joints[j].body_a, work.joints[j].body_b); }
  /// What a body asks for its island does.
  PLUMB_HD void find_root(std::uint32_t i) const {
    const std::uint32_t at = impulse::find_root(LoadParents{work.loads}, i);
    IslandLoad &own = work.loads[i], &island = work.loads[at];
    own.root = at;
    if (own.star.size() != 0) atomic_raise(&island.star_size, own.star.size());
    if (at == i) return;
    if (own.asked != 0) atomic_max(&island.asked, own.asked);
    if (own.rate != 0) atomic_max(&island.rate, own.rate);
  }
  PLUMB_HD void add_work(std::uint32_t a, std::uint32_t b, std::uint32_t amount) const {
    const std::uint32_t body = is_pushed(b) ? b : a;
    if (is_pushed(body)) atomic_add(&work.loads[work.loads[body].root].work, amount);
  }
  PLUMB_HD void add_contact(std::uint32_t row) const {
    const Pair pair = work.cache.pairs[work.cache.candidate[row]];
    add_work(work.proxies.rows[pair.a].body, work.proxies.rows[pair.b].body, 1);
  }
  PLUMB_HD void add_joint(std::uint32_t j) const {
    add_work(work.joints[j].body_a, work.joints[j].body_b, kWorkOfJoint);
  }

  /// Of the root of an island: the level for it, were it alone.
  PLUMB_HD void want(std::uint32_t i) const {
    IslandLoad& island = work.loads[i];
    if (island.root != i) return;
    const SubstepLevels& levels = *work.levels;
    const Real asked = max(number_of(island.rate) * work.parameters->dt, number_of(island.asked));
    while (island.wants + 1 < levels.count && substeps(island.wants) * (1 + kAsksEnough) < asked &&
           island.work <= kMostWork / levels.of[island.wants + 1].substeps)
      ++island.wants;
    if (island.star_size != 0 && island.wants <= kShakenLevel) {
      std::uint32_t star = kStarLevel + island.star_size - 1;
      if (island.work > kMostWork / passes_of(star)) star = kStarLevel;
      if (island.work <= kMostWork / passes_of(star)) island.wants = star;
    }
    if (island.wants != 0) atomic_add(&work.counters->levels.wanted_work[island.wants], island.work);
  }
  /// Whether there is time for all who want a level, or one beyond.
  PLUMB_HD bool has_time_for(std::uint32_t level) const {
    std::uint32_t wanted = 0;
    for (std::uint32_t k = level; k < kSubstepLengths; ++k) wanted += work.counters->levels.wanted_work[k];
    return wanted <= kMostWork / work.levels->of[level].substeps;
  }
  PLUMB_HD bool has_time_for_stars() const {
    std::uint32_t wanted = 0;
    for (std::uint32_t k = kStarLevel; k < kSubstepLevels; ++k)
      wanted += min(work.counters->levels.wanted_work[k], kMostWork) * passes_of(k);
    return wanted <= kMostWork;
  }
  /// Over the contacts in a step; elsewhere a sub-step has two, which count as one.
  PLUMB_HD std::uint32_t passes_of(std::uint32_t star) const {
    const SubstepParameters& level = work.levels->of[star];
    return level.substeps * (1 + level.relaxations) / 2;
  }
  PLUMB_HD void choose(std::uint32_t i) const {
    if (!is_pushed(i)) return note_levels(0);
    const IslandLoad& island = work.loads[work.loads[i].root];
    std::uint32_t level = island.wants;
    if (level >= kStarLevel && !has_time_for_stars()) level = 0;
    while (level != 0 && level < kStarLevel && !has_time_for(level)) --level;
    if (level != 0 || island.asked != 0)
      put_level(i, level, work.body_levels[i].before, number_of(island.asked), work.paces[i].column);
    note_levels(level);
  }
  /// before: its pace; asked: what the loads of its island do; column: as of BodyPace.
  PLUMB_HD void put_level(std::uint32_t i, std::uint32_t level, const BodyPace& before, Real asked,
                          std::uint32_t column) const {
    const Real dt = work.parameters->dt, h = work.levels->of[level < kSubstepLevels ? level : 0].h;
    const Real rate = max(asked / dt, max(Real(0), 1 - dt / kLoadFades) * before.load_rate);
    // Who sleeps keeps impulses of his last step.
    work.paces[i] = {rate, is_pushed(i) ? h : before.last_h, column};
    work.body_levels[i] = {level, before.last_h > 0 ? h / before.last_h : Real(1), before};
  }
  PLUMB_HD void note_levels(std::uint32_t level) const {
    atomic_raise(&work.counters->levels.count, level + 1);
    atomic_raise(&work.counters->levels.substeps, work.levels->of[level].substeps);
  }
  /// With a second level, if it be empty, each body is asked for its own.
  PLUMB_HD void leave_settled_out(std::uint32_t i) const {
    if (!work.settled[i].is_settled) return;
    work.body_levels[i].level = kSettledLevel;
    atomic_raise(&work.counters->levels.count, 2U);
  }
  /// Among the groups of the levels that its bodies have.
  PLUMB_HD void list(std::uint32_t group) const {
    std::uint32_t found = 0;  // bits
    for (std::uint32_t i = group * kLanes; i < min(work.body_count, (group + 1) * kLanes); ++i)
      if ((work.bodies.mass[i].flags & kBodyMoves) != 0) found |= 1U << work.body_levels[i].level;
    for (std::uint32_t level = 0; level <= kEveryLevel; ++level)
      if ((found >> level & 1U) != 0)
        work.body_groups[level * work.most_groups + atomic_add(&work.counters->levels.body_groups[level], 1U)] = group;
  }
};

}  // namespace

void enqueue_levels(Executor& executor, const LoadWork& work, Count contacts) {
  executor.team(contacts, work.body_count, ChooseLevels{work});
}

}  // namespace plumb::impulse
