// How many sub-steps a step has: as many as the setting says, and twice as many again and again where loads ask for it
// and the world is small enough.
//
// A contact that is solved once in a sub-step can be no stiffer than the lighter body lets it: its frequency is a share
// of the sub-steps' own (plugin/settings.cpp). What presses on the lighter body with a force F and comes from beyond it
// lowers it by F / (m w^2), and rocks it: seen from its size r such a load has the frequency sqrt(F / (m r)), and
// sub-steps must be shorter in proportion. Tension in joints asks for nothing: tension.hpp deals with it, and what
// swings gains where the number changes with each swing.
//
// Only what was asked lives on, and fades within a second (plugin/world.cpp): the number may change from step to step.
#pragma once

#include "bodies/mechanism.hpp"
#include "bodies/step_counters.hpp"
#include "exec/atomic.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// Sub-steps in the time that a load's frequency takes for a radian: between bodies by themselves, and of bodies that
/// joints hold.
inline constexpr Real kSubstepsOfContact = 40, kSubstepsOfMechanism = 14;
/// What weighs no more than so many times as much as the body that bears it asks for nothing, nor does a load no larger
/// than so many times a body's own weight: piles do well as it is.
inline constexpr Real kAlikeMasses = 5;
/// A body presses on another by itself with no more than so many times its weight, with what lies on it: more is a
/// blow.
inline constexpr Real kMostWeights = 8;
/// A contact that asks for so many times the most that there can be would do no better with those, and gets none: the
/// pebble under the wheel of a truck.
inline constexpr Real kHopeless = 4;
/// Sub-steps times contacts beyond which there are no more sub-steps: they are for tens of machines, and not for a pile
/// of thousands. A joint takes as long as so many contacts.
inline constexpr std::uint32_t kMostWork = 16384, kWorkOfJoint = 8;

/// What is loaded, at the start of a step.
struct LoadWork {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  Mechanisms mechanisms;
  const ShorterSubsteps* shorter;
  StepParameters* parameters;
  StepCounters* counters;

  /// Whether there are shorter sub-steps to choose.
  PLUMB_HD bool asks() const { return shorter->count > 1 && allows(1); }
  /// Whether the world is small enough for the sub-steps of that number.
  PLUMB_HD bool allows(std::uint32_t k) const {
    return counters->manifolds + shorter->work_of_joints <= kMostWork / shorter->of[k].substeps;
  }
  PLUMB_HD Real most() const { return static_cast<Real>(shorter->of[shorter->count - 1].substeps); }
  PLUMB_HD void ask(Real substeps) const {
    const auto asked = static_cast<std::uint32_t>(min(substeps, most()));
    if (asked > shorter->of[0].substeps) atomic_max(&counters->asked_substeps, asked);
  }
};

/// For the contact in a row of the cache: by the force of the last step, or where it is new by the weight that may come
/// to rest there.
struct AskForContact {
  LoadWork work;

  PLUMB_HD void operator()(std::uint32_t row) const {
    if (!work.asks()) return;
    const Pair pair = work.cache.pairs[work.cache.candidate[row]];
    const Proxy &a = work.proxies.rows[pair.a], &b = work.proxies.rows[pair.b];
    const CachedManifold& kept = work.cache.kept[row];
    Real impulse = 0;
    for (std::uint32_t p = 0; p < kept.count; ++p) impulse = impulse + kept.normal_impulse[p];
    const Real force = work.shorter->inverse_last_h * impulse;
    const Real downward = dot(work.parameters->gravity, kept.normal);
    ask(force, downward, b, a);
    ask(force, -downward, a, b);
  }

 private:
  /// Of the force by which one body presses on another. downward: gravity along that way, m/s2.
  PLUMB_HD void ask(Real force, Real downward, const Proxy& on, const Proxy& by) const {
    const Mechanisms& mechanisms = work.mechanisms;
    const Real own = work.bodies.velocity[on.body].inverse_mass, others = work.bodies.velocity[by.body].inverse_mass;
    const bool joined = mechanisms.hold(on.body), in_one = joined || mechanisms.hold(by.body);
    if (!in_one && !(others > 0)) return;  // what lies on the ground is asked where it is loaded
    const Real lighter = in_one ? own : own - kAlikeMasses * others;
    if (!(lighter > 0)) return;
    const Real weight = others > 0 ? max(downward, Real(0)) / others : Real(0);
    Real load = force > 0 ? force : weight;
    if (!in_one) load = min(load, kMostWeights * weight);
    load = load - kAlikeMasses * length(work.parameters->gravity) / own;
    if (!(load > 0)) return;
    const Real squared = lighter / work.proxies.shapes[on.shape].reach;
    const Real per_frequency = work.parameters->dt * (joined ? kSubstepsOfMechanism : kSubstepsOfContact);
    if (per_frequency * sqrt(max(load, weight) * squared) > kHopeless * work.most()) return;
    work.ask(per_frequency * sqrt(load * squared));
  }
};

struct ChooseSubsteps {
  LoadWork work;

  PLUMB_HD void operator()(std::uint32_t) const {
    const ShorterSubsteps& shorter = *work.shorter;
    const Real asked = max(shorter.asked_before, static_cast<Real>(work.counters->asked_substeps));
    std::uint32_t k = 0;
    while (k + 1 < shorter.count && static_cast<Real>(shorter.of[k].substeps) < asked && work.allows(k + 1)) ++k;
    static_cast<SubstepParameters&>(*work.parameters) = shorter.of[k];
    work.counters->substeps = shorter.of[k].substeps;
  }
};

}  // namespace plumb::impulse
