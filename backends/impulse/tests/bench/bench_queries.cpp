// A million rays against a pile of 32,000 boxes, on one thread and on all. The label is the hash of the hits, which the
// CUDA bench must print too. And what is around a thousand balls where such rays begin: the nearest, or all.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "tests/rigs/broad_phase_cases.hpp"
#include "tests/rigs/query_cases.hpp"

namespace plumb::impulse {
namespace {

constexpr std::uint32_t kBoxes = 32000, kRays = 1000000;

void closest_rays(benchmark::State& state, std::uint32_t rays, std::uint32_t threads) {
  QueryBench bench(kBoxes, rays, threads);
  for (auto _ : state) bench.ask();
  state.counters["per_ray"] =
      benchmark::Counter(rays, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["hits"] = static_cast<double>(bench.found());
  state.SetLabel(hexadecimal(bench.hash()));
}

void closest_bodies(benchmark::State& state, PlumbHitMode mode, std::uint32_t balls) {
  QueryBench bench(kBoxes, balls, 1);
  const std::vector<PlumbProbe> probes = bench.probes(3);
  std::size_t rows = 0;
  for (auto _ : state) rows = bench.rig.closest(mode, probes).size();
  state.counters["per_ball"] =
      benchmark::Counter(balls, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["rows"] = static_cast<double>(rows);
}

/// Which bodies cubes of 1 m overlap, and how deep where `with_depth`.
void overlaps(benchmark::State& state, bool with_depth, std::uint32_t cubes) {
  QueryBench bench(kBoxes, cubes, 1);
  const std::vector<PlumbOverlap> asked = bench.cubes();
  std::size_t rows = 0;
  for (auto _ : state) rows = with_depth ? bench.rig.penetrations(asked).size() : bench.rig.overlaps(asked).size();
  state.counters["per_cube"] =
      benchmark::Counter(cubes, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["rows"] = static_cast<double>(rows);
}

/// Cubes of 1 m that go 5 m, and turn by a radian on the way where `turning`.
void cubes_cast(benchmark::State& state, bool turning, std::uint32_t cubes) {
  QueryBench bench(kBoxes, cubes, 1);
  const std::vector<PlumbTurningCast> casts = bench.turning_cubes(1);
  const std::vector<PlumbCast> straight = bench.cast_cubes();
  std::span<const PlumbHit> hits;
  for (auto _ : state) hits = turning ? bench.rig.turning_casts(casts) : bench.rig.casts(PLUMB_HIT_CLOSEST, straight);
  state.counters["per_cube"] =
      benchmark::Counter(cubes, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["hits"] =
      static_cast<double>(std::count_if(hits.begin(), hits.end(), [](const PlumbHit& hit) { return hit.body != 0; }));
}

}  // namespace
}  // namespace plumb::impulse

int main(int argc, char** argv) {
  using namespace plumb::impulse;
  const std::uint32_t all = std::max(1U, std::thread::hardware_concurrency());
  for (const std::uint32_t rays : {kRays / 1000, kRays})
    for (const std::uint32_t threads : {1U, all}) {
      const std::string name = std::to_string(rays) + " rays/" + std::to_string(threads) + " threads";
      benchmark::RegisterBenchmark(name.c_str(), closest_rays, rays, threads)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
  for (const auto& [name, mode] : {std::pair{"the nearest within 3 m of 1000 balls", PLUMB_HIT_CLOSEST},
                                   std::pair{"all within 3 m of 1000 balls", PLUMB_HIT_ALL}})
    benchmark::RegisterBenchmark(name, closest_bodies, static_cast<PlumbHitMode>(mode), kRays / 1000)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  for (const auto& [name, with_depth] : {std::pair{"overlaps of 1000 cubes", false}, {"depths of 1000 cubes", true}})
    benchmark::RegisterBenchmark(name, overlaps, with_depth, kRays / 1000)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  for (const auto& [name, turning] : {std::pair{"casts of 1000 cubes", false}, {"turning casts of 1000 cubes", true}})
    benchmark::RegisterBenchmark(name, cubes_cast, turning, kRays / 1000)->Unit(benchmark::kMillisecond)->UseRealTime();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
