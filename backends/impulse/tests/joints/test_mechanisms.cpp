// Joints and contacts together: what stands on wheels or legs comes to rest whatever it bears, light links swing heavy
// loads, and joints bear what contacts press.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/rigs/engine.hpp"
#include "tests/rigs/rope_bridge.hpp"
#include "tests/rigs/vise.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kMechanismNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_JOINTS | PLUMB_NEED_SNAPSHOT;
constexpr PlumbQuat kAboutZ = {0, -0.70710678118654752, 0, 0.70710678118654752};  // an x axis along z

/// Bodies of given masses, and their joints.
class Workshop {
 public:
  explicit Workshop(PlumbNeeds needs = kMechanismNeeds, std::uint32_t threads = 1, const Choice& choice = {})
      : scene(engine(), needs, kDown, threads, choice) {
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  }

  PlumbBody add(PlumbShape shape, double mass, const PlumbVec3& at, const PlumbQuat& turn = {0, 0, 0, 1}) {
    scene.body.mass = mass;
    bodies.push_back(scene.add(shape, at, turn));
    masses.push_back(mass);
    return bodies.back();
  }
  PlumbJoint join(PlumbJointType type, PlumbBody a, const PlumbVec3& in_a, PlumbBody b, const PlumbVec3& in_b,
                  const PlumbQuat& frame_a = {0, 0, 0, 1}, const PlumbQuat& frame_b = {0, 0, 0, 1}) {
    PlumbJointDesc desc = joint_desc(type);
    desc.body_a = a;
    desc.body_b = b;
    desc.frame_a = {in_a, frame_a};
    desc.frame_b = {in_b, frame_b};
    PlumbJoint id = 0;
    check(scene.world(), scene.world().joints()->create_joints({&desc, 1}, {&id, 1}));
    return id;
  }
  /// Of the fastest body, m/s.
  double speed() {
    double most = 0;
    for (const PlumbBody body : bodies) {
      const std::vector<double> v = scene.velocity(body);
      most = std::max(most, std::hypot(v[0], v[1], v[2]));
    }
    return most;
  }
  /// The largest within so many steps of dt.
  double run(int steps, double dt = 1.0 / 60) {
    double most = 0;
    PlumbStepReport report{};
    for (int i = 0; i < steps; ++i) {
      check(scene.world(), scene.world().step(dt));
      check(scene.world(), scene.world().wait(report));
      most = std::max(most, speed());
    }
    return most;
  }

  Scene scene;
  std::vector<PlumbBody> bodies;
  std::vector<double> masses;
};

constexpr PlumbVec3 kCorners[4] = {{0.7, 0, 0.4}, {0.7, 0, -0.4}, {-0.7, 0, 0.4}, {-0.7, 0, -0.4}};

void put_cart(Workshop& shop, double load) {
  shop.scene.ground();
  const PlumbBody hull = shop.add(shop.scene.box({2, 0.3, 0.8}), 1200, {0, 0.65, 0});
  const PlumbShape wheel = shop.scene.sphere(0.35);
  for (const PlumbVec3& at : kCorners) {
    const PlumbVec3 end = {2 * at.x, 0.35, 2.4 * at.z};
    shop.join(PLUMB_JOINT_HINGE, hull, {end.x, -0.3, end.z}, shop.add(wheel, 20, end), {0, 0, 0}, kAboutZ, kAboutZ);
  }
  if (load > 0) shop.add(shop.scene.box({0.5, 0.5, 0.5}), load, {0, 1.45, 0});
}

std::vector<PlumbJoint> put_table(Workshop& shop, double load) {
  shop.scene.ground();
  const PlumbBody top = shop.add(shop.scene.box({0.8, 0.03, 0.5}), 30, {0, 0.73, 0});
  const PlumbShape leg = shop.scene.box({0.03, 0.35, 0.03});
  std::vector<PlumbJoint> joints;
  for (const PlumbVec3& at : kCorners)
    joints.push_back(
        shop.join(PLUMB_JOINT_FIXED, top, {at.x, -0.03, at.z}, shop.add(leg, 2, {at.x, 0.35, at.z}), {0, 0.35, 0}));
  shop.add(shop.scene.box({0.25, 0.25, 0.25}), load, {0, 1.01, 0});
  return joints;
}

