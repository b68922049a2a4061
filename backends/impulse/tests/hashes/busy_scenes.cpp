#include "tests/hashes/busy_scenes.hpp"

#include <cmath>

#include "tests/hashes/shape_scenes.hpp"
#include "tests/rigs/rope_bridge.hpp"

namespace plumb::impulse::test {

void comers(Scene& scene) {
  scene.container(3, 30);
  scene.before_step = [shapes = convex_shapes(scene), bodies = std::vector<PlumbBody>()](Scene& all, int step) mutable {
    Random random(static_cast<std::uint64_t>(step) + 9000);
    if (step >= 90) return;
    for (int i = 0; i < 3; ++i) {
      const PlumbQuat turn = random.turn();  // one after the other: arguments have no order
      const PlumbVec3 at = {random.between(-2.5, 2.5), 5.0 + i, random.between(-2.5, 2.5)};
      bodies.push_back(all.add(shapes[static_cast<std::size_t>(random.next() % shapes.size())], at, turn));
    }
    for (int i = 0; i < 2 && step > 40; ++i) {
      const auto gone = bodies.begin() + static_cast<std::ptrdiff_t>(random.next() % bodies.size());
      all.remove(*gone);
      bodies.erase(gone);
    }
  };
}

void machines(Scene& scene) {
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5}), plate = scene.box({0.2, 0.6, 0.6});
  for (int i = 0; i < 3; ++i) scene.add(cube, {1.0 * i, 0.5, 0});
  const PlumbBody left = scene.add_kinematic(plate, {-0.9, 0.7, 0}), right = scene.add_kinematic(plate, {2.9, 0.7, 0});
  const PlumbBody table = scene.add_kinematic(scene.box({2, 0.1, 2}), {8, 0.1, 0});
  const PlumbBody lift = scene.add_kinematic(scene.box({1, 0.1, 1}), {0, 0.1, 6});
  const PlumbBody wall = scene.add_static(plate, {12, 0.6, 0});
  for (int i = 0; i < 4; ++i) scene.add(cube, {7.3 + 1.3 * (i % 2), 0.7, 1.3 * (i / 2) - 0.6});
  for (int i = 0; i < 3; ++i) scene.add(cube, {0, 0.7 + i, 6});
  scene.before_step = [=, sine = 0.0, cosine = 1.0](Scene& all, int step) mutable {
    const double closed = step < 120 ? 0.002 * step : step < 200 ? 0.24 : 0;
    all.target(left, {-0.9 + closed, 0.7, 0});
    all.target(right, {2.9 - closed, 0.7, 0});
    // by half of .04 rad, about
    const double s = sine + 0.02 * cosine, c = cosine - 0.02 * sine, size = std::sqrt(s * s + c * c);
    sine = s / size;
    cosine = c / size;
    all.target(table, {8, 0.1, 0}, {0, sine, 0, cosine});
    const int phase = step % 100;
    all.target(lift, {0, 0.1 + 0.01 * (phase < 50 ? phase : 100 - phase), 6});
    if (step == 150) all.write(PLUMB_FIELD_POSE, wall, {8.5, 1.2, 0.5, 0, 0, 0, 1});
  };
}

void islands(Scene& scene) {
  scene.container(8, 10);
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  Random random(48);
  for (int i = 0; i < 300; ++i) {
    const PlumbQuat turn = random.turn();
    scene.add(cube, {1.3 * (i % 6) - 7, 1.0 + 1.3 * (i / 36), 1.3 * (i / 6 % 6) - 4}, turn);
  }
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  for (int i = 0; i < 5; ++i) {
    constexpr double kRatios[] = {6, 20, 100, 1000, 10000};
    scene.body.mass = 10;
    scene.add(cube, {5, 0.5, 2.5 * i - 5});
    scene.body.mass = 10 * kRatios[i];
    scene.add(cube, {5.1, 1.5, 2.5 * i - 5});
  }
  scene.body.material.restitution = 0.7;
  scene.body.mass = 5;
  scene.add(scene.sphere(0.4), {6.9, 4, 0});
}

