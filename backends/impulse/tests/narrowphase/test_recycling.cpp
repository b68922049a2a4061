// Contacts that are recycled, held against what collision finds where the bodies have come to.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "exec/executor.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "tests/rigs/facing_pairs.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;
using enum ShapeType;

constexpr std::uint32_t kPairs = 1U << 12;
constexpr double kReach = 100;  // of places from the origin

/// A rigid motion.
struct Motion {
  Quat4<double> turn;
  V shift;
};

/// Pairs that have been collided once; pair i is of the bodies 2 i and 2 i + 1.
class RecyclingRig {
 public:
  RecyclingRig(ShapeType a, ShapeType b) {
    position_.grow(std::size_t{2} * kPairs);
    orientation_.grow(std::size_t{2} * kPairs);
    proxies_.grow(std::size_t{2} * kPairs);
    margins_.grow(std::size_t{2} * kPairs);
    counters_.grow(1);
    parameters_.grow(1);
    shapes_.grow(kit_.shapes.size());
    for (std::size_t i = 0; i < kit_.shapes.size(); ++i) shapes_[i] = kit_.shapes[i];
    for (std::uint32_t i = 0; i < kPairs; ++i) make_pair(i, a, b);
    counters_[0].pairs = kPairs;
    types_ = bit_of(a) | bit_of(b);
    narrow_phase_.reserve(executor_, 2 * kPairs, kPairs);
    kit_.hulls.upload(executor_);
    collide();
  }

  /// Every pair goes with a motion of its own, and its second body besides slides and turns against the first, about
  /// its own centre, so that no point of it goes further than `slide` of the thinner shape's inner radius.
  void move(double slide) {
    for (std::uint32_t i = 0; i < kPairs; ++i) {
      const Motion both = {dice_.orientation(), kReach * dice_.direction()};
      apply(both, 2 * i);
      apply(both, 2 * i + 1);
      const double most = slide * thinnest(i);
      position_[2 * i + 1] += most / 2 * dice_.direction();
      const V half = most / 4 / farthest(i) * dice_.direction();
      orientation_[2 * i + 1] =
          Dice::to_real(normalized(Quat4<double>{half.x, half.y, half.z, 1} * unit(orientation_[2 * i + 1])));
    }
  }
  void collide() {
    ++parameters_[0].step;
    executor_.to_device(position_, position_.size());
    executor_.to_device(orientation_, orientation_.size());
    executor_.to_device(proxies_, proxies_.size());
    executor_.to_device(shapes_, shapes_.size());
    executor_.to_device(margins_, margins_.size());
    executor_.to_device(counters_, 1);
    executor_.to_device(parameters_, 1);
    const std::uint32_t step = parameters_[0].step;
    cache_ = narrow_phase_.cache(step);
    std::vector<Pair> pairs(kPairs);
    std::vector<PairRange> ranges(std::size_t{2} * kPairs);
    for (std::uint32_t i = 0; i < kPairs; ++i) {
      pairs[i] = {2 * i, 2 * i + 1};
      ranges[2 * i] = {i, 1};
    }
    memory::upload(cache_.pairs, pairs.data(), pairs.size() * sizeof(Pair));
    memory::upload(cache_.ranges, ranges.data(), ranges.size() * sizeof(PairRange));
    narrow_phase_.collide(executor_,
                          {cache_,
                           narrow_phase_.cache(step + 1),
                           {position_.device(), orientation_.device(), nullptr, nullptr, nullptr, true},
                           {proxies_.device(), shapes_.device(), kit_.hulls.device()},
                           margins_.device(),
                           parameters_.device(),
                           false},
                          types_, counters_.device());
    narrow_phase_.number(executor_, cache_, counters_.device());
    executor_.wait();
    touching_.resize(kPairs);
    found_.resize(kPairs);
    collided_.resize(CollidedRows::lines_for(kPairs));
    memory::download(touching_.data(), cache_.touching, kPairs * sizeof(std::uint32_t));
    memory::download(found_.data(), cache_.found, kPairs * sizeof(Manifold));
    memory::download(collided_.data(), cache_.collided.lines, collided_.size() * sizeof(CollidedRows::Line));
  }

