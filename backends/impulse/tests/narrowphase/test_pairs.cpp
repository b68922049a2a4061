// The narrow phase as a step runs it, where kernels run, against the pair functions called one by one on the host: the
// same bits for every kind of pair, in either order.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <span>
#include <string>

#include "exec/executor.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "tests/rigs/facing_pairs.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;
using enum ShapeType;

constexpr const char* kNames[] = {"sphere", "box", "capsule", "hull", "cylinder"};
constexpr std::uint32_t kPairsOfAKind = 1U << 14;
constexpr std::uint64_t kRounds = Executor::kWarps ? 8 : 1;  // seeds 1 to 8; each gives that many of every kind

struct Kind {
  ShapeType a, b;
};
constexpr Kind kKinds[] = {{kSphere, kSphere},    {kSphere, kBox},    {kSphere, kCapsule},   {kSphere, kHull},
                           {kBox, kBox},          {kBox, kCapsule},   {kBox, kHull},         {kCapsule, kCapsule},
                           {kCapsule, kHull},     {kHull, kHull},     {kSphere, kCylinder},  {kBox, kCylinder},
                           {kCapsule, kCylinder}, {kHull, kCylinder}, {kCylinder, kCylinder}};
std::string name_of(const Kind& kind) {
  return std::string(kNames[static_cast<int>(kind.a)]) + "-" + kNames[static_cast<int>(kind.b)];
}

bool same_bits(const Vec& a, const Vec& b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_bits(Real a, Real b) { return std::memcmp(&a, &b, sizeof a) == 0; }

struct Outcome {
  bool touch;
  Manifold manifold;
};
bool same_bits(const Outcome& a, const Outcome& b) {
  if (a.touch != b.touch) return false;
  if (!a.touch) return true;
  const Manifold &m = a.manifold, &n = b.manifold;
  if (m.count != n.count || !same_bits(m.normal, n.normal)) return false;
  for (std::uint32_t i = 0; i < m.count; ++i) {
    const ManifoldPoint &p = m.points[i], &q = n.points[i];
    if (!same_bits(p.position, q.position) || !same_bits(p.separation, q.separation) || p.feature != q.feature)
      return false;
  }
  return true;
}

std::string text(Real x) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%a", static_cast<double>(x));
  return digits;
}
std::string text(const Vec& v) { return text(v.x) + ", " + text(v.y) + ", " + text(v.z); }
std::string text(const Quat& q) { return text(vector_part(q)) + ", " + text(q.w); }
std::string text(const Outcome& o) {
  if (!o.touch) return "apart";
  std::string all = std::string("normal ") + text(o.manifold.normal);
  for (std::uint32_t i = 0; i < o.manifold.count; ++i) {
    const ManifoldPoint& p = o.manifold.points[i];
    all += std::string("\n    position ") + text(p.position) + " separation " + text(p.separation) + " feature " +
           std::to_string(p.feature);
  }
  return all;
}

/// What the pair functions are given.
struct Input {
  Shape a, b;
  Quat qa, qb;
  Vec d;
  Real margin;
};
std::string text(const Shape& s) {
  return std::string(kNames[static_cast<int>(s.type)]) + " size " + text(s.size) + " reach " + text(s.reach) +
         " hull row " + std::to_string(s.hull);
}
std::string text(const Input& in) {
  return std::string("  A: ") + text(in.a) + " at " + text(in.qa) + "\n  B: " + text(in.b) + " at " + text(in.qb) +
         "\n  d " + text(in.d) + " margin " + text(in.margin) + "\n";
}

