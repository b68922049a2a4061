// Sleeping: who falls asleep and who wakes, and that nobody who is awake can tell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

#include "islands/islands.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kSleepNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                   PLUMB_NEED_SLEEPING | PLUMB_NEED_EVENTS | PLUMB_NEED_CONTACTS |
                                   PLUMB_NEED_CONTACT_IMPULSES | PLUMB_NEED_JOINTS | PLUMB_NEED_KINEMATIC |
                                   PLUMB_NEED_FORCES | PLUMB_NEED_RESTITUTION;

double read_one(Scene& scene, PlumbField field, PlumbBody body, std::size_t column, std::size_t columns) {
  std::vector<double> row(columns);
  check(scene.world(),
        scene.world().read(field, {&body, 1},
                           Rows(reinterpret_cast<std::byte*>(row.data()), 1, columns * sizeof(double), PLUMB_F64)));
  return row[column];
}
bool is_awake(Scene& scene, PlumbBody body) { return read_one(scene, PLUMB_FIELD_AWAKE, body, 0, 1) != 0; }
double velocity(Scene& scene, PlumbBody body, std::size_t axis) {
  return read_one(scene, PLUMB_FIELD_VELOCITY, body, axis, 6);
}

/// A tower of unit cubes of 1,000 kg on the ground.
struct Tower {
  explicit Tower(Scene& scene, int height, double x = 0) {
    const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
    scene.body.mass_mode = PLUMB_MASS_FROM_DENSITY;
    scene.body.density = 1000;
    for (int i = 0; i < height; ++i) cubes.push_back(scene.add(cube, {x, i + 0.5, 0}));
  }
  std::vector<PlumbBody> cubes;
};

struct Asleep : ::testing::Test {
  Scene scene{engine(), kSleepNeeds, kDown, 1};
  /// Until all of them sleep; fails after ten seconds.
  void let_sleep(const std::vector<PlumbBody>& bodies) {
    for (int step = 0; step < 600; ++step) {
      scene.run(1);
      if (std::none_of(bodies.begin(), bodies.end(), [&](PlumbBody body) { return is_awake(scene, body); })) return;
    }
    FAIL() << "somebody is still awake";
  }
};

TEST_F(Asleep, ATowerFallsAsleepAsOneAndLiesStill) {
  scene.ground();
  const Tower tower(scene, 10);
  let_sleep(tower.cubes);
  int told = 0;
  for (const PlumbEvent& event : scene.world().events())
    if (event.type == PLUMB_EVENT_SLEEP) ++told;
  EXPECT_EQ(told, 10) << "all of an island at once";
  const std::uint64_t still = scene.hash();
  const std::size_t points = scene.world().contacts().size();
  EXPECT_EQ(points, 40U);
  for (int step = 0; step < 100; ++step) {
    scene.run(1);
    EXPECT_TRUE(scene.world().events().empty());
  }
  EXPECT_EQ(scene.hash(), still);
  EXPECT_EQ(scene.world().contacts().size(), points) << "sleepers still touch";
}

/// Contacts of a colour are solved at once, and so none of them may push what another pushes.
void expect_colours_apart(Scene& scene, PlumbBody body) {
  std::span<const PlumbDebugConstraint> constraints;
  check(scene.world(), scene.world().debug()->solved_constraints(constraints));
  std::vector<std::int32_t> colours;
  for (const PlumbDebugConstraint& each : constraints)
    if (each.body_a == body || each.body_b == body) colours.push_back(each.colour);
  std::ranges::sort(colours);
  EXPECT_TRUE(std::ranges::adjacent_find(colours) == colours.end()) << ::testing::PrintToString(colours);
}

TEST_F(Asleep, WhatComesToTouchASleeperHasAColourOfItsOwnWhenItWakes) {
  scene.ground();
  const PlumbBody crate = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  let_sleep({crate});
  const PlumbBody pusher = scene.add_kinematic(scene.box({0.5, 0.4, 0.5}), {-1, 0.5, 0});
  int pushed = 0;
  for (int step = 0; step < 60; ++step) {
    if (step >= 10) scene.target(pusher, {-1 + 0.01 * (step - 9), 0.5, 0});
    scene.run(1);
    const bool awake = is_awake(scene, crate);
    if (step < 10) {
      EXPECT_FALSE(awake) << "what stands beside it lets it sleep";
    }
    if (pushed > 0) expect_colours_apart(scene, crate);
    pushed += awake ? 1 : 0;
  }
  EXPECT_GT(pushed, 40);
}

