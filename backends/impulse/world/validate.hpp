// What must hold between the stages of a step, asked where kernels run: each function enqueues kernels of
// PLUMB_ASSERTs, and nothing where those are not compiled.
#pragma once

#include "bodies/body.hpp"
#include "exec/memory.hpp"

namespace plumb::impulse {

struct StepContext;

/// What is compared or counted for that.
struct ValidationMemory {
  void reserve(std::size_t bodies) {
    position.grow(bodies);
    orientation.grow(bodies);
    colours.grow(bodies);
  }
  Buffer<Position> position;      ///< by body: before the step
  Buffer<Quat> orientation;       ///< likewise
  Buffer<std::uint64_t> colours;  ///< by body: a bit for each colour in which it is pushed
};

/// Before all stages: remembers where those are that no step may move.
void remember_still(const StepContext& step);
/// After the broad phase: each pair overlaps, may touch, is found once, and lies in the range of one that finds it.
void validate_pairs(const StepContext& step);
/// After matching: manifolds are of candidates that touch, of living shapes, with unit normals and sound numbers.
void validate_manifolds(const StepContext& step);
/// After colouring: no two manifolds of a colour push the same body, or the same mechanism.
void validate_colours(const StepContext& step);
/// After all that moves bodies: all are finite, and those that no step may move, sleepers too, are where they were.
void validate_bodies(const StepContext& step);
/// At the end: normals push.
void validate_impulses(const StepContext& step);

}  // namespace plumb::impulse
