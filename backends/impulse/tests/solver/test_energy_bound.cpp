// The energy bound: a step that makes energy is taken back and gone in parts, which tell all that a whole step tells;
// what hosts, motors, springs and gravity put in is not taken for it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "tests/rigs/engine.hpp"
#include "tests/rigs/rope_bridge.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbVec3 kNoGravity = {0, 0, 0};
constexpr PlumbNeeds kBoundNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                   PLUMB_NEED_JOINTS | PLUMB_NEED_AXIS_LOCKS | PLUMB_NEED_SNAPSHOT;
constexpr double kPerson = 2000;

/// Whether the step made energy.
bool step(Scene& scene, double dt = 1.0 / 60) {
  PlumbStepReport report{};
  check(scene.world(), scene.world().step(dt));
  check(scene.world(), scene.world().wait(report));
  EXPECT_EQ(report.nonfinite, 0U);
  return (report.remarks & PLUMB_REMARK_ENERGY_BOUNDED) != 0;
}

struct Crowd {
  explicit Crowd(PlumbNeeds needs = kBoundNeeds, std::uint32_t threads = 1, double mass = kPerson)
      : scene(engine(), needs, kDown, threads) {
    bridge = rope_bridge(scene);
    for (int i = 0; i < 8; ++i) people.push_back(person(scene, bridge, mass, 1.4 * (i - 3.5)));
  }
  Scene scene;
  RopeBridge bridge;
  std::vector<PlumbBody> people;
};

/// What falls on a bridge that it draws taut is thrown up with no more than it fell with.
TEST(EnergyBound, StepsThatMakeEnergyAreGoneInParts) {
  Crowd crowd;
  int bounded = 0;
  for (int i = 0; i < 300; ++i) {
    bounded += step(crowd.scene) ? 1 : 0;
    for (const PlumbBody one : crowd.people) {
      const std::vector<double> v = crowd.scene.velocity(one);
      EXPECT_LT(std::hypot(v[0], v[1], v[2]), 5) << i;
    }
  }
  EXPECT_GT(bounded, 0);
  EXPECT_LT(bounded, 100);
}

/// The contacts of a step that goes in parts are those of all of them: their impulses are what stops who stands there.
TEST(EnergyBound, AStepInPartsTellsAllItsContacts) {
  constexpr double kDt = 1.0 / 60;
  constexpr double kLight = 700;  // light enough that parts suffice, and nothing is taken out
  Crowd crowd(kBoundNeeds | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES, 1, kLight);
  int bounded = 0;
  std::vector<double> before(crowd.people.size());
  for (int i = 0; i < 120; ++i) {
    for (std::size_t k = 0; k < crowd.people.size(); ++k) before[k] = crowd.scene.velocity(crowd.people[k])[1];
    bounded += step(crowd.scene) ? 1 : 0;
    const std::span<const PlumbContact> contacts = crowd.scene.world().contacts();
    for (std::size_t k = 0; k < crowd.people.size(); ++k) {
      double impulse = 0;
      for (const PlumbContact& contact : contacts) {
        const double up = contact.normal_impulse * contact.normal.y + contact.tangent_impulse.y;
        if (contact.body_b == crowd.people[k]) impulse += up;
        if (contact.body_a == crowd.people[k]) impulse -= up;
      }
      const double gained = crowd.scene.velocity(crowd.people[k])[1] - before[k];
      EXPECT_NEAR(impulse / kLight, gained + 9.81 * kDt, 0.01) << "person " << k << ", step " << i;
    }
  }
  EXPECT_GT(bounded, 0);
}

/// Of planks and people, J.
double energy(Crowd& crowd) {
  double sum = 0;
  const std::vector<PlumbPose> poses = crowd.scene.poses();
  std::size_t i = 0;
  const auto add = [&](PlumbBody body, double mass) {
    const std::vector<double> v = crowd.scene.velocity(body);
    sum += mass * (9.81 * poses[i++].position.y + (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2);
  };
  for (const PlumbBody plank : crowd.bridge.planks) add(plank, 20);
  for (const PlumbBody one : crowd.people) add(one, kPerson);
  return sum;
}

/// Of 29 kJ that the fall of so many leaves in the bridge a step made 17 again where the gain was let be.
TEST(EnergyBound, WhatPartsDoNotHelpIsTakenOut) {
  Crowd crowd;
  double last = energy(crowd);
  for (int i = 0; i < 60; ++i) {
    step(crowd.scene);
    const double now = energy(crowd);
    EXPECT_LT(now - last, 8000) << i;
    last = now;
  }
}

/// Steps go in parts for a while after one that made energy: a snapshot knows.
TEST(EnergyBound, ASnapshotGoesOnInParts) {
  Crowd one, two;
  int steps = 0;
  while (!step(one.scene) && steps < 300) ++steps;
  ASSERT_LT(steps, 300);
  one.scene.run(2);
  std::span<const std::byte> data;
  check(one.scene.world(), one.scene.world().snapshot()->save(data));
  check(two.scene.world(), two.scene.world().snapshot()->restore(data));
  one.scene.run(60);
  two.scene.run(60);
  EXPECT_EQ(one.scene.hash(), two.scene.hash());
}

TEST(EnergyBound, ThreadsDoNotMatter) {
  Crowd one(kBoundNeeds, 1), three(kBoundNeeds, 3);
  one.scene.run(120);
  three.scene.run(120);
  EXPECT_EQ(one.scene.hash(), three.scene.hash());
}

/// Two bodies of 1 and 3 kg on a ball joint, as of a figure.
struct Pair {
  PlumbBody light, heavy;
};
Pair pair(Scene& scene, const PlumbVec3& at) {
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = 1;
  const PlumbBody light = scene.add(scene.box({0.2, 0.1, 0.1}), at);
  scene.body.mass = 3;
  const PlumbBody heavy = scene.add(scene.box({0.2, 0.1, 0.1}), {at.x + 0.5, at.y, at.z});
  scene.ball_joint(light, {0.25, 0, 0}, heavy, {-0.25, 0, 0});
  return {light, heavy};
}

/// A joint of the world and a box of that mass, kg.
PlumbJointDesc held(Scene& scene, PlumbJointType type, double mass) {
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = mass;
  PlumbJointDesc desc = joint_desc(type);
  desc.body_b = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0, 0});
  return desc;
}
void make(Scene& scene, const PlumbJointDesc& desc) {
  PlumbJoint id = 0;
  check(scene.world(), scene.world().joints()->create_joints({&desc, 1}, {&id, 1}));
}