TEST_F(Asleep, WakingKeepsTheImpulses) {
  scene.ground();
  const Tower tower(scene, 20);
  const auto height = [&] { return scene.poses().back().position.y; };
  std::deque<double> last;  // before each of the last ten steps that the tower was awake
  for (int step = 0; step < 600 && is_awake(scene, tower.cubes.back()); ++step) {
    last.push_back(height());
    if (last.size() > 10) last.pop_front();
    scene.run(1);
  }
  const double sank = last.front() - height();
  scene.run(20);
  const double top = height();
  scene.write(PLUMB_FIELD_AWAKE, tower.cubes[7], {1});
  scene.run(1);
  EXPECT_TRUE(is_awake(scene, tower.cubes[0])) << "the whole island";
  double from_ground = 0;
  for (const PlumbContact& contact : scene.world().contacts())
    if (contact.body_b == tower.cubes[0] && std::abs(contact.position.y) < 0.1)
      from_ground += contact.normal_impulse;
    else if (contact.body_a == tower.cubes[0] && std::abs(contact.position.y) < 0.1)
      from_ground += contact.normal_impulse;
  const double weight = 20 * 1000 * 9.81 / 60;
  EXPECT_NEAR(from_ground, weight, 0.02 * weight) << "in the first step, as if it had not slept";
  scene.run(10);
  EXPECT_NEAR(height(), top, sank) << "it goes on to settle, and no faster than before it slept";
}

/// Against a wall the ball would come back. Two equal balls, e = 1: the sleeper goes on with the speed of the other.
TEST(Sleep, ABlowFindsTheSleeperAwake) {
  Scene scene(engine(), kSleepNeeds, {0, 0, 0}, 1);
  const PlumbShape ball = scene.sphere(0.5);
  scene.body.material.restitution = 1;
  scene.body.flags = PLUMB_BODY_ASLEEP;
  const PlumbBody sleeper = scene.add(ball, {0, 0, 0});
  scene.body.flags = 0;
  scene.body.linear_velocity = {5, 0, 0};
  const PlumbBody striker = scene.add(ball, {-3, 0, 0});
  EXPECT_FALSE(is_awake(scene, sleeper));
  scene.run(10);
  EXPECT_FALSE(is_awake(scene, sleeper));
  scene.run(40);
  EXPECT_TRUE(is_awake(scene, sleeper));
  EXPECT_NEAR(velocity(scene, sleeper, 0), 5, 1e-4);
  EXPECT_NEAR(velocity(scene, striker, 0), 0, 1e-4);
}

/// A row of touching sleepers, each an island of its own: who is struck wakes them all in that step.
TEST(Sleep, ABlowGoesThroughMany) {
  Scene scene(engine(), kSleepNeeds, {0, 0, 0}, 1);
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  std::vector<PlumbBody> cubes;
  scene.body.flags = PLUMB_BODY_ASLEEP;
  for (int i = 0; i < 5; ++i) cubes.push_back(scene.add(cube, {1.0 * i, 0, 0}));
  scene.body.flags = 0;
  scene.body.linear_velocity = {6, 0, 0};
  cubes.push_back(scene.add(cube, {-3, 0, 0}));
  while (!is_awake(scene, cubes[0])) scene.run(1);
  for (const PlumbBody body : cubes) EXPECT_TRUE(is_awake(scene, body));
  scene.run(5);
  double momentum = 0;
  for (const PlumbBody body : cubes) momentum += velocity(scene, body, 0);
  EXPECT_GT(velocity(scene, cubes[4], 0), 0.1) << "the last of the row";
  EXPECT_NEAR(momentum, 6, 1e-4);
}