/// Everything that a narrow phase reads. Pair i is of the proxies 2 i and 2 i + 1, each a body of its own.
class Rig {
 public:
  Rig(std::uint64_t seed, std::span<const Kind> kinds, std::uint32_t of_each)
      : dice_(seed), kit_(dice_), count_(static_cast<std::uint32_t>(kinds.size()) * of_each), kinds_(kinds) {
    const std::size_t proxies = std::size_t{2} * count_;
    position_.grow(proxies);
    orientation_.grow(proxies);
    proxies_.grow(proxies);
    margins_.grow(proxies);
    counters_.grow(1);
    parameters_.grow(1);
    parameters_[0].step = 1;
    shapes_.grow(kit_.shapes.size());
    for (std::size_t i = 0; i < kit_.shapes.size(); ++i) shapes_[i] = kit_.shapes[i];
    pairs_.resize(count_);
    for (std::uint32_t i = 0; i < count_; ++i) make_pair(i);
    counters_[0].pairs = count_;
  }

  [[nodiscard]] std::uint32_t count() const { return count_; }
  [[nodiscard]] const Kind& kind(std::uint32_t i) const { return kinds_[i % kinds_.size()]; }

  /// By pair, as a step finds them.
  std::vector<Outcome> run() {
    executor_.to_device(position_, position_.size());
    executor_.to_device(orientation_, orientation_.size());
    executor_.to_device(proxies_, proxies_.size());
    executor_.to_device(shapes_, shapes_.size());
    executor_.to_device(margins_, margins_.size());
    executor_.to_device(counters_, 1);
    executor_.to_device(parameters_, 1);
    kit_.hulls.upload(executor_);
    NarrowPhase narrow_phase;
    narrow_phase.reserve(executor_, 2 * count_, count_ + 3);
    const ContactCache cache = narrow_phase.cache(0);
    memory::upload(cache.pairs, pairs_.data(), pairs_.size() * sizeof(Pair));
    std::uint32_t types = 0;
    for (const Kind& kind : kinds_)
      types |= 1U << static_cast<std::uint32_t>(kind.a) | 1U << static_cast<std::uint32_t>(kind.b);
    narrow_phase.collide(executor_,
                         {cache,
                          narrow_phase.cache(1),
                          {position_.device(), orientation_.device(), nullptr, nullptr, nullptr, true},
                          {proxies_.device(), shapes_.device(), kit_.hulls.device()},
                          margins_.device(),
                          parameters_.device(),
                          false},
                         types, counters_.device());
    narrow_phase.number(executor_, cache, counters_.device());
    executor_.to_host(counters_, 1);
    executor_.wait();

    std::vector<std::uint32_t> touching(count_), candidate(counters_[0].manifolds);
    std::vector<Manifold> found(count_);
    memory::download(touching.data(), cache.touching, count_ * sizeof(std::uint32_t));
    memory::download(candidate.data(), cache.candidate, candidate.size() * sizeof(std::uint32_t));
    memory::download(found.data(), cache.found, count_ * sizeof(Manifold));
    std::vector<Outcome> outcomes(count_);
    std::vector<std::uint32_t> expected_candidate;
    for (std::uint32_t i = 0; i < count_; ++i) {
      outcomes[i] = {touching[i] != 0, found[i]};
      if (touching[i] != 0) expected_candidate.push_back(i);
    }
    EXPECT_EQ(candidate, expected_candidate);
    return outcomes;
  }

  [[nodiscard]] Input input(std::uint32_t i) const {
    const Pair& pair = pairs_[i];
    const Proxy &a = proxies_[pair.a], &b = proxies_[pair.b];
    const ShapePose pose_a = shape_pose(a, orientation_[a.body]), pose_b = shape_pose(b, orientation_[b.body]);
    return {shapes_[a.shape],
            shapes_[b.shape],
            pose_a.orientation,
            pose_b.orientation,
            between(position_[a.body], position_[b.body]) + pose_b.offset - pose_a.offset,
            margins_[pair.a] + margins_[pair.b]};
  }
  Outcome expected(const Input& in) {
    Outcome o{};
    o.touch = collide({in.a, in.b, in.qa, in.qb, in.d, in.margin}, kit_.hulls.host(), o.manifold);
    return o;
  }

