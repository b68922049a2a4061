// Rays, overlaps and depths on a CUDA device: milliseconds of the rays' kernel by events, and of whole calls with the
// way there and back by the host's clock; and the hash of the rays' hits, which bench_impulse_queries prints on the CPU
// too. Needs no library beside the driver.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>

#include "tests/rigs/broad_phase_cases.hpp"
#include "tests/rigs/query_cases.hpp"

namespace plumb::impulse {
namespace {

constexpr int kRuns = 21;

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

double kernel_ms(QueryBench& bench) {
  Executor& executor = bench.rig.executor;
  const auto n = static_cast<std::uint32_t>(bench.rays().size());
  Buffer<PlumbRay> rays;
  rays.from_host(bench.rays().data(), n);
  Buffer<PlumbHit> hits(n);
  cudaEvent_t begin = nullptr, end = nullptr;
  check_cuda(cudaEventCreate(&begin), "cannot make an event");
  check_cuda(cudaEventCreate(&end), "cannot make an event");
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    check_cuda(cudaEventRecord(begin, executor.stream()), "cannot record an event");
    QueryBatch::closest_rays(executor, bench.rig.scene, rays.data(), n, hits.data());
    check_cuda(cudaEventRecord(end, executor.stream()), "cannot record an event");
    executor.wait();
    float ms = 0;
    check_cuda(cudaEventElapsedTime(&ms, begin, end), "cannot time");
    times.push_back(static_cast<double>(ms));
  }
  (void)cudaEventDestroy(begin);
  (void)cudaEventDestroy(end);
  return median(times);
}

template <class Ask>
double call_ms(const Ask& ask) {
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    ask();
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return median(times);
}

}  // namespace
}  // namespace plumb::impulse

int main() {
  try {
    for (const std::uint32_t rays : {1000U, 1000000U}) {
      plumb::impulse::QueryBench bench(32000, rays, 1);
      const double kernel = plumb::impulse::kernel_ms(bench), call = plumb::impulse::call_ms([&] { bench.ask(); });
      std::printf("%8u rays  kernel %.4f  call %.4f ms  %zu hits  hash %s\n", rays, kernel, call, bench.found(),
                  plumb::impulse::hexadecimal(bench.hash()).c_str());
      std::fflush(stdout);
    }
    for (const std::uint32_t cubes : {1000U, 100000U}) {
      plumb::impulse::QueryBench bench(32000, cubes, 1);
      const std::vector<PlumbOverlap> asked = bench.cubes();
      const double overlaps = plumb::impulse::call_ms([&] { (void)bench.rig.overlaps(asked); }),
                   depths = plumb::impulse::call_ms([&] { (void)bench.rig.penetrations(asked); });
      std::printf("%8u cubes  overlaps %.4f  depths %.4f ms  %zu rows\n", cubes, overlaps, depths,
                  bench.rig.penetrations(asked).size());
      std::fflush(stdout);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_impulse_queries_cuda: %s\n", error.what());
    return 1;
  }
}