TEST_F(Asleep, IslandsSleepAndWakeApart) {
  scene.ground();
  const Tower here(scene, 4), there(scene, 4, 10);
  let_sleep(here.cubes);
  let_sleep(there.cubes);
  scene.write(PLUMB_FIELD_IMPULSE, here.cubes[3], {100, 0, 0});
  EXPECT_TRUE(is_awake(scene, here.cubes[0]));
  EXPECT_FALSE(is_awake(scene, there.cubes[0]));
  scene.run(3);
  int woken = 0;
  EXPECT_FALSE(is_awake(scene, there.cubes[0]));
  let_sleep(here.cubes);
  scene.write(PLUMB_FIELD_VELOCITY, here.cubes[0], {0, 0, 0, 0, 0, 0});
  scene.run(1);
  for (const PlumbEvent& event : scene.world().events())
    if (event.type == PLUMB_EVENT_WAKE) ++woken;
  EXPECT_EQ(woken, 4);
}

TEST_F(Asleep, WhatIsTakenAwayBelowIsMissed) {
  const PlumbBody floor = scene.add_static(scene.box({5, 0.5, 5}), {0, -0.5, 0});
  const Tower tower(scene, 3);
  let_sleep(tower.cubes);
  scene.remove(floor);
  EXPECT_TRUE(is_awake(scene, tower.cubes[0]));
  scene.run(30);
  EXPECT_LT(velocity(scene, tower.cubes[2], 1), -4);
}

TEST_F(Asleep, AFloorThatIsPutElsewhereIsMissed) {
  const PlumbBody floor = scene.add_static(scene.box({5, 0.5, 5}), {0, -0.5, 0});
  const Tower tower(scene, 2);
  let_sleep(tower.cubes);
  scene.write(PLUMB_FIELD_POSE, floor, {0, -20, 0, 0, 0, 0, 1});
  scene.run(30);
  EXPECT_LT(velocity(scene, tower.cubes[1], 1), -4);
}

TEST_F(Asleep, GravityWakesAll) {
  scene.ground();
  const Tower tower(scene, 2);
  let_sleep(tower.cubes);
  check(scene.world(), scene.world().set_gravity({0, 9.81, 0}));
  scene.run(30);
  EXPECT_GT(velocity(scene, tower.cubes[0], 1), 4);
}

TEST_F(Asleep, WhoIsJoinedSleepsTogether) {
  const PlumbShape bead = scene.sphere(0.1);
  std::vector<PlumbBody> chain;
  for (int i = 0; i < 5; ++i) {
    chain.push_back(scene.add(bead, {0, -1.0 * i, 0}));
    if (i == 0)
      scene.ball_joint(0, {0, 0, 0}, chain[0], {0, 0, 0});
    else
      scene.ball_joint(chain[static_cast<std::size_t>(i) - 1], {0, -1, 0}, chain[static_cast<std::size_t>(i)],
                       {0, 0, 0});
  }
  let_sleep(chain);
  const std::uint64_t still = scene.hash();
  scene.run(50);
  EXPECT_EQ(scene.hash(), still);
  scene.write(PLUMB_FIELD_IMPULSE, chain[4], {1, 0, 0});
  for (const PlumbBody body : chain) EXPECT_TRUE(is_awake(scene, body));
  scene.write(PLUMB_FIELD_AWAKE, chain[2], {0});
  for (const PlumbBody body : chain) EXPECT_FALSE(is_awake(scene, body)) << "by hand, too";
  scene.run(20);
  EXPECT_FALSE(is_awake(scene, chain[2]));
}

TEST_F(Asleep, NobodySleepsOnWhatMoves) {
  const PlumbBody belt = scene.add_kinematic(scene.box({5, 0.5, 5}), {0, -0.5, 0});
  scene.write(PLUMB_FIELD_VELOCITY, belt, {0.01, 0, 0, 0, 0, 0});
  const Tower tower(scene, 2);
  scene.run(200);
  EXPECT_TRUE(is_awake(scene, tower.cubes[1])) << "slow as it is";
  scene.write(PLUMB_FIELD_VELOCITY, belt, {0, 0, 0, 0, 0, 0});
  let_sleep(tower.cubes);
  scene.run(20);
  EXPECT_FALSE(is_awake(scene, tower.cubes[1])) << "a kinematic body at rest lets them sleep on";
  scene.write(PLUMB_FIELD_VELOCITY, belt, {0, 1, 0, 0, 0, 0});
  scene.run(10);
  EXPECT_TRUE(is_awake(scene, tower.cubes[1]));
  EXPECT_NEAR(velocity(scene, tower.cubes[1], 1), 1, 0.05);
}

