// Poses on their way from a CUDA device into the host's own memory: over the bus alone, and from there row by row, as
// they are, and that on several threads. Milliseconds, median of many. Needs no library beside the driver.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>

#include "plugin/rows/put_rows.hpp"

namespace plumb::impulse {
namespace {

struct FillRows {
  PoseRow* rows;
  PLUMB_HD void operator()(std::uint32_t i) const {
    for (int k = 0; k < 7; ++k) rows[i].numbers[k] = i + 0.125 * k;
  }
};

template <class F>
double median_ms(const F& f) {
  constexpr int kRuns = 31;
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    f();
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void print_size(std::uint32_t n) {
  Executor executor(nullptr, 1);
  Mirror<PoseRow> block;
  block.grow(n);
  executor.run(n, FillRows{block.device()});
  const double bus = median_ms([&] {
    executor.to_host(block, n);
    executor.wait();
  });
  std::vector<PlumbBody> ids(n);
  for (std::uint32_t i = 0; i < n; ++i) ids[i] = std::uint64_t{1} << 32 | i;
  std::vector<PlumbPose> poses(n);
  const Rows rows = rows_over(std::span<PlumbPose>(poses));
  const double by_row = median_ms([&] { put_rows(executor, ids, rows, [&](std::uint32_t i) { return block[i]; }); });
  std::printf("%8u poses  bus %.3f  row by row %.3f  as they are, by threads:", n, bus, by_row);
  for (const std::uint32_t threads : {1U, 2U, 4U, 8U, 16U}) {
    if (threads > Executor::max_threads()) break;
    Executor pool(nullptr, threads);
    std::fill(poses.begin(), poses.end(), PlumbPose{});
    const double ms = median_ms([&] { copy_rows(pool, block.host(), ids, rows); });
    const bool right = poses[n - 1].position.x == n - 1 && poses[n / 2].orientation.w == n / 2 + 0.75;
    std::printf("  %u: %.3f%s", threads, ms, right ? "" : " WRONG");
  }
  std::printf(" ms\n");
}

}  // namespace
}  // namespace plumb::impulse

int main() {
  try {
    for (const std::uint32_t n : {8000U, 64000U, 256000U, 901120U}) plumb::impulse::print_size(n);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_impulse_rows_cuda: %s\n", error.what());
    return 1;
  }
}
