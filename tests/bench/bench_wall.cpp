// What the wall costs: calls, bulk rows, creation and touch events, with a backend that computes next to nothing.
#include <benchmark/benchmark.h>

#include "plumb/backend/touch_tracker.hpp"
#include "plumb/loader.hpp"

namespace {

/// n particles in a world of the sample backend.
struct Particles {
  std::unique_ptr<plumb::IPhysicsWorld> world;
  std::vector<PlumbBody> ids;

  explicit Particles(std::size_t n)
      : world(plumb::open_backend(SAMPLE_BACKEND).create_world(plumb::world_desc(0))), ids(n) {
    const std::vector<PlumbBodyDesc> descs(n, particle());
    plumb::check(*world, world->create_bodies(descs, ids));
  }
  static PlumbBodyDesc particle() {
    PlumbBodyDesc desc = plumb::body_desc();
    desc.flags = PLUMB_BODY_NO_ROTATION;
    desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
    desc.mass = 1;
    desc.material.friction = 0;
    return desc;
  }
};

/// A step of an empty world: the price of the calls alone.
void empty_step(benchmark::State& state) {
  Particles particles(0);
  PlumbStepReport report{};
  for (auto _ : state) {
    plumb::check(*particles.world, particles.world->step(0.01));
    plumb::check(*particles.world, particles.world->wait(report));
  }
}
BENCHMARK(empty_step);

void read_poses(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  Particles particles(n);
  std::vector<double> rows(7 * n);
  const plumb::Rows out(reinterpret_cast<std::byte*>(rows.data()), n, 7 * sizeof(double), PLUMB_F64);
  const bool spelled_out = state.range(1) != 0;
  for (auto _ : state) {
    plumb::check(*particles.world,
                 particles.world->read(
                     PLUMB_FIELD_POSE,
                     spelled_out ? std::span<const PlumbBody>(particles.ids) : std::span<const PlumbBody>{}, out));
    benchmark::DoNotOptimize(rows.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(read_poses)
    ->ArgNames({"bodies", "by_handle"})
    ->Args({1000, 0})
    ->Args({1000, 1})
    ->Args({100000, 0})
    ->Args({100000, 1});

void create_and_destroy(benchmark::State& state) {
  Particles particles(0);
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<PlumbBodyDesc> descs(n, Particles::particle());
  std::vector<PlumbBody> ids(n);
  for (auto _ : state) {
    plumb::check(*particles.world, particles.world->create_bodies(descs, ids));
    plumb::check(*particles.world, particles.world->destroy_bodies(ids));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(create_and_destroy)->Arg(1)->Arg(1000);

void touch_events(benchmark::State& state) {
  const auto n = static_cast<PlumbBody>(state.range(0));
  plumb::backend::TouchTracker tracker;
  std::vector<PlumbEvent> events;
  for (auto _ : state) {
    for (PlumbBody body = 0; body < n; ++body)
      for (PlumbBody point = 0; point < 4; ++point) tracker.touch(body, body + 1);
    events.clear();
    tracker.finish_step(events);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(touch_events)->Arg(10000);

}  // namespace

BENCHMARK_MAIN();