 private:
  void make_pair(std::uint32_t i) {
    Kind ordered = kind(i);
    if (dice_.below(2) == 0) ordered = {ordered.b, ordered.a};
    const std::uint32_t row_a = kit_.row(ordered.a, dice_.below(ShapeKit::kEach)),
                        row_b = kit_.row(ordered.b, dice_.below(ShapeKit::kEach));
    const RandomPair pair = facing_pair(dice_, kit_.shapes[row_a], kit_.shapes[row_b], kit_.hulls.host());
    const V place = 100.0 * dice_.direction();
    pairs_[i] = {2 * i, 2 * i + 1};
    put(2 * i, row_a, pair.qa, place);
    put(2 * i + 1, row_b, pair.qb, place + to_double(pair.d));
  }
  /// Shapes that lie somewhere in their body are one in four.
  void put(std::uint32_t body, std::uint32_t shape, const Quat& turn, const V& place) {
    Proxy proxy{};
    proxy.body = body;
    proxy.shape = shape;
    proxy.frame = {{0, 0, 0}, {0, 0, 0, 1}};
    position_[body] = place;
    orientation_[body] = turn;
    if (dice_.below(4) == 0) {
      const V offset = 0.5 * dice_.direction();
      const auto within = dice_.orientation(), outside = unit(turn) * conjugate(within);
      proxy.frame = {{static_cast<Real>(offset.x), static_cast<Real>(offset.y), static_cast<Real>(offset.z)},
                     Dice::to_real(within)};
      position_[body] = place - rotate(outside, offset);
      orientation_[body] = Dice::to_real(outside);
    }
    proxies_[body] = proxy;
    margins_[body] = dice_.below(2) == 0 ? Real(0) : static_cast<Real>(dice_.uniform(0, 0.05));
  }

  Executor executor_{nullptr, 1};
  Dice dice_;
  ShapeKit kit_;
  std::uint32_t count_;
  std::span<const Kind> kinds_;
  Mirror<Position> position_;
  Mirror<Quat> orientation_;
  Mirror<Proxy> proxies_;
  Mirror<Shape> shapes_;
  Mirror<Real> margins_;
  Mirror<StepCounters> counters_;
  Mirror<StepParameters> parameters_;
  std::vector<Pair> pairs_;
};

void compare(Rig& rig, std::span<const Kind> kinds, std::uint64_t seed) {
  const std::vector<Outcome> found = rig.run();
  std::vector<std::uint32_t> pairs(kinds.size()), touching(kinds.size()), differ(kinds.size());
  std::vector<std::string> first(kinds.size());
  for (std::uint32_t i = 0; i < rig.count(); ++i) {
    const std::size_t k = i % kinds.size();
    const Input input = rig.input(i);
    const Outcome expected = rig.expected(input);
    ++pairs[k];
    touching[k] += expected.touch ? 1 : 0;
    if (same_bits(found[i], expected) || differ[k]++ != 0) continue;
    first[k] = text(input) + "  host: " + text(expected) + "\n  kernel: " + text(found[i]);
  }
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    EXPECT_EQ(differ[k], 0U) << "of " << pairs[k] << " pairs " << name_of(kinds[k]) << " of seed " << seed
                             << "; the first:\n"
                             << first[k];
    EXPECT_GT(touching[k], pairs[k] / 4) << name_of(kinds[k]);
    EXPECT_LT(touching[k], pairs[k]) << name_of(kinds[k]);
  }
}

TEST(Pairs, AreTheSameBitsInKernelsAsOnTheHost) {
  for (std::uint64_t seed = 1; seed <= kRounds; ++seed) {
    Rig rig(seed, kKinds, kPairsOfAKind);
    compare(rig, kKinds, seed);
  }
}

/// A scene of one type is not sorted by kinds.
TEST(Pairs, OfOneTypeAreTheSameBitsInKernelsAsOnTheHost) {
  for (const Kind& kind : kKinds) {
    if (kind.a != kind.b) continue;
    Rig rig(100, {&kind, 1}, kPairsOfAKind);
    compare(rig, {&kind, 1}, 100);
  }
}

}  // namespace
}  // namespace plumb::impulse