void belts(Scene& scene) {
  scene.ground();
  const PlumbShape belt = scene.box({2, 0.2, 0.8});
  const auto run = [](Scene& all, PlumbBody body, const PlumbVec3& speed) {
    all.write(PLUMB_FIELD_SURFACE_VELOCITY, body, {speed.x, speed.y, speed.z});
  };
  const PlumbBody level = scene.add_static(belt, {0, 0.5, 0});
  const PlumbBody uphill = scene.add_static(belt, {3.9, 0.9, 0}, {0, 0, 0.1, std::sqrt(0.99)});
  const PlumbBody corner = scene.add_static(belt, {-2.5, 0.4, 1.5}, {0, 0.6, 0, 0.8});
  const PlumbBody carriage = scene.add_kinematic(belt, {0, 0.5, -3});
  run(scene, level, {1.5, 0, 0});
  run(scene, uphill, {2, 0, 0});
  run(scene, corner, {0, 0, -1});
  run(scene, carriage, {-0.8, 0, 0.2});
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  Random random(46);
  for (int i = 0; i < 40; ++i) {
    const PlumbQuat turn = random.turn();
    scene.add(shapes[static_cast<std::size_t>(i % 5)],
              {random.between(-3, 3), 1.2 + 0.15 * i, i % 4 == 3 ? -3.0 : random.between(-0.6, 0.6)}, turn);
  }
  scene.before_step = [=](Scene& all, int step) {
    all.target(carriage, {0.01 * step, 0.5, -3});
    if (step == 200) run(all, level, {-1.5, 0, 0});
  };
}

void rollers(Scene& scene) {
  scene.body.spinning_friction = 0.01;
  scene.container(4, 30);
  scene.add_static(scene.box({3, 0.2, 1}), {-1, 0.6, 2}, {0, 0, 0.1, std::sqrt(0.99)});
  scene.body.material.surface_velocity = {1, 0, 0};
  scene.add_static(scene.box({3, 0.2, 1}), {0, 0.2, -2});
  scene.body.material.surface_velocity = {0, 0, 0};
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  Random random(53);
  std::vector<PlumbBody> bodies;
  for (int i = 0; i < 70; ++i) {
    constexpr double kRolling[] = {0, 0.01, 0.05, 0.2};
    scene.body.rolling_friction = kRolling[i % 4];
    scene.body.spinning_friction = kRolling[i / 4 % 4] / 2;
    scene.body.material.restitution = i % 3 == 0 ? 0.4 : 0;
    scene.body.flags = i % 10 == 9 ? PLUMB_BODY_CCD : 0;
    const PlumbQuat turn = random.turn();
    const double x = random.between(-3, 3), z = random.between(-3, 3);
    scene.body.angular_velocity = {0, random.between(-5, 5), random.between(-5, 5)};
    bodies.push_back(scene.add(shapes[static_cast<std::size_t>(i % 5)], {x, 1.5 + 0.2 * i, z}, turn));
    if (i % 7 == 6) scene.ball_joint(bodies[bodies.size() - 2], {0.6, 0, 0}, bodies.back(), {-0.6, 0, 0});
  }
  scene.before_step = [=](Scene& all, int step) {
    if (step % 40 != 39) return;
    const auto i = static_cast<std::size_t>(step);
    all.write(PLUMB_FIELD_ROLLING_FRICTION, bodies[i % bodies.size()], {0.001 * (step % 13), 0.001 * (step % 7)});
  };
}

void heavy_bridge(Scene& scene) {
  const RopeBridge bridge = rope_bridge(scene);
  for (int i = 0; i < 8; ++i) person(scene, bridge, 2000, 1.4 * (i - 3.5));
}

void far_off(Scene& scene) {
  constexpr double kX = 1e5, kZ = -7e4;
  scene.ground(kX, kZ);
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5}), link = scene.capsule(0.1, 0.3);
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  for (int i = 0; i < 8; ++i) scene.add(cube, {kX, 0.5 + i, kZ});
  Random random(45);
  for (int i = 0; i < 60; ++i)
    scene.add(shapes[static_cast<std::size_t>(i % 5)],
              {kX + 4 + 0.6 * (i % 4), 0.6 + 0.6 * (i / 16), kZ + 0.6 * (i / 4 % 4)}, random.turn());
  PlumbBody before = 0;
  for (int i = 0; i < 6; ++i) {
    const PlumbBody here = scene.add(link, {kX - 3, 6 - 0.8 * i, kZ + 0.05 * i});
    scene.ball_joint(before, before == 0 ? PlumbVec3{kX - 3, 6.4, kZ} : PlumbVec3{0, -0.4, 0}, here, {0, 0.4, 0});
    before = here;
  }
}

}  // namespace plumb::impulse::test