/// A motor may drive slower than what counts as rest: a lift with a box on it, and a wheel that turns another. One that
/// stands at a stop, holds at no speed, or is too weak lets its island sleep.
TEST_F(Asleep, NobodySleepsWhomAMotorMoves) {
  scene.ground();
  scene.body.mass_mode = PLUMB_MASS_FROM_DENSITY;
  scene.body.density = 100;
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  const auto lift = [&](double x, double speed, double force, double stop) {
    const PlumbBody body = scene.add(cube, {x, 2, 0});
    PlumbJointDesc slider = joint_desc(PLUMB_JOINT_SLIDER);
    slider.body_b = body;
    slider.frame_a = {{x, 2, 0}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}};
    slider.frame_b.orientation = slider.frame_a.orientation;
    slider.motors[0] = {speed, force, 1, 0};
    slider.limits[0] = {-0.1, stop, 1, 0};
    scene.join(slider);
    return body;
  };
  const PlumbBody lifts[] = {lift(-6, 0.01, 1e5, 10), lift(-4, 0.01, 1e5, 0.05), lift(-2, 0, 1e5, 10),
                             lift(0, 0.01, 1, 10)};
  const PlumbBody box = scene.add(cube, {-6, 3, 0});
  const PlumbBody wheels[] = {scene.add(cube, {4, 3, 0}), scene.add(cube, {6, 3, 0})};
  for (const PlumbBody wheel : wheels) {
    PlumbJointDesc hinge = joint_desc(PLUMB_JOINT_HINGE);
    hinge.body_b = wheel;
    hinge.frame_a.position = {wheel == wheels[0] ? 4.0 : 6.0, 3, 0};
    hinge.motors[3] = {0.02, 1e5, wheel == wheels[0] ? 1U : 0U, 0};
    scene.join(hinge);
  }
  PlumbJointDesc gear = joint_desc(PLUMB_JOINT_GEAR);
  gear.body_a = wheels[0];
  gear.body_b = wheels[1];
  gear.ratio = 4;
  scene.join(gear);
  scene.run(1200);
  const auto place = [&](PlumbBody body) { return read_one(scene, PLUMB_FIELD_POSE, body, 1, 7); };
  EXPECT_NEAR(place(lifts[0]), 2.2, 1e-3);
  EXPECT_NEAR(place(box), 3.2, 2e-3);
  EXPECT_NEAR(place(lifts[1]), 2.05, 1e-3);
  EXPECT_NEAR(2 * std::asin(read_one(scene, PLUMB_FIELD_POSE, wheels[1], 3, 7)), -0.1, 1e-3);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(is_awake(scene, lifts[k]), k == 0) << k;
  EXPECT_TRUE(is_awake(scene, box));
  EXPECT_TRUE(is_awake(scene, wheels[1]));
}

TEST_F(Asleep, SomeNeverSleepAndKeepOthersAwake) {
  scene.ground();
  scene.body.flags = PLUMB_BODY_NEVER_SLEEPS;
  const Tower restless(scene, 1);
  scene.body.flags = 0;
  const PlumbBody above = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 1.5, 0});
  const Tower other(scene, 2, 10);
  let_sleep(other.cubes);
  scene.run(100);
  EXPECT_TRUE(is_awake(scene, restless.cubes[0]));
  EXPECT_TRUE(is_awake(scene, above));
}

/// A new body in the slot of one that slept has nothing of it.
TEST_F(Asleep, ASlotIsTakenOverAwake) {
  scene.ground();
  const Tower tower(scene, 2);
  let_sleep(tower.cubes);
  scene.remove(tower.cubes[1]);
  const PlumbBody fresh = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 5, 0});
  EXPECT_TRUE(is_awake(scene, fresh));
  scene.run(20);
  EXPECT_LT(velocity(scene, fresh, 1), -2);
}

