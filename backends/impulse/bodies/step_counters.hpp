// What a step counts on the device while it runs.
#pragma once

#include <cstdint>

#include "bodies/step_parameters.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kColours = 35;         // bits of a body's mask
constexpr std::uint32_t kOverflow = kColours;  // the "colour" of constraints that found none: solved one by one
/// Contacts of a colour and of islands that have the same sub-steps are next to each other: what they are sorted by.
constexpr std::uint32_t kColourKeys = kSubstepLevels * (kColours + 1);
/// Behind them all: of contacts that are not solved.
constexpr std::uint32_t kSettledKey = kColourKeys;
static_assert(kSettledKey < 256);  // a byte, which a sort takes in one pass
PLUMB_HD constexpr std::uint32_t colour_key(std::uint32_t level, std::uint32_t colour) {
  return level * (kColours + 1) + colour;
}

/// Sub-steps in which impacts are solved at their time.
struct ImpactCounters {
  std::uint32_t about_to_strike[2];  ///< the last even and odd sub-steps, less one, that saw impacts come
  std::uint32_t struck;              ///< the last round of impacts in which anything was
};

/// Of sub-steps, which islands choose (choose_substeps.hpp).
struct LevelCounters {
  std::uint32_t wanted_work[kSubstepLevels];      ///< of islands that want a level: contacts
  std::uint32_t loaded;                           ///< not 0: something may ask for more sub-steps
  std::uint32_t other_substeps;                   ///< not 0: some have others than in their last step, or had none
  std::uint32_t count;                            ///< up to the last one in use
  std::uint32_t substeps;                         ///< of that one
  std::uint32_t body_groups[kSubstepLevels + 1];  ///< with bodies of a level, where there are several; or of all
};

/// Of what a step must not do to islands with joints (solver/energy_bound.hpp).
struct BoundCounters {
  std::uint32_t gained;      ///< islands that gained more energy than they may
  std::uint32_t let_go;      ///< joints of which rows have not held as predicted (joints/joint_axis_solve.hpp)
  std::uint32_t opened;      ///< islands of which it opened joints (solver/opened_joints.hpp): they try more sub-steps
  std::uint32_t still_open;  ///< likewise, and they have tried
  std::uint32_t taken_back;  ///< because of one of these all is as it was before the step
};

struct StepCounters {
  std::uint32_t pairs;  ///< candidates found; more than there is room for: the step does nothing and is repeated
  std::uint32_t midphase_pairs;  ///< of these, where there are planes, meshes or height fields (midphase.hpp)
  std::uint32_t manifolds;       ///< of these, touching
  std::uint32_t points;
  std::uint32_t uncoloured[3];  ///< manifolds without a colour: this round, the next, the one after
  std::uint32_t rounds;         ///< of the colouring
  ImpactCounters impacts;
  LevelCounters levels;
  std::uint32_t first_in_colour[kColourKeys + 1];  ///< by key: place in the order; the last: how many are solved
  std::uint32_t first_slot[kColourKeys + 1];       ///< by key: solver rows begin here, a multiple of the lanes
  std::uint32_t slots;                             ///< solver rows of all
  std::uint32_t colour_count[kSubstepLevels];  ///< of a level: colours up to the last one in use; the overflow apart
  std::uint32_t level_loop[kSubstepLevels];    ///< of a level: threads of the longest loop over contacts
  std::uint32_t longest_loop;                  ///< of all levels
  std::uint32_t passes;  ///< over the constraints, of the solvers that make them until it is enough
  std::uint32_t
      touched_sleepers;  ///< manifolds with somebody awake: the step does nothing, they wake, and it is repeated
  BoundCounters bound;
  std::uint32_t nonfinite;  ///< bodies that came out not finite and were put back
};

/// The step did nothing and comes again, because there was too little room for the pairs or somebody must wake first;
/// or it was taken back.
PLUMB_HD inline bool is_undone(const StepCounters& counters, std::uint32_t pair_capacity) {
  return counters.pairs > pair_capacity || counters.touched_sleepers != 0 || counters.bound.taken_back != 0;
}

}  // namespace plumb::impulse
