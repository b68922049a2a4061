// The broad phase on one thread of the CPU. The label is the hash of the pairs, which the CUDA bench must print too.
#include <benchmark/benchmark.h>

#include "tests/rigs/broad_phase_cases.hpp"

namespace plumb::impulse {
namespace {

void measure(benchmark::State& state, const BroadPhaseCase& of, const BroadPhasePhase& phase) {
  BroadPhaseBench bench(of, 1);
  for (auto _ : state) (bench.*phase.run)();
  state.counters["pairs"] = static_cast<double>(bench.pairs.size());
  state.SetLabel(hexadecimal(bench.hash()));
}

}  // namespace
}  // namespace plumb::impulse

int main(int argc, char** argv) {
  using namespace plumb::impulse;
  for (const BroadPhaseCase& of : kBroadPhaseCases)
    for (const BroadPhasePhase& phase : kBroadPhasePhases)
      benchmark::RegisterBenchmark((std::string(of.name) + "/" + phase.name).c_str(), measure, of, phase)
          ->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