/// Each starts from rest and has more energy a step later.
struct Source {
  const char* name;
  PlumbVec3 gravity;
  std::function<void(Scene&)> build;
};
const std::vector<Source>& sources() {
  static const std::vector<Source> list = {
      {"a motor without bounds on a flywheel", kNoGravity,
       [](Scene& scene) {
         PlumbJointDesc desc = held(scene, PLUMB_JOINT_HINGE, 100);
         desc.motors[3] = {100, 1e30, 1, 0};
         make(scene, desc);
       }},
      {"a weak motor", kNoGravity,
       [](Scene& scene) {
         PlumbJointDesc desc = held(scene, PLUMB_JOINT_SLIDER, 1);
         desc.motors[0] = {50, 100, 1, 0};
         make(scene, desc);
       }},
      {"a spring let go", kNoGravity,
       [](Scene& scene) {
         PlumbJointDesc desc = held(scene, PLUMB_JOINT_SLIDER, 1);
         desc.springs[0] = {0.5, 5, 0, 1, 0};
         make(scene, desc);
       }},
      {"a plate that strikes", kDown,
       [](Scene& scene) {
         scene.ground();
         pair(scene, {0, 0.1, 0});
         const PlumbBody plate = scene.add_kinematic(scene.box({0.1, 0.5, 0.5}), {-1, 0.6, 0});
         scene.before_step = [plate](Scene& all, int step) { all.target(plate, {-1 + 0.5 * (step + 1), 0.6, 0}); };
       }},
      {"an arm that whirls", kNoGravity,
       [](Scene& scene) {
         const Pair two = pair(scene, {2, 0, 0});
         const PlumbBody arm = scene.add_kinematic(scene.box({0.1, 0.1, 0.1}), {0, 0, 0});
         scene.ball_joint(arm, {1.75, 0, 0}, two.light, {-0.25, 0, 0});
         scene.before_step = [arm, turn = 0.0](Scene& all, int) mutable {
           turn += 0.25;
           all.target(arm, {0, 0, 0}, {0, 0, std::sin(turn / 2), std::cos(turn / 2)});
         };
       }},
      {"forces of the host", kNoGravity,
       [](Scene& scene) {
         const Pair two = pair(scene, {0, 0, 0});
         scene.before_step = [two](Scene& all, int step) {
           if (step > 20) return;
           all.write(PLUMB_FIELD_FORCE, two.heavy, {2000, 0, 0});
           all.write(PLUMB_FIELD_TORQUE, two.light, {30, 0, 0});
         };
       }},
      {"a velocity that the host writes", kDown,
       [](Scene& scene) {
         scene.ground();
         const Pair two = pair(scene, {0, 0.1, 0});
         scene.before_step = [two](Scene& all, int step) {
           if (step == 5) all.write(PLUMB_FIELD_VELOCITY, two.heavy, {0, 40, 0, 0, 0, 0});
         };
       }},
      {"a fall",
       {0, -1000, 0},
       [](Scene& scene) {
         pair(scene, {0, 0, 0});
       }},
      {"no mass to speak of beside a heavy one", kDown, [](Scene& scene) {
         scene.ground();
         scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
         scene.body.mass = 1e-3;
         const PlumbBody pebble = scene.add(scene.box({0.05, 0.05, 0.05}), {0, 0.5, 0});
         scene.body.mass = 1e4;
         const PlumbBody block = scene.add(scene.box({0.5, 0.5, 0.5}), {1, 0.5, 0});
         scene.ball_joint(pebble, {0.25, 0, 0}, block, {-0.75, 0, 0});
       }}};
  return list;
}

TEST(EnergyBound, SourcesAreNoGain) {
  for (const Source& source : sources())
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
      Scene scene(engine(), kBoundNeeds | PLUMB_NEED_KINEMATIC | PLUMB_NEED_FORCES, source.gravity, 1);
      source.build(scene);
      for (int i = 0; i < 120; ++i) {
        if (scene.before_step) scene.before_step(scene, i);
        EXPECT_FALSE(step(scene, dt)) << source.name << ", dt " << dt << ", step " << i;
      }
    }
}

}  // namespace
}  // namespace plumb::impulse::test
