// The broad phase on a CUDA device: milliseconds a phase by events around graph launches, and the hash of the pairs,
// which bench_impulse_broadphase prints on the CPU too. Needs no library beside the driver.
#include <algorithm>
#include <cstdio>
#include <exception>

#include "tests/rigs/broad_phase_cases.hpp"

namespace plumb::impulse {
namespace {

/// Median over runs, in milliseconds, of a graph of `phase`.
float median_ms(BroadPhaseBench& bench, const BroadPhasePhase& phase) {
  constexpr int kRuns = 41;
  Executor& executor = bench.rig.executor;
  cudaEvent_t begin = nullptr, end = nullptr;
  check_cuda(cudaEventCreate(&begin), "cannot make an event");
  check_cuda(cudaEventCreate(&end), "cannot make an event");
  Recording recording;
  std::vector<float> times;
  for (int run = 0; run < kRuns; ++run) {
    check_cuda(cudaEventRecord(begin, executor.stream()), "cannot record an event");
    executor.record(recording, [&] { (bench.*phase.run)(); });
    check_cuda(cudaEventRecord(end, executor.stream()), "cannot record an event");
    executor.wait();
    float ms = 0;
    check_cuda(cudaEventElapsedTime(&ms, begin, end), "cannot time");
    times.push_back(ms);
  }
  (void)cudaEventDestroy(begin);
  (void)cudaEventDestroy(end);
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void print_case(const BroadPhaseCase& of) {
  BroadPhaseBench bench(of, 1);
  float ms[std::size(kBroadPhasePhases)];
  for (std::size_t p = 0; p < std::size(kBroadPhasePhases); ++p) ms[p] = median_ms(bench, kBroadPhasePhases[p]);
  const std::size_t pairs = bench.pairs.size();
  std::printf("%-24s %9zu pairs  extent %.4f  tree %.4f  query %.4f  all %.4f ms  %.4f ns/pair  hash %s\n", of.name,
              pairs, static_cast<double>(ms[0]), static_cast<double>(ms[1] - ms[0]), static_cast<double>(ms[2] - ms[1]),
              static_cast<double>(ms[2]), 1e6 * static_cast<double>(ms[2]) / static_cast<double>(pairs),
              hexadecimal(bench.hash()).c_str());
  std::fflush(stdout);
}

}  // namespace
}  // namespace plumb::impulse

int main() {
  try {
    for (const auto& of : plumb::impulse::kBroadPhaseCases) plumb::impulse::print_case(of);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_impulse_broadphase_cuda: %s\n", error.what());
    return 1;
  }
}
