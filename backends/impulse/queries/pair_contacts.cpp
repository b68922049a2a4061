#include "queries/pair_contacts.hpp"

#include "narrowphase/collide.hpp"
#include "narrowphase/distance.hpp"

namespace plumb::impulse {

namespace {

PLUMB_HD void take_deepest(PairAnswer& answer) {
  const Manifold& manifold = answer.manifold;
  std::uint32_t deepest = 0;
  for (std::uint32_t i = 1; i < manifold.count; ++i)
    if (manifold.points[i].separation < manifold.points[deepest].separation) deepest = i;
  answer.distance = static_cast<double>(manifold.points[deepest].separation);
  answer.normal = to_numbers<double>(manifold.normal);
  answer.at = to_numbers<double>(manifold.points[deepest].position);
}

struct AnswerPairs {
  const PosedPair* pairs;
  Hulls hulls;
  PairAnswer* answers;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const PosedPair& pair = pairs[i];
    PairAnswer answer;
    const Vec apart = between(pair.place_a, pair.place_b);
    if (collide(pair.a, to_numbers<Real>(pair.turn_a), pair.b, to_numbers<Real>(pair.turn_b), apart, 0, hulls,
                answer.manifold)) {
      take_deepest(answer);
      answers[i] = answer;
      return;
    }
    answer.manifold.count = 0;
    const ShapeGap<double> gap =
        shape_gap(PlacedPair<double>{pair.a, pair.b, to_matrix(conjugate(pair.turn_a) * pair.turn_b),
                                     rotate_back(pair.turn_a, pair.place_b - pair.place_a), hulls});
    if (gap.cores_overlap) {  // by rounding alone
      answer.distance = 0;
      answer.normal = to_numbers<double>(normalized_or(apart, {0, 1, 0}));
      answer.at = {0, 0, 0};
    } else {
      answer.distance = max(gap.distance, 0.0);
      answer.normal = rotate(pair.turn_a, gap.normal);
      answer.at = rotate(pair.turn_a, gap.on_a);
    }
    answers[i] = answer;
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

void answer_pairs(Executor& executor, const PosedPair* pairs, std::uint32_t n, const Hulls& hulls,
                  PairAnswer* answers) {
  executor.run(n, AnswerPairs{pairs, hulls, answers});
}

}  // namespace plumb::impulse