/// Links of .1 kg and .2 m with a ball at their end, let go at 60 degrees. Returns the bodies' first.
void put_rope(Workshop& shop, int links, double load) {
  const double s = std::sqrt(0.75), c = 0.5, half = std::sqrt(3.0) / 2;
  const PlumbQuat turn = {0, 0, c, half};
  const PlumbShape link = shop.scene.capsule(0.02, 0.08), ball = shop.scene.sphere(0.25);
  PlumbBody before = 0;
  for (int i = 0; i < links; ++i) {
    const double along = 0.2 * (i + 0.5);
    const PlumbBody here = shop.add(link, 0.1, {s * along, 20 - c * along, 0}, turn);
    shop.join(PLUMB_JOINT_BALL, before, before == 0 ? PlumbVec3{0, 20, 0} : PlumbVec3{0, -0.1, 0}, here, {0, 0.1, 0});
    before = here;
  }
  const double end = 0.2 * links + 0.25;
  shop.join(PLUMB_JOINT_BALL, before, {0, -0.1, 0}, shop.add(ball, load, {s * end, 20 - c * end, 0}),
            {-0.25 * s, 0.25 * c, 0});
}

TEST(Mechanisms, ACartStandsWhateverItBears) {
  for (const double load : {0.0, 1000.0, 5000.0})
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
      Workshop shop;
      put_cart(shop, load);
      shop.run(static_cast<int>(4 / dt), dt);
      EXPECT_LT(shop.run(60, dt), 1e-3) << load << " kg, " << dt << " s";
    }
}

TEST(Mechanisms, ATableComesToRestUnderItsLoad) {
  for (const double load : {30.0, 300.0}) {
    Workshop shop;
    put_table(shop, load);
    shop.run(180);
    EXPECT_LT(shop.run(120), 1e-3) << load;
  }
}

/// Boards fixed to a side at either end close loops, whose rows repeat each other.
TEST(Mechanisms, AShelfComesToRestUnderItsLoad) {
  Workshop shop;
  shop.scene.ground();
  const PlumbShape side = shop.scene.box({0.02, 0.8, 0.15}), board = shop.scene.box({0.48, 0.015, 0.15});
  const PlumbBody left = shop.add(side, 12, {-0.5, 0.8, 0}), right = shop.add(side, 12, {0.5, 0.8, 0});
  const PlumbShape book = shop.scene.box({0.05, 0.12, 0.1});
  for (int i = 0; i < 4; ++i) {
    const double height = 0.2 + 0.4 * i;
    const PlumbBody shelf = shop.add(board, 8, {0, height, 0});
    shop.join(PLUMB_JOINT_FIXED, left, {0.02, height - 0.8, 0}, shelf, {-0.48, 0, 0});
    shop.join(PLUMB_JOINT_FIXED, right, {-0.02, height - 0.8, 0}, shelf, {0.48, 0, 0});
    for (int k = 0; k < 4; ++k) shop.add(book, 20, {0.2 * k - 0.3, height + 0.135, 0});
  }
  shop.run(540);
  EXPECT_LT(shop.run(60), 2e-3);
}

TEST(Mechanisms, JointsBearWhatContactsPress) {
  Workshop shop(kMechanismNeeds | PLUMB_NEED_JOINT_REACTIONS);
  const std::vector<PlumbJoint> legs = put_table(shop, 300);
  shop.run(240);
  std::vector<double> rows(6 * legs.size());
  check(shop.scene.world(), shop.scene.world().joints()->read_joints(PLUMB_JOINT_REACTION, legs,
                                                                     Rows(reinterpret_cast<std::byte*>(rows.data()),
                                                                          legs.size(), 6 * sizeof(double), PLUMB_F64)));
  double up = 0;
  for (std::size_t i = 0; i < legs.size(); ++i) up += rows[6 * i + 1];
  EXPECT_NEAR(up, -330 * 9.81, 0.01 * 330 * 9.81);  // on the legs
}

