// The adapter's own cost: a step and a bulk read through plumb against the same written straight against ODE. Both run
// in turns, so that what else the machine does meets both alike.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "native_program.hpp"
#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

/// Steps of a run before those that are measured, and those.
struct Window {
  int warm_up, steps;
};

int most_steps = 1000000;  ///< of either; --steps=N

/// Of this thread's own work: what else the machine does is not our cost.
double cpu_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Program>
double seconds_of(Program& program, StateRows& rows) {
  const double start = cpu_seconds();
  program.step();
  program.read(rows);
  return cpu_seconds() - start;
}

/// One iteration: both programs from the start, step by step in turns; the sums over the window, and the median of the
/// ratios of single steps, which a disturbance of one step does not move.
void ratio(benchmark::State& state, const Scene& scene, Window window) {
  const int warm_up = std::min(window.warm_up, most_steps), last = warm_up + std::min(window.steps, most_steps);
  double native_total = 0, plumb_total = 0;
  StateRows rows;
  std::vector<double> ratios;
  for (auto _ : state) {
    NativeProgram native(scene);
    PlumbProgram program(scene);
    unsigned long native_seed = 0;
    for (int i = 0; i < last; ++i) {
      double n = 0, p = 0;
      const auto run_native = [&] {
        dRandSetSeed(native_seed);
        n = seconds_of(native, rows);
        native_seed = dRandGetSeed();
      };
      if (i % 2 == 0) run_native();
      p = seconds_of(program, rows);
      if (i % 2 != 0) run_native();
      if (i < warm_up) continue;
      native_total += n;
      plumb_total += p;
      ratios.push_back(p / n);
    }
  }
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
  const double runs = static_cast<double>(ratios.size());
  state.counters["native_ms"] = 1e3 * native_total / runs;
  state.counters["plumb_ms"] = 1e3 * plumb_total / runs;
  state.counters["ratio"] = plumb_total / native_total;
  state.counters["median_ratio"] = ratios[ratios.size() / 2];
}

// pyramid-100 collapses before step 300 and is measured while it stands.
BENCHMARK_CAPTURE(ratio, pile_1000, pile(1000), Window{0, 300})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ratio, pile_8000, pile(8000), Window{150, 60})->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(ratio, pyramid_20, pyramid(20), Window{0, 300})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ratio, pyramid_100, pyramid(100), Window{20, 60})->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace plumb::ode_test

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (int i = 1; i < argc; ++i)
    if (std::strncmp(argv[i], "--steps=", 8) == 0) plumb::ode_test::most_steps = std::max(1, std::atoi(argv[i] + 8));
  benchmark::RunSpecifiedBenchmarks();
}
