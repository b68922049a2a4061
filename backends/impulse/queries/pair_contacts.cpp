#include "queries/pair_contacts.hpp"

#include <limits>

#include "narrowphase/collide.hpp"
#include "narrowphase/convex/distance.hpp"
#include "plumb/physics_world.hpp"
#include "queries/piece_pairs.hpp"

namespace plumb::impulse {

namespace {

struct AnswerPairs {
  const PosedPair* pairs;
  Hulls hulls;
  PairAnswer* answers;

  PLUMB_HD void operator()(std::uint32_t i) const {
    if (!uses_midphase(pairs[i])) answers[i] = answer_convex(pairs[i], hulls);
  }
};

/// Pairs with planes and surfaces: the answers, or where there is room for them all touches. One kernel does both,
/// because the pair functions in it take a compiler's time.
struct LookAtPieces {
  const PosedPair* pairs;
  Hulls hulls;
  Surfaces surfaces;
  PairAnswer* answers;
  const std::uint32_t* offsets;
  PieceTouch* rows;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const PosedPair& pair = pairs[i];
    if (!uses_midphase(pair)) return;
    TouchesOfPair touches{rows == nullptr ? nullptr : rows + offsets[i]};
    const bool one = uses_midphase(pair.a) != uses_midphase(pair.b);
    const PiecePair pieces(pair, hulls, surfaces);
    if (one) pieces.look(touches);
    if (rows != nullptr) return;
    PairAnswer answer = touches.deepest;
    answer.touches = touches.count;
    if (!one) {
      answer.distance = std::numeric_limits<double>::quiet_NaN();
      answer.normal = {0, 1, 0};
    } else if (answer.touches == 0) {
      pieces.tell_gap(answer);
    }
    answers[i] = answer;
  }
};

struct CountTouches {
  const PairAnswer* answers;
  std::uint32_t* counts;
  PLUMB_HD void operator()(std::uint32_t i) const { counts[i] = answers[i].touches; }
};

struct PosePairs {
  QueryScene scene;
  const Pair* pairs;
  PosedPair* posed;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const Target &a = scene.targets[pairs[i].a], &b = scene.targets[pairs[i].b];
    posed[i] = {a.shape, b.shape, a.place, b.place, a.turn, b.turn};
  }
};

}  // namespace

void pose_pairs(Executor& executor, const QueryScene& scene, const Pair* pairs, std::uint32_t n, PosedPair* posed) {
  executor.run(n, PosePairs{scene, pairs, posed});
}

void answer_pairs(Executor& executor, const PosedPair* pairs, std::uint32_t n, const QueryScene& scene, bool pieces,
                  PairAnswer* answers) {
  executor.run(n, AnswerPairs{pairs, scene.hulls, answers});
  if (pieces) executor.run(n, LookAtPieces{pairs, scene.hulls, scene.surfaces, answers, nullptr, nullptr});
}

void PieceTouches::find(Executor& executor, const PosedPair* pairs, const PairAnswer* answers, std::uint32_t n,
                        const QueryScene& scene) {
  counts_.grow(n);
  offsets_.grow(n + 1);
  scan_.reserve(n);
  executor.run(n, CountTouches{answers, counts_.data()});
  scan_.run(executor, n, counts_.data(), offsets_.device(), offsets_.device() + n);
  executor.to_host(offsets_, n + 1);
  executor.wait();
  const std::uint32_t total = offsets_[n];
  if (total == ~0U)
    throw Error(PLUMB_E_OUT_OF_MEMORY, "pairs of shapes touch in more places than can be counted; ask fewer at a time");
  if (total == 0) return;
  rows_.grow(total);
  executor.run(n, LookAtPieces{pairs, scene.hulls, scene.surfaces, nullptr, offsets_.device(), rows_.device()});
  executor.to_host(rows_, total);
  executor.wait();
}

}  // namespace plumb::impulse