TEST(Mechanisms, AChainInAHeapComesToRest) {
  Workshop shop;
  shop.scene.ground();
  const PlumbShape link = shop.scene.capsule(0.05, 0.15);
  PlumbBody before = 0;
  for (int i = 0; i < 10; ++i) {
    const PlumbBody here = shop.add(link, 5, {0.002 * (i % 3), 0.7 + 0.4 * i, 0.001 * i});
    if (before != 0) shop.join(PLUMB_JOINT_BALL, before, {0, 0.2, 0}, here, {0, -0.2, 0});
    before = here;
  }
  shop.run(360);
  EXPECT_LT(shop.run(60), 1e-2);
}

/// The ball's height and speed: nothing else weighs.
TEST(Mechanisms, HeavyLoadsSwingOnLightLinks) {
  for (const double load : {80.0, 1000.0}) {
    Workshop shop;
    put_rope(shop, 20, load);
    const auto energy = [&] {
      const std::vector<double> v = shop.scene.velocity(shop.bodies.back());
      const PlumbPose pose = shop.scene.poses().back();
      return 9.81 * pose.position.y + (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2;
    };
    const double start = energy(), range = 9.81 * 4.25 / 2;
    for (int i = 0; i < 10; ++i) {
      shop.run(60);
      EXPECT_NEAR(energy(), start, 0.02 * range) << load << ", " << i;
      const PlumbPose end = shop.scene.poses().back();
      EXPECT_NEAR(std::hypot(end.position.x, end.position.y - 20), 4.25, 0.005 * 4.25) << load;
    }
  }
}

/// A mechanism's bodies are pushed one after the other, whatever the threads.
TEST(Mechanisms, AreTheSameWithAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const std::uint32_t threads : {1U, 4U}) {
    Workshop shop(kMechanismNeeds, threads);
    put_cart(shop, 1000);
    put_rope(shop, 12, 100);
    shop.run(120);
    hashes.push_back(shop.scene.hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

/// A chain let go level, its hinges with limits and friction, or all balls.
void put_chain(Workshop& shop, const PlumbVec3& at, bool limited) {
  const PlumbShape link = shop.scene.box({0.15, 0.05, 0.05});
  PlumbBody above = 0;
  PlumbVec3 from = at;
  for (int i = 0; i < 6; ++i) {
    const PlumbBody body = shop.add(link, 1 + 0.5 * i, {at.x + 0.2 + 0.4 * i, at.y, at.z});
    PlumbJointDesc desc = joint_desc(limited ? PLUMB_JOINT_HINGE : PLUMB_JOINT_BALL);
    desc.body_a = above;
    desc.body_b = body;
    desc.frame_a = {from, kAboutZ};
    desc.frame_b = {{-0.2, 0, 0}, kAboutZ};
    if (limited) desc.limits[3] = {-0.3 - 0.1 * i, 0.4, 1, 0};
    if (limited) desc.motors[3] = {0, 0.5, 1, 0};
    shop.scene.join(desc);
    above = body;
    from = {0.2, 0, 0};
  }
}

/// To the last bit: neither what others touch, nor how many rounds they take, nor how they are pulled is anything to a
/// mechanism that they do not meet.
TEST(Mechanisms, DoNotDependOnOthers) {
  for (const bool limited : {false, true}) {
    Workshop alone, among;
    for (Workshop* shop : {&alone, &among}) put_chain(*shop, {50, 20, 0}, limited);
    put_chain(among, {0, 1, 0}, limited);
    put_chain(among, {0.1, 1.3, 0.1}, limited);
    among.scene.ground();
    for (int i = 0; i < 120; ++i) {
      alone.run(1);
      among.run(1);
      const std::vector<PlumbPose> one = alone.scene.poses(), other = among.scene.poses();
      for (std::size_t k = 0; k < alone.bodies.size(); ++k) {
        EXPECT_EQ(one[k].position.x, other[k].position.x) << "limited " << limited << ", link " << k << ", step " << i;
        EXPECT_EQ(one[k].position.y, other[k].position.y) << "limited " << limited << ", link " << k << ", step " << i;
      }
      if (HasFailure()) return;
    }
  }
}

/// To the last bit: where some joint has limits and a motor, others are solved as where none has.
TEST(Mechanisms, AMotorIsNothingToWhomItDoesNotMeet) {
  for (const Choice& choice :
       {Choice{}, Choice{"solver", "si"}, Choice{"solver", "jacobi"}, Choice{"solver", "xpbd"}}) {
    const char* const of = choice.setting == nullptr ? "default" : choice.choice;
    Workshop alone(kMechanismNeeds, 1, choice), among(kMechanismNeeds, 1, choice);
    for (Workshop* shop : {&alone, &among}) {
      put_table(*shop, 300);
      put_rope(*shop, 12, 100);
    }
    put_chain(among, {50, 20, 0}, true);
    for (int i = 0; i < 60; ++i) {
      alone.run(1);
      among.run(1);
      const std::vector<PlumbPose> one = alone.scene.poses(), other = among.scene.poses();
      for (std::size_t k = 0; k < alone.bodies.size(); ++k)
        ASSERT_EQ(one[k].position.y, other[k].position.y) << of << ", body " << k << ", step " << i;
    }
  }
}

/// A joint more or less joins and parts mechanisms whose contacts were coloured apart.
TEST(Mechanisms, ComeTogetherAndPartWhileTheyTouch) {
  Workshop shop;
  shop.scene.ground();
  const PlumbShape cube = shop.scene.box({0.25, 0.25, 0.25});
  for (int i = 0; i < 6; ++i) shop.add(cube, 50, {0.6 * i, 0.25, 0});
  const auto tie = [&](std::size_t i) {
    return shop.join(PLUMB_JOINT_FIXED, shop.bodies[i], {0.3, 0, 0}, shop.bodies[i + 1], {-0.3, 0, 0});
  };
  shop.run(30);
  const PlumbJoint left = tie(0), right = tie(3);
  shop.run(30);
  const PlumbJoint middle = tie(2);
  (void)left;
  (void)right;
  shop.run(30);
  check(shop.scene.world(), shop.scene.world().joints()->destroy_joints({&middle, 1}));
  EXPECT_LT(shop.run(60), 1e-3);
  for (const PlumbPose& pose : shop.scene.poses()) {
    if (pose.position.y > -0.4) {
      EXPECT_NEAR(pose.position.y, 0.25, 1e-3);
    }
  }
}

/// Joined where they are 20 m apart: at once would be 9,600 m/s.
TEST(Mechanisms, WhatIsJoinedMetresApartIsDrawnTogetherAndNotFlung) {
  for (const char* solver : {"tgs_soft", "si", "jacobi", "xpbd"})
    for (const PlumbJointType type : {PLUMB_JOINT_BALL, PLUMB_JOINT_HINGE, PLUMB_JOINT_FIXED}) {
      Scene scene(engine(), kMechanismNeeds, {0, 0, 0}, 1, {"solver", solver});
      const PlumbShape ball = scene.sphere(0.25);
      PlumbJointDesc desc = joint_desc(type);
      desc.body_a = scene.add(ball, {0, 0, 0});
      desc.body_b = scene.add(ball, {20, 0, 0});
      PlumbJoint id = 0;
      check(scene.world(), scene.world().joints()->create_joints({&desc, 1}, {&id, 1}));
      double fastest = 0;
      for (int step = 0; step < 600; ++step) {
        scene.run(1);
        for (const PlumbBody body : {desc.body_a, desc.body_b})
          fastest = std::max(fastest, std::abs(scene.velocity(body)[0]));
      }
      const auto poses = scene.poses();
      EXPECT_LT(fastest, 11) << solver << type;
      EXPECT_NEAR(poses[0].position.x, poses[1].position.x, 0.01) << solver << type;
    }
}

/// Planks of 20 kg that hang on an arc between two hooks, on hinges that rub with up to 10 N m each. Which of them slip
/// is found for all at once; where that failed, planks leapt by centimetres a second for ever.
TEST(Mechanisms, HingesThatRubBringABridgeToRest) {
  constexpr int kPlanks = 20;
  constexpr double kArc = 20 * std::numbers::pi / 180, kHalf = 0.25;
  for (const double load : {0, 200}) {
    Workshop shop;
    const PlumbShape plank = shop.scene.box({kHalf, 0.05, 0.6});
    const double part = 2 * kArc / kPlanks, radius = kHalf / std::sin(part / 2), apothem = kHalf / std::tan(part / 2);
    PlumbBody before = 0;
    const auto hinge = [&](PlumbBody next, double angle) {
      PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
      desc.body_a = before;
      desc.body_b = next;
      const PlumbVec3 hook = {radius * std::sin(angle), -radius * std::cos(angle), 0};
      desc.frame_a = {before == 0 ? hook : PlumbVec3{kHalf, 0, 0}, kAboutZ};
      desc.frame_b = {next == 0 ? hook : PlumbVec3{-kHalf, 0, 0}, kAboutZ};
      if (next == 0) {  // the last: the world is body a
        std::swap(desc.body_a, desc.body_b);
        std::swap(desc.frame_a, desc.frame_b);
      }
      desc.motors[3] = {0, 10, 1, 0};
      PlumbJoint id = 0;
      check(shop.scene.world(), shop.scene.world().joints()->create_joints({&desc, 1}, {&id, 1}));
    };
    for (int i = 0; i <= kPlanks; ++i) {
      const double angle = -kArc + (i + 0.5) * part;
      PlumbBody next = 0;
      if (i < kPlanks)
        next = shop.add(plank, 20, {apothem * std::sin(angle), -apothem * std::cos(angle), 0},
                        {0, 0, std::sin(angle / 2), std::cos(angle / 2)});
      hinge(next, angle - part / 2);
      before = next;
    }
    if (load > 0) shop.add(shop.scene.box({0.25, 0.25, 0.25}), load, {0.25, 0.31 - apothem, 0});
    shop.run(900);
    EXPECT_LT(shop.run(300), 5e-4) << load;
  }
}

/// A rope bridge on which people land who draw it taut: the heavier, the more energy is made still, but nobody is
/// thrown to the moon.
TEST(Mechanisms, ARopeBridgeCatchesWhoIsManyTimesHeavierThanItsPlanks) {
  struct Case {
    double weight;
    int people;
    double most;  // how high what is made would lift all of it, m
  };
  for (const auto& [weight, people, most] : {Case{80, 1, 0.005},
                                             {400, 1, 0.1},
                                             {700, 1, 0.1},
                                             {1000, 1, 0.5},
                                             {2000, 1, 2},
                                             {1000, 8, 2},
                                             {2000, 8, 2},
                                             {4000, 4, 2}}) {
    Workshop shop(kMechanismNeeds | PLUMB_NEED_AXIS_LOCKS);
    const RopeBridge bridge = rope_bridge(shop.scene);
    shop.bodies = bridge.planks;
    shop.masses.assign(bridge.planks.size(), 20);
    for (int i = 0; i < people; ++i) {
      shop.bodies.push_back(person(shop.scene, bridge, weight, 5.7 * (2 * (i + 0.5) / people - 1)));
      shop.masses.push_back(weight);
    }
    const auto energy = [&] {
      double sum = 0;
      for (std::size_t i = 0; i < shop.bodies.size(); ++i) {
        const std::vector<double> v = shop.scene.velocity(shop.bodies[i]);
        sum +=
            shop.masses[i] * ((v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2 + 9.81 * shop.scene.poses()[i].position.y);
      }
      return sum;
    };
    double least = energy(), rise = 0;
    for (int step = 0; step < 600; ++step) {
      shop.scene.run(1);
      const double now = energy();
      rise = std::max(rise, now - least);
      least = std::min(least, now);
    }
    EXPECT_LT(rise / (9.81 * (600 + people * weight)), most) << people << " x " << weight;
  }
}

/// Two boxes that a bar holds into each other: what would push them apart finds nothing that gives way, and pushed ever
/// harder until the rounding of it all made them fly.
TEST(Mechanisms, WhatJointsHoldIntoEachOtherLiesStill) {
  for (const double overlap : {0.0, 0.001, 0.01, 0.05, 0.2}) {
    for (const double box_mass : {5, 100, 1000}) {
      for (const double bar_mass : {1.0, 0.05}) {
        Workshop shop;
        shop.scene.ground();
        const PlumbShape box = shop.scene.box({0.2, 0.2, 0.2});
        const PlumbBody bar = shop.add(shop.scene.box({0.4, 0.05, 0.05}), bar_mass, {0, 0.5, 0});
        const PlumbBody left = shop.add(box, box_mass, {-0.2, 0.2, 0});
        const PlumbBody right = shop.add(box, box_mass, {0.2 - overlap, 0.2, 0});
        shop.join(PLUMB_JOINT_FIXED, bar, {-0.2, -0.1, 0}, left, {0, 0.2, 0});
        shop.join(PLUMB_JOINT_FIXED, bar, {0.2, -0.1, 0}, right, {overlap, 0.2, 0});
        EXPECT_LT(shop.run(300), 0.1) << overlap << ' ' << box_mass << ' ' << bar_mass;
        EXPECT_LT(shop.run(300), 0.02) << overlap << ' ' << box_mass << ' ' << bar_mass;
      }
    }
  }
}

/// A motor that moves a slider is a row that holds, until a contact is in its way.
TEST(Mechanisms, AMotorDoesNotDrawOneOfItsBodiesThroughTheOther) {
  for (const double force : {50.0, 6e3, 2e5}) {
    Scene scene(engine(), kMechanismNeeds, kDown, 1);
    scene.ground();
    vise(scene, force);
    scene.run(300);
    const std::vector<PlumbPose> poses = scene.poses();
    EXPECT_NEAR(poses.end()[-1].position.x - poses.end()[-2].position.x, 1, 0.05) << force << " N";
  }
}

/// Three boxes a centimetre into each other, welded in a row: one piece. What a hinge joins collides.
TEST(Mechanisms, OnePieceDoesNotCollideWithItself) {
  for (const bool hinged : {false, true}) {
    Workshop shop;
    shop.scene.ground();
    const PlumbShape box = shop.scene.box({0.2, 0.2, 0.2});
    PlumbBody bodies[3];
    for (int i = 0; i < 3; ++i) bodies[i] = shop.add(box, 1, {0.39 * i - 5, 0.2, 0});
    const PlumbBody bar = shop.add(box, 1, {-4.6, 0.59, 0});
    for (int i = 0; i < 3; ++i)
      shop.join(hinged && i == 1 ? PLUMB_JOINT_HINGE : PLUMB_JOINT_FIXED, bar, {0.39 * i - 0.4, -0.2, 0}, bodies[i],
                {0, 0.19, 0});
    shop.scene.run(1);
    std::span<const PlumbDebugPair> pairs;
    check(shop.scene.world(), shop.scene.world().debug()->candidate_pairs(pairs));
    const auto touch = [&](PlumbBody a, PlumbBody b) {
      return std::any_of(pairs.begin(), pairs.end(), [&](const PlumbDebugPair& pair) {
        return (pair.body_a == a && pair.body_b == b) || (pair.body_a == b && pair.body_b == a);
      });
    };
    EXPECT_EQ(touch(bodies[0], bodies[1]), hinged);
    EXPECT_EQ(touch(bodies[1], bodies[2]), hinged);
    EXPECT_FALSE(touch(bodies[1], bar));
  }
}

/// A trunk on two legs whose knees and hips have stops, let fall so that the stops are reached while the feet press.
class Faller {
 public:
  Faller(double trunk_mass, double height, double lean) {
    shop_.scene.ground();
    const PlumbQuat turn = {0, 0, std::sin(lean / 2), std::cos(lean / 2)};
    const auto place = [&](const PlumbVec3& at) {
      const double c = std::cos(lean), s = std::sin(lean);
      return PlumbVec3{c * at.x - s * at.y, height + s * at.x + c * at.y, at.z};
    };
    const auto part = [&](PlumbShape shape, double mass, double moment, const PlumbVec3& at) {
      shop_.scene.body.inertia = {moment, moment, moment};
      moments_.push_back(moment);
      return shop_.add(shape, mass, place(at), turn);
    };
    shop_.scene.body.mass_mode = PLUMB_MASS_EXPLICIT;
    const PlumbShape chest = shop_.scene.box({0.12, 0.3, 0.2}), bone = shop_.scene.capsule(0.06, 0.14);
    const PlumbBody trunk = part(chest, trunk_mass, trunk_mass * 0.04, {0, 1.18, 0});
    for (const double side : {-0.12, 0.12}) {
      const PlumbBody thigh = part(bone, 8, 0.1, {0, 0.67, side}), shank = part(bone, 4, 0.05, {0, 0.25, side});
      hinge(trunk, {0, -0.31, side}, thigh, {0, 0.2, 0}, -1.2, 0.5);
      hinge(thigh, {0, -0.21, 0}, shank, {0, 0.21, 0}, 0, 2);
    }
  }
  /// The largest rise of the energy within so many steps, J.
  double energy_made(int steps) {
    double least = energy(), most = 0;
    for (int i = 0; i < steps; ++i) {
      shop_.scene.run(1);
      const double now = energy();
      most = std::max(most, now - least);
      least = std::min(least, now);
    }
    return most;
  }

 private:
  void hinge(PlumbBody a, const PlumbVec3& in_a, PlumbBody b, const PlumbVec3& in_b, double lower, double upper) {
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
    desc.body_a = a;
    desc.body_b = b;
    desc.frame_a = {in_a, kAboutZ};
    desc.frame_b = {in_b, kAboutZ};
    desc.limits[3] = {lower, upper, 1, 0};
    PlumbJoint id = 0;
    check(shop_.scene.world(), shop_.scene.world().joints()->create_joints({&desc, 1}, {&id, 1}));
  }
  double energy() {
    const auto poses = shop_.scene.poses();
    double sum = 0;
    for (std::size_t i = 0; i < shop_.bodies.size(); ++i) {
      const std::vector<double> v = shop_.scene.velocity(shop_.bodies[i]);
      sum += shop_.masses[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2;
      sum += moments_[i] * (v[3] * v[3] + v[4] * v[4] + v[5] * v[5]) / 2;
      sum += shop_.masses[i] * 9.81 * poses[poses.size() - shop_.bodies.size() + i].position.y;
    }
    return sum;
  }

  Workshop shop_;
  std::vector<double> moments_;
};

/// Stops push back what went beyond them, the ground pushes the foot, and neither knows what the other needs. Who folds
/// up fast may still hop: how a mechanism gives way is worked out once a step.
TEST(Mechanisms, WhoFallsOnTheStopsOfItsJointsGainsHardlyEverEnergy) {
  int hops = 0;
  for (const double trunk : {35.0, 140.0})
    for (const double height : {0.1, 0.5, 1.5})
      for (const double lean : {-0.6, -0.2, 0.1, 0.4}) {
        const double lifts_by = Faller(trunk, height, lean).energy_made(300) / ((trunk + 24) * 9.81);
        EXPECT_LT(lifts_by, 0.5) << trunk << " kg from " << height << " m, leaning by " << lean;
        if (lifts_by > 0.02) ++hops;
      }
  EXPECT_LE(hops, 2);
}

}  // namespace
}  // namespace plumb::impulse::test
