// What a scene saves by saying what it needs: each made for one saving, stepped in turn with its own needs and with all
// that the engine has. The ratio of the two is the counter all_over_own.
#include <benchmark/benchmark.h>

#include <chrono>

#include "engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbVec3 kDown = {0, -9.81, 0};

PlumbNeeds all_needs(const Backend& backend) {
  PlumbNeeds needs = 0;
  for (std::uint32_t bit = 0; bit < PLUMB_NEED_COUNT; ++bit)
    if (backend.capability(PLUMB_CAP_NEED, bit) != PLUMB_NONE) needs |= PlumbNeeds{1} << bit;
  return needs;
}

void particles(Scene& scene) {
  scene.body.material.friction = 0;
  scene.body.flags = PLUMB_BODY_NO_ROTATION;
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = 1;
  for (int i = 0; i < 20000; ++i) scene.add(0, {1.0 * i, 0, 0});
}

void pile(Scene& scene, PlumbShape shape, int count) {
  scene.container(7, 60);
  for (int i = 0; i < count; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const bool turns = (scene.body.flags & PLUMB_BODY_NO_ROTATION) == 0;
    scene.add(shape,
              {1.2 * (i % 10) - 5.4 + random.between(-0.05, 0.05), 1 + 1.2 * (i / 100), 1.2 * (i / 10 % 10) - 5.4},
              turns ? random.turn() : PlumbQuat{0, 0, 0, 1});
  }
}
void smooth_boxes(Scene& scene) {
  scene.body.material.friction = 0;
  pile(scene, scene.box({0.5, 0.5, 0.5}), 700);
}
void smooth_balls(Scene& scene) {
  scene.body.material.friction = 0;
  scene.body.flags = PLUMB_BODY_NO_ROTATION;
  pile(scene, scene.sphere(0.5), 700);
}
void rough_boxes(Scene& scene) { pile(scene, scene.box({0.5, 0.5, 0.5}), 700); }

void spinning(Scene& scene, const PlumbVec3& half_extents) {
  scene.body.material.friction = 0;
  scene.body.angular_velocity = {1, 2, 3};
  const PlumbShape shape = scene.box(half_extents);
  for (int i = 0; i < 5000; ++i) scene.add(shape, {3.0 * i, 0, 0});
}
void spinning_bricks(Scene& scene) { spinning(scene, {0.2, 0.5, 1}); }
void spinning_cubes(Scene& scene) { spinning(scene, {0.5, 0.5, 0.5}); }

double seconds_of_step(Scene& scene) {
  const auto start = std::chrono::steady_clock::now();
  scene.run(1);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void saving(benchmark::State& state, PlumbNeeds needs, PlumbNeeds more, void (*build)(Scene&)) {
  const Backend backend = engine();
  const PlumbNeeds all = more == 0 ? all_needs(backend) : needs | more;
  Scene own(backend, needs, kDown, 1), full(backend, all, kDown, 1);
  build(own);
  build(full);
  own.run(60);
  full.run(60);
  std::vector<double> ratios;
  for (auto _ : state) {
    const double of_own = seconds_of_step(own), of_full = seconds_of_step(full);
    state.SetIterationTime(of_own);
    ratios.push_back(of_full / of_own);
  }
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
  state.counters["all_over_own"] = ratios[ratios.size() / 2];
}

constexpr PlumbNeeds kTurning = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION;
constexpr PlumbNeeds kRough = kTurning | PLUMB_NEED_FRICTION;

#define SAVING(name, needs, more, build) \
  BENCHMARK_CAPTURE(saving, name, needs, more, build)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(100)
SAVING(particles, PlumbNeeds{0}, 0, &particles);
SAVING(no_friction, kTurning, PLUMB_NEED_FRICTION, &smooth_boxes);
SAVING(balls_that_do_not_turn, PLUMB_NEED_COLLISION, 0, &smooth_balls);
SAVING(no_collision, PLUMB_NEED_ROTATION, PLUMB_NEED_COLLISION, &spinning_cubes);
SAVING(no_gyroscopic_term, PLUMB_NEED_ROTATION, PLUMB_NEED_GYROSCOPIC, &spinning_bricks);
SAVING(isotropic, PLUMB_NEED_ROTATION, PLUMB_NEED_GYROSCOPIC, &spinning_cubes);
SAVING(no_joints, kRough, PLUMB_NEED_JOINTS, &rough_boxes);
SAVING(no_restitution, kRough, PLUMB_NEED_RESTITUTION, &rough_boxes);
SAVING(no_impulses, kRough, PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES, &rough_boxes);
SAVING(no_events, kRough, PLUMB_NEED_EVENTS, &rough_boxes);

}  // namespace
}  // namespace plumb::impulse::test

BENCHMARK_MAIN();
