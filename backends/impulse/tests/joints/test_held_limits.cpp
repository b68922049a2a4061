// What holds still does so to the end: limits against contacts that did not count on them, and long arms under load.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_JOINTS | PLUMB_NEED_GYROSCOPIC;
constexpr std::array kSteps = {1.0 / 30, 1.0 / 60, 1.0 / 240};

/// Turns of x to x, y or z.
constexpr std::array<PlumbQuat, 3> kAxes = {{{0, 0, 0, 1},
                                             {0, 0, 0.70710678118654752, 0.70710678118654752},
                                             {0, -0.70710678118654752, 0, 0.70710678118654752}}};

Eigen::Quaterniond turn_of(const PlumbQuat& q) { return {q.w, q.x, q.y, q.z}; }

PlumbJointDesc hinge(PlumbBody a, double x_in_a, PlumbBody b, double x_in_b, const PlumbQuat& axis) {
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
  desc.body_a = a;
  desc.body_b = b;
  desc.frame_a = {{x_in_a, 0, 0}, axis};
  desc.frame_b = {{x_in_b, 0, 0}, axis};
  return desc;
}

void step(Scene& scene, double dt) {
  PlumbStepReport report{};
  check(scene.world(), scene.world().step(dt));
  check(scene.world(), scene.world().wait(report));
  ASSERT_EQ(report.nonfinite, 0U);
}

/// After so many seconds, in one more: the fastest that one of the bodies is, m/s.
double fastest_after(double seconds, Scene& scene, const std::vector<PlumbBody>& bodies, double dt) {
  double most = 0;
  for (int i = 0; i < (seconds + 1) / dt; ++i) {
    step(scene, dt);
    if (i * dt < seconds) continue;
    for (const PlumbBody body : bodies) {
      const std::vector<double> v = scene.velocity(body);
      most = std::max(most, std::hypot(v[0], v[1], v[2]));
    }
  }
  return most;
}

/// A palm of 500 g with four fingers of two links of 16 g each, about a hand's length above the ground.
class Hand {
 public:
  static constexpr double kLower = -1.4, kUpper = 0.1;  // of each knuckle, rad

  Hand(const PlumbQuat& orientation, double load) : scene_(engine(), kNeeds, kDown, 1) {
    scene_.ground();
    scene_.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    const Eigen::Quaterniond turn = turn_of(orientation);
    const auto put = [&](PlumbShape shape, double mass, double x, double z) {
      const Eigen::Vector3d at = Eigen::Vector3d(0, 0.25, 0) + turn * Eigen::Vector3d(x, 0, z);
      scene_.body.mass = mass;
      return scene_.add(shape, {at.x(), at.y(), at.z()}, orientation);
    };
    const PlumbShape link = scene_.box({0.02, 0.008, 0.009});
    const PlumbBody palm = put(scene_.box({0.05, 0.015, 0.05}), 0.5, 0, 0);
    for (int k = 0; k < 4; ++k) {
      const double z = -0.0375 + 0.025 * k;
      const PlumbBody near = put(link, 0.016, 0.072, z), far = put(link, 0.016, 0.116, z);
      PlumbJointDesc knuckle = hinge(palm, 0.051, near, -0.021, kAxes[2]);
      knuckle.frame_a.position.z = z;
      bend(knuckle, 0, 1 + 2 * k);
      bend(hinge(near, 0.022, far, -0.022, kAxes[2]), 1 + 2 * k, 2 + 2 * k);
    }
    if (load == 0) return;
    scene_.body.mass = load;
    scene_.add(scene_.box({0.06, 0.06, 0.06}), {0, 0.65, 0});
  }

  /// How far a knuckle is beyond its limits at the most in so many seconds, rad.
  double worst(double seconds, double dt) {
    double most = 0;
    for (int i = 0; i < seconds / dt; ++i) {
      step(scene_, dt);
      const std::vector<PlumbPose> poses = scene_.poses();
      for (const auto& [a, b] : knuckles_) {
        const Eigen::Quaterniond turn =
            turn_of(poses[a + 1].orientation).conjugate() * turn_of(poses[b + 1].orientation);
        const double angle = std::remainder(2 * std::atan2(turn.z(), turn.w()), 2 * std::numbers::pi);
        most = std::max({most, angle - kUpper, kLower - angle});
      }
    }
    return most;
  }

 private:
  void bend(PlumbJointDesc desc, std::size_t a, std::size_t b) {
    desc.limits[3] = {kLower, kUpper, 1, 0};
    scene_.join(desc);
    knuckles_.push_back({a, b});
  }

