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
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// How far any point of a shape goes, at most, m.
PLUMB_HD inline Real travel(const MovingShape& shape, Real dt) {
  return dt * (length(shape.way.linear) + shape.reach() * length(shape.way.angular));
}

class Impacts {
 public:
  void reserve(std::uint32_t pairs) { times_.grow(pairs); }

  /// Between the narrow phase's look at the pairs and their numbering. margins: by proxy, what it looked ahead, m.
  /// uses_midphase: there may be planes and surfaces among the shapes.
  void find(Executor& executor, const ContactCache& cache, Count candidates, const Bodies& bodies,
            const Proxies& proxies, const Real* margins, const StepParameters* parameters, bool uses_midphase);

  /// By candidate: of those whose manifold is one of an impact its time in the step, s; else 0.
  [[nodiscard]] const Real* times() const { return times_.data(); }

 private:
  Buffer<Real> times_;
};

}  // namespace plumb::impulse
