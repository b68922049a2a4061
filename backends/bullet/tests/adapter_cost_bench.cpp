// What the adapter costs: the same scene behind the interface and in plain Bullet, step by step in turn in one run,
// each with poses and velocities read out as float rows. Both do the same arithmetic, so that every pair of steps
// compares.
#include <benchmark/benchmark.h>

#include <time.h>

#include <algorithm>

#include "native_scene.hpp"
#include "plumb_scene.hpp"

namespace {

using PoseRow = std::array<float, 7>;
using VelocityRow = std::array<float, 6>;

/// Of this thread, so that what else runs on the machine does not count.
double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Work>
double seconds(Work&& work) {
  const double start = cpu_seconds();
  work();
  return cpu_seconds() - start;
}

template <class Row>
plumb::Rows float_rows(std::vector<Row>& rows) {
  return {reinterpret_cast<std::byte*>(rows.data()), rows.size(), sizeof(Row), PLUMB_F32};
}

void step_ours(scenes::PlumbScene& scene, std::vector<PoseRow>& poses, std::vector<VelocityRow>& velocities) {
  scenes::advance(*scene.world);
  plumb::check(*scene.world, scene.world->read(PLUMB_FIELD_POSE, {}, float_rows(poses)));
  plumb::check(*scene.world, scene.world->read(PLUMB_FIELD_VELOCITY, {}, float_rows(velocities)));
}

void step_native(scenes::NativeScene& scene, std::vector<PoseRow>& poses, std::vector<VelocityRow>& velocities) {
  scene.step(1.0 / 60);
  const auto put = [](const btVector3& v, float* row) {
    for (int i = 0; i < 3; ++i) row[i] = static_cast<float>(v[i]);
  };
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const btRigidBody& body = *scene.bodies[i];
    const btQuaternion q = body.getOrientation();
    put(body.getWorldTransform().getOrigin(), poses[i].data());
    for (int k = 0; k < 4; ++k) poses[i][static_cast<std::size_t>(3 + k)] = static_cast<float>(q[k]);
    put(body.getLinearVelocity(), velocities[i].data());
    put(body.getAngularVelocity(), velocities[i].data() + 3);
  }
}

/// What else runs on the machine can only add.
double lower_quartile(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 4];
}

void adapter_cost(benchmark::State& state, const scenes::Scene& scene, PlumbNeeds needs, int warm_up) {
  scenes::PlumbScene ours(scene, needs);
  scenes::NativeScene native(scene);
  std::vector<PoseRow> our_poses(scene.items.size()), native_poses(scene.items.size());
  std::vector<VelocityRow> our_velocities(scene.items.size()), native_velocities(scene.items.size());
  for (int i = 0; i < warm_up; ++i) {
    step_ours(ours, our_poses, our_velocities);
    step_native(native, native_poses, native_velocities);
  }
  std::vector<double> our_times, native_times;
  bool ours_first = true;
  for (auto _ : state) {
    double our_time = 0, native_time = 0;
    const auto run_ours = [&] { our_time = seconds([&] { step_ours(ours, our_poses, our_velocities); }); };
    const auto run_native = [&] {
      native_time = seconds([&] { step_native(native, native_poses, native_velocities); });
    };
    if (ours_first) run_ours();
    run_native();
    if (!ours_first) run_ours();
    ours_first = !ours_first;
    our_times.push_back(our_time);
    native_times.push_back(native_time);
  }
  if (our_poses != native_poses) state.SkipWithError("the two runs differ, so that their times do not compare");
  state.counters["native_us"] = 1e6 * lower_quartile(native_times);
  state.counters["adapter_us"] = 1e6 * lower_quartile(our_times);
  state.counters["ratio"] = lower_quartile(our_times) / lower_quartile(native_times);
}

constexpr PlumbNeeds kWithContacts =
    scenes::kNeeds | PLUMB_NEED_EVENTS | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES;

// The last number: steps before the window that is measured. The piles lie by then; pyramid-100 collapses before step
// 300 and is measured while it stands.
BENCHMARK_CAPTURE(adapter_cost, pile_1000, scenes::pile(1000), scenes::kNeeds, 200);
BENCHMARK_CAPTURE(adapter_cost, pile_8000, scenes::pile(8000), scenes::kNeeds, 250)->Iterations(60);
BENCHMARK_CAPTURE(adapter_cost, pyramid_20, scenes::pyramid(20), scenes::kNeeds, 60);
BENCHMARK_CAPTURE(adapter_cost, pyramid_100, scenes::pyramid(100), scenes::kNeeds, 20)->Iterations(60);
BENCHMARK_CAPTURE(adapter_cost, pile_1000_events_declared, scenes::pile(1000), kWithContacts, 200);

}  // namespace
