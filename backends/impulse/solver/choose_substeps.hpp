// How many sub-steps an island has: as many as the setting says, and twice as many again and again where its loads ask
// for it and it is small enough. What one island asks for is no matter to others, unless so many ask at once that none
// could have it in time.
//
// A contact that is solved once in a sub-step can be no stiffer than the lighter body lets it: its frequency is a share
// of the sub-steps' own (plugin/settings.cpp). What presses on the lighter body with a force F and comes from beyond it
// lowers it by F / (m w^2), and rocks it: seen from its size r such a load has the frequency sqrt(F / (m r)), and
// sub-steps must be shorter in proportion. What is no heavier than kAlikeMasses times what bears it asks for nothing,
// nor does a load of no more than so many times a body's own weight: piles do well as it is. But a column of like
// bodies buckles where it is high (columns.hpp), and many on a light one take more relaxing passes (stars.hpp). Bodies
// of one mechanism that its joints squeeze ask for nothing beyond the weight of them, nor what is squeezed between
// walls or what the host moves beyond its own: the contact would stiffen by what it presses, and press the harder for
// it, until it throws them.
//
// A light link under tension swings faster than a sub-step can follow. It would be given a larger inertia
// (joints/tension.hpp), and heavier links that come and go with the tension make energy; so sub-steps are short enough
// that it keeps its own, as far as kMostByTension times as many do that.
//
// Bodies that touch or are joined are of one island and go through its sub-steps together; no contact and no joint is
// between two islands, so that one may be solved after the other; what the host moves goes through the step with each.
// What was asked lives on in the bodies, and fades within a second: loads that come and go would pump, but the number
// may change from step to step.
#pragma once

#include "bodies/body_level.hpp"
#include "bodies/mechanism.hpp"
#include "bodies/step_counters.hpp"
#include "exec/executor.hpp"
#include "joints/joint.hpp"
#include "narrowphase/contact_cache.hpp"
#include "solver/settled_islands.hpp"
#include "solver/stars.hpp"

namespace plumb::impulse {

/// Of a body, and at the root of an island of the island.
struct IslandLoad {
  std::uint32_t parent, root;
  std::uint32_t asked;      ///< sub-steps: bits of a float
  std::uint32_t rate;       ///< the largest of its bodies' load_rate: likewise
  std::uint32_t work;       ///< what a sub-step takes, in contacts
  std::uint32_t wants;      ///< level
  Star star;                ///< with the body as its hub
  std::uint32_t star_size;  ///< of the largest
};

struct LoadWork {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  Mechanisms mechanisms;
  const Joint* joints;
  std::uint32_t joint_count, body_count, pair_capacity;
  const SubstepLevels* levels;
  const StepParameters* parameters;
  StepCounters* counters;
  BodyPace* paces;             ///< by body
  BodyLevel* body_levels;      ///< by body
  IslandLoad* loads;           ///< by body
  std::uint32_t* body_groups;  ///< of each level, and of kEveryLevel, room for `most_groups`, of motion_lanes.hpp
  std::uint32_t most_groups;
  const std::uint64_t* masks;  ///< by body: Colouring::masks() of the contacts that were there before
  const SettledBody* settled;  ///< by body, in a step that is gone over again; null: none is
  const Real* least_moments;   ///< by body: JointView::least_moment, as of its last sub-step
  bool gyroscopic;
};

/// contacts: how many manifolds there are.
void enqueue_levels(Executor& executor, const LoadWork& work, Count contacts);

}  // namespace plumb::impulse
