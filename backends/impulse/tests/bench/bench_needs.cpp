// What is left out of the step where a scene does not need it. Each row is a scene made for one saving. Three worlds
// are stepped in turn: the scene with its own needs, the same bodies doing the same where they need one thing more
// (with), and the scene with all needs that the engine has (all). Their times over the first one's are the counters.
//
// Balls have no manifolds, equal moments no gyroscopic term and scenes without joints no joint stage whatever is
// declared. There the one thing more is in the scene: cubes, moments that differ in the sixth place, idle joints.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

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
void rough_boxes(Scene& scene) { pile(scene, scene.box({0.5, 0.5, 0.5}), 700); }
void balls_that_do_not_turn(Scene& scene) {
  scene.body.material.friction = 0;
  scene.body.flags = PLUMB_BODY_NO_ROTATION;
  pile(scene, scene.sphere(0.5), 700);
}

/// Bodies on the ground and no higher than `levels` on each other, which touch nobody beside them.
void columns(Scene& scene, PlumbShape shape, int levels) {
  for (int i = 0; i < 900; ++i)
    scene.add(shape, {1.5 * (i % 30) - 22, 0.5 + i / 30 % levels, 1.5 * (i / 30 / levels) - 22});
}
void turning_balls_apart(Scene& scene) {
  scene.body.material.friction = 0;
  scene.ground();
  columns(scene, scene.sphere(0.5), 1);
}
void balls_apart(Scene& scene) {
  scene.body.flags = PLUMB_BODY_NO_ROTATION;
  turning_balls_apart(scene);
}
void columns_of_balls(Scene& scene) {
  scene.body.material.friction = 0;
  scene.body.flags = PLUMB_BODY_NO_ROTATION;
  scene.ground();
  columns(scene, scene.sphere(0.5), 2);
}
void columns_of_cubes(Scene& scene) {
  scene.body.material.friction = 0;
  scene.body.flags = PLUMB_BODY_NO_ROTATION;
  scene.ground();
  columns(scene, scene.box({0.5, 0.5, 0.5}), 2);
}

/// Moments in kg m2.
void spinning(Scene& scene, const PlumbVec3& half_extents, const PlumbVec3& inertia) {
  scene.body.material.friction = 0;
  scene.body.angular_velocity = {1, 2, 3};
  scene.body.mass_mode = PLUMB_MASS_EXPLICIT;
  scene.body.mass = 1;
  scene.body.inertia = inertia;
  const PlumbShape shape = scene.box(half_extents);
  for (int i = 0; i < 5000; ++i) scene.add(shape, {3.0 * i, 0, 0});
}
void spinning_bricks(Scene& scene) { spinning(scene, {0.2, 0.5, 1}, {0.42, 0.35, 0.1}); }
void spinning_cubes(Scene& scene) { spinning(scene, {0.5, 0.5, 0.5}, {1, 1, 1}); }
void spinning_almost_cubes(Scene& scene) { spinning(scene, {0.5, 0.5, 0.5}, {1, 1.000001, 0.999999}); }

/// Side by side and falling alike: joints between them have nothing to do.
void falling_pairs(Scene& scene) {
  scene.body.material.friction = 0;
  const PlumbShape ball = scene.sphere(0.2);
  for (int i = 0; i < 2000; ++i) scene.add(ball, {1.0 * i, 0, 0});
}
void falling_joined_pairs(Scene& scene) {
  falling_pairs(scene);
  const auto bodies = scene.world().bodies();
  for (std::size_t i = 0; i < bodies.size(); i += 2)
    scene.ball_joint(bodies[i], {0.5, 0, 0}, bodies[i + 1], {-0.5, 0, 0});
}

/// Pairs a metre apart on hinges of which one, with a limit, has a row that does not always hold.
void hinges(Scene& scene, bool limited) {
  falling_pairs(scene);
  const auto bodies = scene.world().bodies();
  for (std::size_t i = 0; i < bodies.size(); i += 2) {
    PlumbJointDesc hinge = joint_desc(PLUMB_JOINT_HINGE);
    hinge.body_a = bodies[i];
    hinge.body_b = bodies[i + 1];
    hinge.frame_a.position = {0.5, 0, 0};
    hinge.frame_b.position = {-0.5, 0, 0};
    if (limited && i == 0) hinge.limits[3] = {-1, 1, 1, 0};
    PlumbJoint id = 0;
    check(scene.world(), scene.world().joints()->create_joints({&hinge, 1}, {&id, 1}));
  }
}
void plain_hinges(Scene& scene) { hinges(scene, false); }
void hinges_and_a_limit(Scene& scene) { hinges(scene, true); }

