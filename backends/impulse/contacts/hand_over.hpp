// How a pass goes over contacts of all colours on a GPU without a barrier behind each colour.
//
// A barrier of all blocks takes as long as the work of a colour, and most of what waits at it has no need to: a contact
// has to follow those that push one of its own two bodies, and no others. So each pair of contacts that follow each
// other on a body meets by itself (as rows do in solvers of sparse triangular systems: Park et al., "Sparsifying
// Synchronization for High-Performance Shared-Memory Sparse Triangular Solver", ISC 2014; on GPUs Liu et al., "A
// Synchronization-Free Algorithm for Parallel Sparse Triangular Solves", Euro-Par 2016). Of the contacts that push a
// body in a pass each has a rank, that of its colour among those of the body, and hands the body to the next with a tag
// beside the new velocity:
//
//   colours of body A     0          3          4          9
//   awaits tag            -          1          2          3     -: the row as all know it, which is there
//   leaves tag            1          2          3          -        since the barrier before the pass
//
//   row of A    linear, 1/m | angular, 0    ->    linear, tag 1 | angular, tag 1    -> ... ->    linear, 1/m | angular,
//   0
//
// The order in which contacts act on a body is that of the colours, as with barriers, and so are the bits.
//
// Why nothing is read too early. A half of a row goes to and fro as a whole (exec/whole_quad.hpp) and has its own tag:
// who finds a tag finds the numbers that were written with it, and no order between the halves is asked for. The tag
// that a contact awaits is written once in a pass, and what passes before left in the row is behind the barrier between
// them, and cannot come back. Nobody writes over what is still to be read: a tag is awaited by one contact alone, and
// only that writes the next. All else that a contact reads was there before the pass, or is its own. A tag has the sign
// bit: no inverse mass is like it, nor the 0 beside the angular velocity.
//
// Why nobody waits for ever. All threads of a team are on the device at once (exec/cuda/team.cuh). Each goes through
// its slots in rising order, which is that of the colours, and the contacts of a warp are of one colour and do not wait
// for each other. So of the slots that are not done the lowest has all that it awaits.
//
// Bodies that nothing pushes are not waited for. Passes that move bodies, contacts without a colour, and worlds with
// mechanisms, whose bodies are pushed from afar, keep their barriers.
#pragma once

#include "bodies/mechanism.hpp"
#include "bodies/step_counters.hpp"
#include "contacts/contact.hpp"
#include "exec/executor.hpp"
#include "exec/whole_quad.hpp"
#include "math/bits.hpp"

namespace plumb::impulse {

constexpr bool kHandsOver = Executor::kWarps && kWholeQuads;

/// Contacts of the largest colour up to which barriers do better: a block of a team does that many alone.
constexpr std::uint32_t kFewContacts = 32;

/// Threads of the longest loop over contacts where the largest colour has so many and all colours together so many.
/// together: whether the contacts of all colours may be in one loop.
PLUMB_HD constexpr std::uint32_t longest_loop(std::uint32_t largest, std::uint32_t all, bool together) {
  return contact_loop(kHandsOver && together && largest > kFewContacts ? all : largest);
}
/// Whether a pass over contacts that moves no bodies is one loop.
PLUMB_HD inline bool is_one_loop(const StepCounters& counters, std::uint32_t level, const Mechanisms& mechanisms) {
  return kHandsOver && mechanisms.count == 0 && counters.level_loop[level] > contact_loop(kFewContacts);
}

/// When a contact has its turn on a body: after the contact that leaves the tag which it awaits. 0: none.
struct Turn {
  std::uint8_t awaits, leaves;
};
/// colours: of the contacts that push the body; this contact's is one of them.
PLUMB_HD inline Turn turn_of(std::uint64_t colours, std::uint32_t colour) {
  if (colour >= kColours) return {0, 0};  // of those without one, which come after a barrier
  const std::uint64_t before = colours & ((std::uint64_t{1} << colour) - 1);
  const auto rank = static_cast<std::uint8_t>(bit_count(before));
  const bool is_last = colours >> colour == 1;
  return {rank, static_cast<std::uint8_t>(is_last ? 0 : rank + 1)};
}

/// What must be known of the bodies of a contact, a and b, before they are its turn.
struct alignas(16) ContactTurns {
  Real inverse_mass[2];  ///< which rows do not have while they are handed on
  Turn turn[2];
};

#if defined(__CUDACC__)
/// Each of the four threads of a contact moves a half of a row: linear and angular velocity of a, then of b.
class HandOver {
 public:
  __device__ HandOver(Velocity* velocities, std::uint32_t a, std::uint32_t b, const ContactTurns& turns) {
    static_assert(kContactThreads == 4 && kWarp / kContactThreads <= kLaneGroup && sizeof(Velocity) == 32);
    const int thread = point_of(0);
    of_b_ = thread >= 2;
    is_angular_ = thread % 2 == 1;
    half_ = reinterpret_cast<WholeQuad*>(velocities + (of_b_ ? b : a)) + thread % 2;
    inverse_mass_ = of_b_ ? turns.inverse_mass[1] : turns.inverse_mass[0];
    turn_ = of_b_ ? turns.turn[1] : turns.turn[0];
  }

  /// Brings the velocities in when all contacts of the warp have their turn.
  __device__ void take(SolverBody<Real>& a, SolverBody<Real>& b) const {
    WholeQuad found;
    do found = read_whole(half_);
    while (!__all_sync(kWholeWarp, turn_.awaits == 0 || found.word == tag(turn_.awaits)));
    const auto from = [&](int thread) {
      return Vec{from_point(thread, found.x), from_point(thread, found.y), from_point(thread, found.z)};
    };
    a.linear = from(0);
    a.angular = from(1);
    b.linear = from(2);
    b.angular = from(3);
  }
  /// Gives the next contact its turn.
  __device__ void leave(const SolverBody<Real>& a, const SolverBody<Real>& b) const {
    const Vec linear = of_b_ ? b.linear : a.linear, angular = of_b_ ? b.angular : a.angular;
    const Vec mine = is_angular_ ? angular : linear;
    const std::uint32_t known = is_angular_ ? 0U : __float_as_uint(inverse_mass_);
    if (inverse_mass_ > 0) write_whole(half_, {mine.x, mine.y, mine.z, turn_.leaves == 0 ? known : tag(turn_.leaves)});
  }

 private:
  __device__ static std::uint32_t tag(std::uint8_t rank) { return 1U << 31 | rank; }

  WholeQuad* half_;
  Real inverse_mass_;
  Turn turn_;
  bool of_b_, is_angular_;
};
#endif

}  // namespace plumb::impulse
