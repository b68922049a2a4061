// What the profile layer adds to a call: one that does next to nothing, by itself, into a file, and to a sink.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "plumb/loader.hpp"
#include "plumb/profile.hpp"

namespace {

/// A host's profiler that keeps nothing.
class Silent final : public plumb::layers::ProfileSink {
 public:
  void begin(const plumb::layers::ProfileZone&) noexcept override {}
  void end(const plumb::layers::ProfileZone& zone) noexcept override { benchmark::DoNotOptimize(zone.duration); }
  void stepped(const plumb::layers::ProfiledStep& step) noexcept override {
    benchmark::DoNotOptimize(step.zone.duration);
  }
};

enum Way { bare, file, sink };

const PlumbBackendTable* way_to(const PlumbBackendTable* table, std::int64_t way) {
  static Silent silent;
  static const std::string path = (std::filesystem::temp_directory_path() / "plumb-bench.profile.json").string();
  if (way == file) return plumb::layers::profile(table, path);
  if (way == sink) return plumb::layers::profile(table, silent);
  return table;
}

void set_gravity(benchmark::State& state) {
  static const plumb::Backend backend = plumb::open_backend(SAMPLE_BACKEND);
  const PlumbBackendTable* table = way_to(&backend.table(), state.range(0));
  PlumbWorld* world = nullptr;
  const PlumbWorldDesc desc = plumb::world_desc(0);
  table->create_world(&desc, &world);
  const PlumbVec3 gravity = {0, 0, -9.81};
  for (auto _ : state) benchmark::DoNotOptimize(table->set_gravity(world, &gravity));
  table->destroy_world(world);
  if (state.range(0) != bare) plumb::layers::end_profile(table);
}
BENCHMARK(set_gravity)->ArgName("way")->Arg(bare)->Arg(file)->Arg(sink);

void step(benchmark::State& state) {
  static const plumb::Backend backend = plumb::open_backend(SAMPLE_BACKEND);
  const PlumbBackendTable* table = way_to(&backend.table(), state.range(0));
  PlumbWorld* world = nullptr;
  const PlumbWorldDesc desc = plumb::world_desc(0);
  table->create_world(&desc, &world);
  const PlumbStepDesc step = {sizeof step, 0, 0.01};
  PlumbStepReport report{};
  report.struct_size = sizeof report;
  for (auto _ : state) {
    table->step(world, &step);
    table->wait(world, &report);
  }
  table->destroy_world(world);
  if (state.range(0) != bare) plumb::layers::end_profile(table);
}
BENCHMARK(step)->ArgName("way")->Arg(bare)->Arg(file)->Arg(sink);

}  // namespace

BENCHMARK_MAIN();