/// Nobody comes near a step's way of anything, but all would have to be looked after.
void rough_boxes_of_ccd(Scene& scene) {
  scene.body.flags |= PLUMB_BODY_CCD;
  rough_boxes(scene);
}
/// A mesh of two triangles beside the container, which nobody touches.
void rough_boxes_by_a_mesh(Scene& scene) {
  rough_boxes(scene);
  const double vertices[] = {0, 0, 0, 0, 0, 5, 5, 0, 0, 5, 0, 5};
  const std::uint32_t indices[] = {0, 1, 2, 2, 1, 3};
  PlumbShapeDesc desc = shape_desc(PLUMB_TRIANGLE_MESH);
  desc.vertices = vertices;
  desc.vertex_count = 4;
  desc.indices = indices;
  desc.triangle_count = 2;
  scene.add_static(scene.make(desc), {20, 0, 0});
}
void rough_boxes_and_a_sensor(Scene& scene) {
  rough_boxes(scene);
  scene.body.flags |= PLUMB_BODY_SENSOR;
  scene.add_static(scene.box({7, 1, 7}), {0, 2, 0});
}
void rough_boxes_and_a_lift(Scene& scene) {
  rough_boxes(scene);
  scene.add_kinematic(scene.box({1, 1, 1}), {20, 0, 0});
}

/// Columns that have come to rest: asleep, or of bodies that never sleep.
void cubes_asleep(Scene& scene) {
  scene.ground();
  columns(scene, scene.box({0.5, 0.5, 0.5}), 2);
}
void cubes_awake(Scene& scene) {
  scene.body.flags |= PLUMB_BODY_NEVER_SLEEPS;
  cubes_asleep(scene);
}

double seconds_of_step(Scene& scene) {
  const auto start = std::chrono::steady_clock::now();
  scene.run(1);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double>& numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

using Build = void (*)(Scene&);

void saving(benchmark::State& state, PlumbNeeds needs, Build build, PlumbNeeds more, Build build_with) {
  const Backend backend = engine();
  Scene own(backend, needs, kDown, 1), with(backend, needs | more, kDown, 1),
      all(backend, all_needs(backend), kDown, 1);
  build(own);
  build_with(with);
  build(all);
  for (Scene* scene : {&own, &with, &all}) scene->run(60);
  std::vector<double> with_ratios, all_ratios;
  for (auto _ : state) {
    const double of_own = seconds_of_step(own);
    state.SetIterationTime(of_own);
    with_ratios.push_back(seconds_of_step(with) / of_own);
    all_ratios.push_back(seconds_of_step(all) / of_own);
  }
  state.counters["with_over_own"] = median(with_ratios);
  state.counters["all_over_own"] = median(all_ratios);
}

constexpr PlumbNeeds kRotation = PLUMB_NEED_ROTATION, kCollision = PLUMB_NEED_COLLISION;
constexpr PlumbNeeds kFriction = PLUMB_NEED_FRICTION, kGyroscopic = PLUMB_NEED_GYROSCOPIC;
constexpr PlumbNeeds kRough = kRotation | kCollision | kFriction;

#define SAVING(name, ...) \
  BENCHMARK_CAPTURE(saving, name, __VA_ARGS__)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(100)
SAVING(no_friction, kRotation | kCollision, &smooth_boxes, kFriction, &smooth_boxes);
SAVING(no_rotation_of_particles, 0, &particles, kRotation, &particles);
SAVING(no_rotation_of_balls, kCollision, &balls_apart, kRotation, &turning_balls_apart);
SAVING(no_joints, kRotation, &falling_pairs, PLUMB_NEED_JOINTS, &falling_joined_pairs);
SAVING(no_manifolds, kCollision, &columns_of_balls, 0, &columns_of_cubes);
SAVING(no_gyroscopic_term, kRotation, &spinning_bricks, kGyroscopic, &spinning_bricks);
SAVING(isotropic, kRotation | kGyroscopic, &spinning_cubes, 0, &spinning_almost_cubes);
SAVING(no_collision, kRotation, &spinning_cubes, kCollision, &spinning_cubes);
SAVING(no_restitution, kRough, &rough_boxes, PLUMB_NEED_RESTITUTION, &rough_boxes);
SAVING(no_sleeping, kRough, &rough_boxes, PLUMB_NEED_SLEEPING, &rough_boxes);
SAVING(asleep, kRough | PLUMB_NEED_SLEEPING, &cubes_asleep, 0, &cubes_awake);
SAVING(no_ccd, kRough, &rough_boxes, PLUMB_NEED_CCD, &rough_boxes_of_ccd);
SAVING(no_surfaces, kRough, &rough_boxes, 0, &rough_boxes_by_a_mesh);
SAVING(no_sensors, kRough, &rough_boxes, PLUMB_NEED_SENSORS, &rough_boxes_and_a_sensor);
SAVING(no_kinematics, kRough, &rough_boxes, PLUMB_NEED_KINEMATIC, &rough_boxes_and_a_lift);
SAVING(no_axis_locks, kRough, &rough_boxes, PLUMB_NEED_AXIS_LOCKS, &rough_boxes);
SAVING(no_queries, kRough, &rough_boxes, PLUMB_NEED_QUERIES, &rough_boxes);
SAVING(no_snapshots, kRough, &rough_boxes, PLUMB_NEED_SNAPSHOT, &rough_boxes);
SAVING(no_reactions, kRotation | PLUMB_NEED_JOINTS, &plain_hinges, PLUMB_NEED_JOINT_REACTIONS, &plain_hinges);
SAVING(no_joint_limits, kRotation | PLUMB_NEED_JOINTS, &plain_hinges, 0, &hinges_and_a_limit);
SAVING(no_events, kCollision, &balls_that_do_not_turn, PLUMB_NEED_EVENTS, &balls_that_do_not_turn);

}  // namespace
}  // namespace plumb::impulse::test

BENCHMARK_MAIN();