  [[nodiscard]] bool touches(std::uint32_t i) const { return touching_[i] != 0; }
  [[nodiscard]] const Manifold& found(std::uint32_t i) const { return found_[i]; }
  /// Whether a pair may be recycled, and has been collided before its bodies came to where they are.
  [[nodiscard]] bool is_recyclable(std::uint32_t i) { return CollidedRows{collided_.data()}.is_recyclable(i); }
  [[nodiscard]] bool is_recycled(std::uint32_t i) {
    const CollidedManifold collided = CollidedRows{collided_.data()}.load(i);
    return is_recyclable(i) && std::memcmp(&collided.orientation_a, &orientation_[2 * i], sizeof(Quat)) != 0;
  }
  [[nodiscard]] double thinnest(std::uint32_t i) { return min(inner_radius(2 * i), inner_radius(2 * i + 1)); }
  /// What collision finds where the bodies are.
  [[nodiscard]] bool collide_anew(std::uint32_t i, Manifold& out) {
    const ShapePose a = shape_pose(proxies_[2 * i], orientation_[2 * i]),
                    b = shape_pose(proxies_[2 * i + 1], orientation_[2 * i + 1]);
    const Vec d = between(position_[2 * i], position_[2 * i + 1]) + b.offset - a.offset;
    return impulse::collide(
        {shape(2 * i), shape(2 * i + 1), a.orientation, b.orientation, d, margins_[2 * i] + margins_[2 * i + 1]},
        kit_.hulls.host(), out);
  }
  void make_new(std::uint32_t proxy) { proxies_[proxy].first_step = parameters_[0].step + 1; }
  void look_further(Real margin) {
    for (std::uint32_t i = 0; i < 2 * kPairs; ++i) margins_[i] = margin;
  }

 private:
  [[nodiscard]] double inner_radius(std::uint32_t body) {
    const Shape& of = shape(body);
    return static_cast<double>(of.type == kBox ? BoxView{of.size}.inner_radius()
                                               : HullView(kit_.hulls.host(), of.hull).inner_radius());
  }
  [[nodiscard]] const Shape& shape(std::uint32_t body) const { return kit_.shapes[proxies_[body].shape]; }
  /// No point of the second shape is further than this from its body's centre.
  [[nodiscard]] double farthest(std::uint32_t i) const {
    return static_cast<double>(shape(2 * i + 1).reach + length(proxies_[2 * i + 1].frame.position));
  }
  void make_pair(std::uint32_t i, ShapeType a, ShapeType b) {
    const std::uint32_t row_a = kit_.row(a, dice_.below(ShapeKit::kEach)),
                        row_b = kit_.row(b, dice_.below(ShapeKit::kEach));
    const RandomPair pair = facing_pair(dice_, kit_.shapes[row_a], kit_.shapes[row_b], kit_.hulls.host());
    put(2 * i, row_a, pair.qa, {0, 0, 0});
    put(2 * i + 1, row_b, pair.qb, to_double(pair.d));
  }
  /// Shapes lie somewhere in their body.
  void put(std::uint32_t body, std::uint32_t row, const Quat& turn, const V& place) {
    const V offset = 0.5 * dice_.direction();
    const auto within = dice_.orientation(), outside = unit(turn) * conjugate(within);
    Proxy proxy{};
    proxy.body = body;
    proxy.shape = row;
    proxy.frame = {{static_cast<Real>(offset.x), static_cast<Real>(offset.y), static_cast<Real>(offset.z)},
                   Dice::to_real(within)};
    position_[body] = place - rotate(outside, offset);
    orientation_[body] = Dice::to_real(outside);
    proxies_[body] = proxy;
    margins_[body] = Real(0.01);
  }
  void apply(const Motion& motion, std::uint32_t body) {
    position_[body] = rotate(motion.turn, position_[body]) + motion.shift;
    orientation_[body] = Dice::to_real(normalized(motion.turn * unit(orientation_[body])));
  }

  Executor executor_{nullptr, 1};
  Dice dice_{7};
  ShapeKit kit_{dice_};
  Mirror<Position> position_;
  Mirror<Quat> orientation_;
  Mirror<Proxy> proxies_;
  Mirror<Shape> shapes_;
  Mirror<Real> margins_;
  Mirror<StepCounters> counters_;
  Mirror<StepParameters> parameters_;
  NarrowPhase narrow_phase_;
  ContactCache cache_{};
  std::uint32_t types_ = 0;
  std::vector<std::uint32_t> touching_;
  std::vector<Manifold> found_;
  std::vector<CollidedRows::Line> collided_;
};

constexpr double kTolerance = 2e-3;  // of the thinner inner radius

class Recycling : public ::testing::TestWithParam<std::pair<ShapeType, ShapeType>> {
 protected:
  RecyclingRig rig_{GetParam().first, GetParam().second};
};

