// Contacts of bodies that must not pass through others however fast they are, and of round ones that bounce.
//
// What is round touches elsewhere, and with another normal, than where it was nearest when the step began. And where a
// body that must not pass goes further in a step than the narrow phase foresees contacts, the time of impact is found
// for its pairs, and the manifold of the poses at that time stands for the pair: a constraint of the same solver, like
// any contact that is not closed yet. So a bullet that is stopped gives up its momentum, rubs and bounces as others do,
// and no time is lost.
#pragma once

#include "bodies/body.hpp"
#include "continuous/impact.hpp"
#include "exec/executor.hpp"
#include "narrowphase/narrow_phase_work.hpp"

namespace plumb::impulse {

class Impacts {
 public:
  void reserve(std::uint32_t pairs) { times_.grow(pairs); }

  /// When the narrow phase, which has looked at the pairs as they lie, is to look at them again. uses_midphase: there
  /// may be planes and surfaces among the shapes.
  void find(Executor& executor, Count candidates, const NarrowPhaseWork& work, bool uses_midphase);

  /// By candidate: when those come near each other that are to be collided then, or have been.
  [[nodiscard]] PairTime* times() { return times_.data(); }

 private:
  Buffer<PairTime> times_;
};

}  // namespace plumb::impulse
