// What a pair costs: every pair function on pairs that touch, that nearly do, and that are apart, in ns a pair.
#include <benchmark/benchmark.h>

#include "tests/rigs/narrow_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;
using enum ShapeType;

constexpr const char* kNames[] = {"sphere", "box", "capsule", "hull"};
constexpr const char* kSituations[] = {"resting", "tumbled", "apart"};
constexpr std::size_t kPairs = 1024;

struct Case {
  RandomPair pair;
  Real margin;
};

Shape shape_of(ShapeType type, const HullPool& pool) {
  if (type == kSphere) return {type, 0, {Real(0.5), 0, 0}, Real(0.5)};
  if (type == kBox) return make_box(0.5, 0.5, 0.5);
  if (type == kCapsule) return {type, 0, {Real(0.25), Real(0.25), 0}, Real(0.5)};
  return {type, 0, {0, 0, 0}, pool.reach(0)};
}

/// Resting: upright, turned about the vertical, a hair deep. Tumbled: any orientation, overlapping a little. Apart: in
/// the ball where bounding boxes overlap, but the shapes not.
std::vector<Case> make_cases(ShapeType a, ShapeType b, int situation, HullPool& pool) {
  Dice dice(3);
  std::vector<Case> cases;
  while (cases.size() < kPairs) {
    Case c{{shape_of(a, pool), shape_of(b, pool), {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0}}, Real(0.01)};
    V d = {0.2 * dice.uniform(-1, 1), 0.9999, 0.2 * dice.uniform(-1, 1)};
    if (situation == 0) {
      c.pair.qb = Dice::to_real(Dice::turn({0, 1, 0}, dice.uniform(-0.3, 0.3)));
    } else {
      c.pair.qa = Dice::to_real(dice.orientation());
      c.pair.qb = Dice::to_real(dice.orientation());
      d = dice.uniform(0.8, 1.5) * dice.direction();
    }
    c.pair.d = {static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z)};
    Manifold m{};
    const RandomPair& p = c.pair;
    if (collide({p.a, p.b, p.qa, p.qb, p.d, c.margin}, pool.host(), m) == (situation != 2)) cases.push_back(c);
  }
  return cases;
}

void narrow_phase(benchmark::State& state, ShapeType a, ShapeType b, int situation) {
  HullPool pool;
  Dice dice(1);
  std::vector<PlumbVec3> points;  // a pebble of some 30 faces
  for (int i = 0; i < 18; ++i) {
    const V v = 0.5 * dice.direction();
    points.push_back({v.x, v.y, v.z});
  }
  pool.add(points);
  const std::vector<Case> cases = make_cases(a, b, situation, pool);
  const Hulls hulls = pool.host();
  double count = 0;
  for (auto _ : state)
    for (const Case& c : cases) {
      Manifold m;
      const RandomPair& p = c.pair;
      collide({p.a, p.b, p.qa, p.qb, p.d, c.margin}, hulls, m);
      benchmark::DoNotOptimize(m);
      count += m.count;
    }
  state.counters["per_pair"] = benchmark::Counter(
      static_cast<double>(kPairs), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["points"] = count / static_cast<double>(kPairs) / static_cast<double>(state.iterations());
}

void register_all() {
  for (const ShapeType a : {kSphere, kBox, kCapsule, kHull})
    for (const ShapeType b : {kSphere, kBox, kCapsule, kHull})
      for (int situation = 0; situation < 3; ++situation) {
        if (a > b || (situation == 0 && (a != kBox || b != kBox))) continue;
        const std::string name = std::string(kNames[static_cast<std::size_t>(a)]) + "-" +
                                 kNames[static_cast<std::size_t>(b)] + " " +
                                 kSituations[static_cast<std::size_t>(situation)];
        benchmark::RegisterBenchmark(name.c_str(), narrow_phase, a, b, situation);
      }
}

}  // namespace
}  // namespace plumb::impulse

int main(int argc, char** argv) {
  plumb::impulse::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