TEST_P(Recycling, KeepsWhatHasHardlyMovedAndCarriesItAlong) {
  std::vector<std::uint32_t> recyclable;
  std::vector<std::uint32_t> counts;
  for (std::uint32_t i = 0; i < kPairs; ++i)
    if (rig_.touches(i) && rig_.is_recyclable(i)) recyclable.push_back(i);
  ASSERT_GT(recyclable.size(), kPairs / 4);
  for (const std::uint32_t i : recyclable) counts.push_back(rig_.found(i).count);
  rig_.move(0.5 * kTolerance);
  rig_.collide();
  std::uint32_t compared = 0, far = 0;
  double errors = 0;  // of separations, as shares of the tolerance
  for (std::size_t k = 0; k < recyclable.size(); ++k) {
    const std::uint32_t i = recyclable[k];
    ASSERT_TRUE(rig_.touches(i) && rig_.is_recycled(i)) << i;
    const Manifold& found = rig_.found(i);
    EXPECT_EQ(found.count, counts[k]);
    EXPECT_NEAR(static_cast<double>(length(found.normal)), 1, 1e-5);
    Manifold anew;
    // Another feature may be the deepest by now, along another normal: such pairs say nothing.
    if (!rig_.collide_anew(i, anew) || length(anew.normal - found.normal) > Real(2 * kTolerance)) continue;
    for (std::uint32_t p = 0; p < found.count; ++p)
      for (std::uint32_t q = 0; q < anew.count; ++q) {
        if (found.points[p].feature != anew.points[q].feature) continue;
        ++compared;
        const double most = kTolerance * rig_.thinnest(i);
        const double error = std::abs(static_cast<double>(found.points[p].separation - anew.points[q].separation));
        // Edges that cross at a small angle move their point far along both.
        far += error > 0.5 * most ? 1 : 0;
        far += length(found.points[p].position - anew.points[q].position) > static_cast<Real>(20 * most) ? 1 : 0;
        errors += error / most;
      }
  }
  EXPECT_GT(compared, recyclable.size() / 2);
  EXPECT_LT(far, compared / 100);
  EXPECT_LT(errors / compared, 0.03);
}

TEST_P(Recycling, ForgetsContactsThatHaveSlidFurther) {
  rig_.move(8 * kTolerance);
  rig_.collide();
  for (std::uint32_t i = 0; i < kPairs; ++i) ASSERT_FALSE(rig_.touches(i) && rig_.is_recycled(i)) << i;
}

/// What is apart stays so to the bit: whether the shapes are collided again or not is not to be seen.
TEST_P(Recycling, KnowsWhatIsApart) {
  std::uint32_t apart = 0, known = 0;
  for (const double slide : {0.0, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3}) {
    rig_.move(slide);
    rig_.collide();
    for (std::uint32_t i = 0; i < kPairs; ++i) {
      if (rig_.touches(i)) continue;
      ++apart;
      known += rig_.is_recycled(i) ? 1 : 0;
      Manifold anew;
      ASSERT_FALSE(rig_.collide_anew(i, anew)) << i << " of slide " << slide;
    }
  }
  EXPECT_GT(known, apart / 3);
  EXPECT_LT(known, apart);
}

TEST_P(Recycling, IsNotOfNewProxiesNorOfThoseThatLookFurtherAhead) {
  for (std::uint32_t i = 0; i < kPairs; ++i) rig_.make_new(2 * i + i % 2);
  rig_.move(0);
  rig_.collide();
  for (std::uint32_t i = 0; i < kPairs; ++i) ASSERT_FALSE(rig_.is_recycled(i)) << i;
  rig_.look_further(Real(0.02));
  rig_.move(0);
  rig_.collide();
  for (std::uint32_t i = 0; i < kPairs; ++i) ASSERT_FALSE(rig_.touches(i) && rig_.is_recycled(i)) << i;
}

INSTANTIATE_TEST_SUITE_P(Of, Recycling,
                         ::testing::Values(std::pair{kBox, kBox}, std::pair{kBox, kHull}, std::pair{kHull, kHull}));

TEST(RecyclingOfRoundShapes, IsNotDone) {
  for (const auto& [a, b] : {std::pair{kSphere, kBox}, std::pair{kBox, kCapsule}, std::pair{kHull, kSphere}}) {
    RecyclingRig rig(a, b);
    for (std::uint32_t i = 0; i < kPairs; ++i) ASSERT_FALSE(rig.is_recyclable(i));
  }
  RecyclingRig rig(kBox, kCylinder);
  std::uint32_t standing = 0;
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    ASSERT_EQ(rig.is_recyclable(i), rig.touches(i) && rig.found(i).count > 2);
    standing += rig.is_recyclable(i) ? 1 : 0;
  }
  EXPECT_GT(standing, 0U);
}

}  // namespace
}  // namespace plumb::impulse
