// What a step counts on the device while it runs.
#pragma once

#include <cstdint>

#include "math/real.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kColours = 64;         // bits of a body's mask
constexpr std::uint32_t kOverflow = kColours;  // the "colour" of constraints that found none: solved one by one

struct StepCounters {
  std::uint32_t pairs;  ///< candidates found; more than there is room for: the step does nothing and is repeated
  std::uint32_t midphase_pairs;  ///< of these, where there are planes, meshes or height fields (midphase.hpp)
  std::uint32_t manifolds;       ///< of these, touching
  std::uint32_t points;
  std::uint32_t uncoloured[3];                  ///< manifolds without a colour: this round, the next, the one after
  std::uint32_t rounds;                         ///< of the colouring
  std::uint32_t about_to_strike[2];             ///< the last even and odd sub-steps, less one, that saw impacts come
  std::uint32_t struck;                         ///< the last round of impacts in which anything was
  std::uint32_t first_in_colour[kColours + 2];  ///< place in the order by colour; the last is the number of manifolds
  std::uint32_t first_slot[kColours + 2];       ///< solver rows of a colour begin here, a multiple of the lanes
  std::uint32_t colour_count;                   ///< colours up to the last one in use; the overflow apart
  std::uint32_t longest_loop;                   ///< threads of the longest loop over contacts
  std::uint32_t substeps, asked_substeps;       ///< of this step, and what its loads asked for (choose_substeps.hpp)
  std::uint32_t passes;  ///< over the constraints, of the solvers that make them until it is enough
  std::uint32_t
      touched_sleepers;      ///< manifolds with somebody awake: the step does nothing, they wake, and it is repeated
  std::uint32_t gained;      ///< islands that gained more energy than they may (solver/energy_bound.hpp)
  std::uint32_t let_go;      ///< joints of which rows have not held as predicted (joints/joint_axis_solve.hpp)
  std::uint32_t taken_back;  ///< because of either all is as it was before the step
  std::uint32_t nonfinite;   ///< bodies that came out not finite and were put back
};

/// The step did nothing and comes again, because there was too little room for the pairs or somebody must wake first;
/// or it was taken back.
PLUMB_HD inline bool is_undone(const StepCounters& counters, std::uint32_t pair_capacity) {
  return counters.pairs > pair_capacity || counters.touched_sleepers != 0 || counters.taken_back != 0;
}

}  // namespace plumb::impulse