/// Contacts of the last step are kept for those who fall asleep, and some are with bodies that are there no more.
TEST_F(Asleep, WhoWasTouchedMayBeGone) {
  scene.ground();
  const Tower tower(scene, 3);
  scene.run(2);
  scene.remove(tower.cubes[0]);  // two: the sleeper takes over the row of one
  scene.remove(tower.cubes[1]);
  scene.body.flags = PLUMB_BODY_ASLEEP;
  const PlumbBody sleeper = scene.add(scene.sphere(0.5), {5, 0.5, 0});
  scene.run(2);
  EXPECT_FALSE(is_awake(scene, sleeper));
  EXPECT_LT(velocity(scene, tower.cubes[2], 1), -0.1) << "nothing of who is gone holds it up";
}

/// A pile, part of which comes to rest and is hit again and again: the same bits on any number of threads.
TEST(Sleep, HasTheSameBitsOnThreads) {
  const auto hash = [](std::uint32_t threads) {
    Scene scene(engine(), kSleepNeeds, kDown, threads);
    scene.ground();
    const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
    for (int i = 0; i < 100; ++i) scene.add(cube, {2.0 * (i % 10), 0.5 + i / 50, 2.0 * (i / 10 % 5)});
    scene.before_step = [=](Scene& now, int step) {
      if (step % 40 == 39) now.add(cube, {step % 7 * 2.0, 5, step % 5 * 2.0});
    };
    scene.run(300);
    return scene.hash();
  };
  EXPECT_EQ(hash(1), hash(3));
}

/// Union-find on random graphs, against the textbook's by labels.
TEST(Islands, AreTheComponents) {
  if (Executor::kWarps) GTEST_SKIP() << "its arrays are the host's";
  Executor executor(nullptr, 3);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const std::uint32_t n = 200, edges = static_cast<std::uint32_t>(random.between(0, 300));
    std::vector<Pair> pairs(edges);
    std::vector<std::uint32_t> rows(edges), label(n);
    for (std::uint32_t i = 0; i < edges; ++i)
      pairs[i] = {static_cast<std::uint32_t>(random.between(0, n)), static_cast<std::uint32_t>(random.between(0, n))};
    std::iota(rows.begin(), rows.end(), 0U);
    std::iota(label.begin(), label.end(), 0U);
    std::vector<Velocity> velocity(n);
    std::vector<Proxy> proxies(n);
    std::vector<Real> rest(n, 1);
    for (std::uint32_t i = 0; i < n; ++i) {
      velocity[i].inverse_mass = i % 7 == 0 ? Real(0) : Real(1);
      proxies[i].body = i;
      if (i % 31 == 3) rest[i] = 0;
    }
    for (bool more = true; more;) {
      more = false;
      for (const Pair& pair : pairs) {
        if (pair.a % 7 == 0 || pair.b % 7 == 0 || label[pair.a] == label[pair.b]) continue;
        label[pair.a] = label[pair.b] = std::min(label[pair.a], label[pair.b]);
        more = true;
      }
    }
    std::vector<bool> restless(n, false);
    for (std::uint32_t i = 0; i < n; ++i)
      if (i % 7 != 0 && i % 31 == 3) restless[label[i]] = true;

    Islands islands;
    islands.reserve(n);
    ContactCache cache{};
    cache.pairs = pairs.data();
    cache.candidate = rows.data();
    Bodies bodies{};
    bodies.velocity = velocity.data();
    islands.find_resting(
        executor,
        {cache, edges, {nullptr, 0, nullptr}, bodies, n, {proxies.data(), nullptr, {}}, rest.data(), Real(0.5)});
    executor.wait();
    const std::vector<std::uint32_t> found = islands.resting(n);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const bool rests = i % 7 != 0 && !restless[label[i]];
      EXPECT_EQ(found[i], rests ? label[i] + 1 : 0) << "seed " << seed << ", body " << i;
      if (rests) ++count;
    }
    EXPECT_EQ(islands.resting_count(), count);
  }
}

}  // namespace
}  // namespace plumb::impulse::test
