// Graph colouring: no two manifolds of a colour share a body that they push, so that a colour can be solved all at
// once.
//
// Greedy colouring by rounds of random priorities (Jones and Plassmann, "A Parallel Graph Coloring Heuristic", SIAM J.
// Sci. Comput. 14, 1993), on the edges: in a round a manifold that has the best priority at both its bodies takes the
// lowest colour free at both. Colours are kept from step to step; only new manifolds go through rounds. The result
// depends on the order of the manifolds alone, not on threads.
//
//   C      round 0   all claim their bodies; A-B has the best priority at A and at B: colour 0; the others wait
//   |      round 1   g-A is alone at A now, B-C at B and C: both take colour 1, the lowest that is free
//   B
//   |      masks     A 11   B 11   C 10      bit c of a body's mask: some manifold of colour c pushes it
//   A
//   |      slots     A-B - - - - - - - | g-A B-C - - - - - - |      colour 0, colour 1, filled up to eight lanes
//   g      g is ground: it is not pushed, and any number of a colour may touch it
//
// Why colours, and not islands or batches by hand: what one colour holds can be worked on in any order, by lanes and
// threads and the blocks of a GPU, and the result is that of one thread that goes through the colours in turn. A pile
// is one island, but takes fewer colours than twice the contacts of its busiest body, as edges do that are coloured
// greedily.
//
// Why the bits do not depend on threads: a claim is a minimum (atomic_min), priorities are distinct (a permutation of
// the rows, and above it the round, so that claims of earlier rounds lose and nothing needs clearing), and who wins at
// both bodies is alone in writing their masks. In which order waiting manifolds are queued decides nothing. At last
// rows are sorted by colour, those of one colour in their own order; before that by the level of sub-steps of their
// islands, which have loops of their own. Of the waiting the best of all wins: rounds end.
//
// A manifold keeps its colour while it is there and pushes the same two (match.cpp puts it back, and its bits). A body
// has 35 colours: what finds none is of the overflow colour, is solved one by one after the others, and asks again in
// the next step. Bodies of a mechanism that contacts push as a whole are one here, by their owner
// (bodies/mechanism.hpp).
#pragma once

#include "bodies/body.hpp"
#include "bodies/body_level.hpp"
#include "bodies/mechanism.hpp"
#include "bodies/step_counters.hpp"
#include "exec/sort.hpp"
#include "math/wide.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

class Colouring {
 public:
  void reserve(Executor& executor, std::uint32_t bodies, std::uint32_t manifolds);

  /// Per body, or owner of a mechanism: bit c is set where a manifold of colour c pushes it. Cleared by begin();
  /// whoever keeps a manifold's old colour sets its bit.
  [[nodiscard]] std::uint64_t* masks() { return masks_.data(); }
  [[nodiscard]] const std::uint64_t* masks() const { return masks_.data(); }

  void begin(Executor& executor);
  /// Colours what has none in cache.kept[row].colour, then orders the rows: order()[j] is the row in place j by level
  /// and colour (and by row within them), keys()[j] its colour_key.
  /// Of mechanisms that contacts move as a whole no two manifolds of a colour push the same one.
  void colour(Executor& executor, const ContactCache& cache, const Velocity* velocities, const Proxy* proxies,
              const Mechanisms& mechanisms, const BodyLevels& levels, StepCounters* counters);

  /// Instead of colour(): all rows in one colour, in their own order, for a solver that needs none. Colours that
  /// manifolds have are kept for one that does.
  void leave_out(Executor& executor, StepCounters* counters);

  [[nodiscard]] const std::uint32_t* order() const { return sorted_rows_.data(); }
  [[nodiscard]] const std::uint32_t* keys() const { return sorted_keys_.data(); }

 private:
  std::uint32_t bodies_ = 0, capacity_ = 0;
  Buffer<std::uint64_t> masks_;   // by body
  Buffer<std::uint64_t> claims_;  // by body: best priority of a round
  Buffer<std::uint32_t> waiting_[2];
  Buffer<std::uint32_t> keys_, rows_, sorted_keys_, sorted_rows_;
  RadixSort<std::uint32_t> sort_;
};

/// Solver rows: places by level and colour, each colour rounded up to whole lanes.
constexpr std::uint32_t slots_for(std::uint32_t manifolds) { return manifolds + kColourKeys * kLaneGroup; }

}  // namespace plumb::impulse
