// What cannot be held apart: bodies that joints or a host have put into what does not move. They push no harder than
// the push speed needs, and what is let go of does not shoot away.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/hashes/shape_scenes.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kSqueezeNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;

double speed(Scene& scene, PlumbBody body) {
  const std::vector<double> v = scene.velocity(body);
  return std::hypot(v[0], v[1], v[2]);
}

/// A chain of capsules, each hinged into the one above, the first into a ball that stands still: all overlap, and
/// their contacts are not left out.
struct Overlapping {
  Overlapping(int links, double overlap)
      : scene(engine(), kSqueezeNeeds | PLUMB_NEED_JOINTS | PLUMB_NEED_JOINT_REACTIONS, kDown, 1) {
    constexpr double kBall = 0.25, kRadius = 0.15, kHalf = 0.2, kHook = 0.3;
    const double apart = 2 * (kRadius + kHalf) - overlap, over = kBall + kRadius + kHalf - overlap;
    const PlumbShape capsule = scene.capsule(kRadius, kHalf);
    PlumbBody above = scene.add_static(scene.sphere(kBall), {0, over, 0});
    for (int i = 0; i < links; ++i) {
      PlumbJointDesc hinge = joint_desc(PLUMB_JOINT_HINGE);
      hinge.body_a = above;
      hinge.body_b = above = scene.add(capsule, {0, -apart * i, 0});
      hinge.collide_connected = 1;
      hinge.frame_a.position = {0, i == 0 ? -kHook : -apart / 2, 0};
      hinge.frame_b.position = {0, i == 0 ? over - kHook : apart / 2, 0};
      const PlumbJoint joint = scene.join(hinge);
      if (i == 0) first = joint;
      bodies.push_back(above);
    }
  }
  [[nodiscard]] double borne() {
    std::array<double, 6> row{};
    check(scene.world(), scene.world().joints()->read_joints(PLUMB_JOINT_REACTION, {&first, 1},
                                                             rows_over(std::span<std::array<double, 6>>(&row, 1))));
    return std::hypot(row[0], row[1], row[2]);
  }
  Scene scene;
  std::vector<PlumbBody> bodies;
  PlumbJoint first = 0;
};

/// A joint that holds a body in a static one, and the contact that pushes it out, do not strive with ever more.
TEST(Squeezed, JointsAndContactsDoNotOutdoEachOther) {
  constexpr double kLink = 42.4 * 9.81;  // N
  for (const int links : {1, 2, 6})
    for (const double overlap : {0.02, 0.1}) {
      Overlapping chain(links, overlap);
      chain.scene.run(60);
      EXPECT_LT(chain.borne(), 20 * kLink * links) << links << ", " << overlap;
      chain.scene.run(1740);
      EXPECT_LT(chain.borne(), 20 * kLink * links) << links << ", " << overlap;
      for (const PlumbBody body : chain.bodies) EXPECT_LT(speed(chain.scene, body), 1) << links << ", " << overlap;
    }
}

/// A body among some that stand still and reach into it from all sides.
struct Wedged {
  Wedged(std::uint64_t seed, PlumbNeeds needs) : scene(engine(), needs, {0, 0, 0}, 1), random(seed) {
    const std::vector<PlumbShape> shapes = convex_shapes(scene);
    const auto any = [&] { return shapes[static_cast<std::size_t>(random.next() % shapes.size())]; };
    body = scene.add(any(), {0, 0, 0}, random.turn());
    for (int i = 0; i < 5; ++i) {
      const PlumbVec3 at = {random.between(-0.6, 0.6), random.between(-0.6, 0.6), random.between(-0.6, 0.6)};
      around.push_back(scene.add_static(any(), at, random.turn()));
    }
  }
  /// Of a quarter of a second.
  double fastest_of() {
    double fastest = 0;
    for (int i = 0; i < 60; ++i) {
      PlumbStepReport report{};
      check(scene.world(), scene.world().step(1.0 / 240));
      check(scene.world(), scene.world().wait(report));
      fastest = std::max(fastest, speed(scene, body));
    }
    return fastest;
  }
  Scene scene;
  Random random;
  PlumbBody body;
  std::vector<PlumbBody> around;
};

/// Those around are taken away, one after another, put elsewhere, or let through: the others push the body out at the
/// push speed, and not with what it had braced itself with.
TEST(Squeezed, WhatIsLetGoDoesNotShootAway) {
  for (int way = 0; way < 3; ++way)
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      Wedged wedged(seed, kSqueezeNeeds | PLUMB_NEED_FILTERS);
      double fastest = wedged.fastest_of();
      for (const PlumbBody one : wedged.around) {
        if (way == 0) wedged.scene.remove(one);
        if (way == 1) wedged.scene.write(PLUMB_FIELD_POSE, one, {100, 0, 0, 0, 0, 0, 1});
        if (way == 2) wedged.scene.write(PLUMB_FIELD_FILTER, one, {1, 0, 0});
        fastest = std::max(fastest, wedged.fastest_of());
      }
      EXPECT_LT(fastest, 8) << "seed " << seed << ", way " << way;
    }
}

}  // namespace
}  // namespace plumb::impulse::test