  Scene scene_;
  std::vector<std::array<std::size_t, 2>> knuckles_;  // of bodies after the ground
};

TEST(HeldLimits, OfAHandThatIsDropped) {
  Random random(7);
  for (int i = 0; i < 4; ++i) {
    const PlumbQuat orientation = random.turn();
    for (const double load : {0.0, 5.0})
      for (const double dt : kSteps) {
        SCOPED_TRACE("hand " + std::to_string(i) + ", load " + std::to_string(load) + ", dt " + std::to_string(dt));
        EXPECT_LT(Hand(orientation, load).worst(1, dt), 0.03);
      }
  }
}

/// Links in a row on the ground, with springs and dampers in their knuckles, some of which lie at a limit.
TEST(HeldLimits, LetWhatIsLimpLieStill) {
  constexpr std::array<PlumbVec3, 6> kHalf = {{{0.1678, 0.0462, 0.0914},
                                               {0.1275, 0.0554, 0.0568},
                                               {0.1545, 0.0653, 0.0713},
                                               {0.1678, 0.0648, 0.0669},
                                               {0.1488, 0.0626, 0.0914},
                                               {0.1667, 0.0443, 0.0873}}};
  constexpr std::array kMass = {2.115, 8.252, 2.809, 7.826, 3.451, 8.759};
  constexpr std::array<std::array<double, 2>, 5> kLimits = {
      {{-0.15535, 0.096742}, {-0.18176, 0.100129}, {-0.046328, 0.074933}, {-0.18011, 0.078595}, {-0.041037, 0.074676}}};
  for (const double dt : kSteps) {
    Scene scene(engine(), kNeeds, kDown, 1);
    scene.ground();
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    std::vector<PlumbBody> links;
    double end = 0;
    for (std::size_t i = 0; i < kHalf.size(); ++i) {
      scene.body.mass = kMass[i];
      links.push_back(scene.add(scene.box(kHalf[i]), {end + kHalf[i].x, 0.3, 0}));
      end += 2 * kHalf[i].x + 0.01;
      if (i == 0) continue;
      PlumbJointDesc knuckle =
          hinge(links[i - 1], kHalf[i - 1].x + 0.005, links[i], -kHalf[i].x - 0.005, kAxes[i == 3 ? 1 : 2]);
      knuckle.limits[3] = {kLimits[i - 1][0], kLimits[i - 1][1], 1, 0};
      knuckle.springs[3] = {0, 10, 5, 1, PLUMB_SPRING_STIFFNESS};
      scene.join(knuckle);
    }
    EXPECT_LT(fastest_after(5, scene, links, dt), 2e-4) << dt;
  }
}

/// An arm of six links, three hinges of which turn about itself or about the upright, holds thirty times a link.
TEST(HeldArms, KeepTheirLoadsStill) {
  constexpr std::array kMass = {0.35, 0.20, 0.42, 0.71, 0.20, 0.39, 5.95};
  constexpr std::array<std::size_t, 6> kAxis = {1, 0, 0, 2, 2, 2};
  constexpr double kLength = 0.15;
  for (const double dt : kSteps) {
    Scene scene(engine(), kNeeds, kDown, 1);
    scene.body.mass_mode = PLUMB_MASS_EXPLICIT;
    std::vector<PlumbBody> links;
    for (std::size_t i = 0; i < kMass.size(); ++i) {
      const bool is_load = i + 1 == kMass.size();
      const double moment = is_load ? 0.002 : 4e-4 * kMass[i] * std::pow(kMass[i], 0.8);
      scene.body.mass = kMass[i];
      scene.body.inertia = {moment, is_load ? moment : 1.2 * moment, is_load ? moment : 0.8 * moment};
      links.push_back(scene.add(0, {kLength * (static_cast<double>(i) + (is_load ? 0 : 0.5)), 0, 0}));
      if (is_load) continue;
      PlumbJointDesc held =
          hinge(i == 0 ? 0 : links[i - 1], i == 0 ? 0 : kLength / 2, links[i], -kLength / 2, kAxes[kAxis[i]]);
      held.motors[3] = {0, 500, 1, 0};
      scene.join(held);
    }
    PlumbJointDesc grip = joint_desc(PLUMB_JOINT_FIXED);
    grip.body_a = links[5];
    grip.body_b = links[6];
    grip.frame_a.position = {kLength / 2, 0, 0};
    scene.join(grip);
    EXPECT_LT(fastest_after(2, scene, links, dt), 5e-4) << dt;
    EXPECT_NEAR(scene.poses().back().position.y, 0, 1e-3) << dt;
  }
}

}  // namespace
}  // namespace plumb::impulse::test
