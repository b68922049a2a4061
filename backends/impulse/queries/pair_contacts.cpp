#include "queries/pair_contacts.hpp"

#include <limits>

#include "narrowphase/collide.hpp"
#include "narrowphase/distance.hpp"
#include "plumb/physics_world.hpp"
#include "queries/piece_pairs.hpp"

namespace plumb::impulse {

namespace {

struct AnswerPairs {
  const PosedPair* pairs;
  Hulls hulls;
  PairAnswer* answers;

  PLUMB_HD void operator()(std::uint32_t i) const { answers[i] = answer_convex(pairs[i], hulls); }
};

/// The same where any of them may be a plane or a surface.
struct AnswerAllPairs {
  const PosedPair* pairs;
  Hulls hulls;
  Surfaces surfaces;
  PairAnswer* answers;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const PosedPair& pair = pairs[i];
    if (!is_in_pieces(pair)) {
      answers[i] = answer_convex(pair, hulls);
    } else if (is_in_pieces(pair.a) && is_in_pieces(pair.b)) {
      PairAnswer answer{};
      answer.distance = std::numeric_limits<double>::quiet_NaN();
      answer.normal = {0, 1, 0};
      answers[i] = answer;
    } else {
      answers[i] = PiecePair(pair, hulls, surfaces).answer();
    }
  }
};

struct CountTouches {
  std::uint32_t count;
  PLUMB_HD void operator()(std::uint32_t /*triangle*/, const Manifold& /*manifold*/) { ++count; }
};
struct CountPieceTouches {
  const PosedPair* pairs;
  Hulls hulls;
  Surfaces surfaces;
  std::uint32_t* counts;
  PLUMB_HD void operator()(std::uint32_t i) const {
    CountTouches touches{0};
    const bool one = is_in_pieces(pairs[i].a) != is_in_pieces(pairs[i].b);
    if (one) PiecePair(pairs[i], hulls, surfaces).touches(touches);
    counts[i] = touches.count;
  }
};

struct WriteTouches {
  PieceTouch* to;
  PLUMB_HD void operator()(std::uint32_t triangle, const Manifold& manifold) { *to++ = {manifold, triangle}; }
};
struct WritePieceTouches {
  const PosedPair* pairs;
  Hulls hulls;
  Surfaces surfaces;
  const std::uint32_t *counts, *offsets;
  PieceTouch* rows;
  PLUMB_HD void operator()(std::uint32_t i) const {
    if (counts[i] == 0) return;
    WriteTouches touches{rows + offsets[i]};
    PiecePair(pairs[i], hulls, surfaces).touches(touches);
  }
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
  if (pieces)
    executor.run(n, AnswerAllPairs{pairs, scene.hulls, scene.surfaces, answers});
  else
    executor.run(n, AnswerPairs{pairs, scene.hulls, answers});
}

void PieceTouches::find(Executor& executor, const PosedPair* pairs, std::uint32_t n, const QueryScene& scene) {
  counts_.grow(n);
  offsets_.grow(n + 1);
  scan_.reserve(n);
  executor.run(n, CountPieceTouches{pairs, scene.hulls, scene.surfaces, counts_.data()});
  scan_.run(executor, n, counts_.data(), offsets_.device(), offsets_.device() + n);
  executor.to_host(offsets_, n + 1);
  executor.wait();
  const std::uint32_t total = offsets_[n];
  if (total == ~0U)
    throw Error(PLUMB_E_OUT_OF_MEMORY, "pairs of shapes touch in more places than can be counted; ask fewer at a time");
  rows_.grow(total);
  executor.run(
      n, WritePieceTouches{pairs, scene.hulls, scene.surfaces, counts_.data(), offsets_.device(), rows_.device()});
  executor.to_host(rows_, total);
  executor.wait();
}

}  // namespace plumb::impulse
