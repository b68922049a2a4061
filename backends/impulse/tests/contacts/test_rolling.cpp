// Round bodies that roll: each turns by several degrees within a step, and none may rise or be let fall for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr double kRadius = 0.5, kSpeed = 3, kGravity = 9.81, kStep = 1.0 / 60;

PlumbShape cylinder(Scene& scene) {
  PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
  desc.radius = kRadius;
  desc.half_height = 1;
  return scene.make(desc);
}

PlumbShape plane(Scene& scene) {
  PlumbShapeDesc desc = shape_desc(PLUMB_PLANE);
  return scene.make(desc);
}

/// The ground: a box, or a plane whose shape has the ground's side as its own y.
enum class Ground { kBox, kPlane };

struct Case {
  const char* name;
  PlumbShapeType type;
  const char* solver;
  Ground ground;
};

class Rolling : public ::testing::TestWithParam<Case> {
 protected:
  Rolling()
      : scene_(engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION, {0, -kGravity, 0}, 1,
               {"solver", GetParam().solver}) {}

  PlumbShape roller() {
    if (GetParam().type == PLUMB_SPHERE) return scene_.sphere(kRadius);
    return GetParam().type == PLUMB_CAPSULE ? scene_.capsule(kRadius, 1) : cylinder(scene_);
  }
  void lay_ground() {
    if (GetParam().ground == Ground::kBox)
      scene_.ground();
    else
      scene_.add_static(plane(scene_), {0, 0, 0});
  }

  Scene scene_;
};

TEST_P(Rolling, NeitherRisesNorFallsNorSlows) {
  lay_ground();
  scene_.body.linear_velocity = {kSpeed, 0, 0};
  scene_.body.angular_velocity = {0, 0, -kSpeed / kRadius};
  const double half = std::sqrt(0.5);
  const PlumbBody body = scene_.add(roller(), {0, kRadius, 0}, {half, 0, 0, half});  // its axis along z
  double fall = 0;
  for (int i = 0; i < 120; ++i) {
    scene_.run(1);
    fall = std::max(fall, std::abs(scene_.velocity(body)[1]));
  }
  EXPECT_LT(fall, 0.01 * kGravity * kStep);
  EXPECT_NEAR(scene_.velocity(body)[0], kSpeed, 1e-3 * kSpeed);
}

/// Who creeps is not held up by a point that stayed behind, which would push it on.
TEST_P(Rolling, CreepsOnAsSlowlyAsItBegan) {
  constexpr double kCreep = 1e-3;
  lay_ground();
  scene_.body.linear_velocity = {kCreep, 0, 0};
  scene_.body.angular_velocity = {0, 0, -kCreep / kRadius};
  const double half = std::sqrt(0.5);
  const PlumbBody body = scene_.add(roller(), {0, kRadius, 0}, {half, 0, 0, half});
  scene_.run(600);
  EXPECT_NEAR(scene_.velocity(body)[0], kCreep, 0.01 * kCreep);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* solver : {"tgs_soft", "si", "jacobi", "xpbd"})
    for (const auto& [name, type] :
         {std::pair{"ball", PLUMB_SPHERE}, {"capsule", PLUMB_CAPSULE}, {"cylinder", PLUMB_CYLINDER}})
      for (const Ground ground : {Ground::kBox, Ground::kPlane}) all.push_back({name, type, solver, ground});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, Rolling, ::testing::ValuesIn(cases()), [](const auto& a_case) {
  return std::string(a_case.param.solver) + "_" + a_case.param.name +
         (a_case.param.ground == Ground::kBox ? "_on_box" : "_on_plane");
});

/// Euler's disk, rolling round on its rim about a centre that does not move (MacDonald, "The rolling motion of a disk
/// on a horizontal plane", 2000, section 2.1): the point that touches runs along the rim by up to half a radian a step.
struct Disk {
  static constexpr double kRim = 0.25, kHalf = 0.02, kMass = 10;
  double tilt;
  PlumbBody body = 0;

  void put(Scene& scene) {
    const double s = std::sin(tilt), c = std::cos(tilt), flat = kRim * kRim / 4 + kHalf * kHalf / 3;
    const double spin = std::sqrt(s * kGravity * (kRim * c - kHalf * s) / (flat * c - kRim * kHalf / 2 * s));
    PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
    desc.radius = kRim;
    desc.half_height = kHalf;
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = kMass;
    scene.body.angular_velocity = {spin * (c - kHalf / kRim * s), spin * (s + kHalf / kRim * c), 0};
    body = scene.add(scene.make(desc), {0, kRim * s + kHalf * c, 0}, {0, 0, std::sin(tilt / 2), std::cos(tilt / 2)});
    scene.body.angular_velocity = {0, 0, 0};
  }
  double energy(Scene& scene) const {
    const std::vector<double> v = scene.velocity(body);
    PlumbPose pose{};
    check(scene.world(), scene.world().read(PLUMB_FIELD_POSE, {&body, 1}, rows_over(std::span(&pose, 1))));
    const PlumbQuat& q = pose.orientation;
    const double axis[] = {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)};
    const double about = v[3] * axis[0] + v[4] * axis[1] + v[5] * axis[2];
    const double spin2 = v[3] * v[3] + v[4] * v[4] + v[5] * v[5], speed2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const double polar = kMass * kRim * kRim / 2, flat = kMass * (kRim * kRim / 4 + kHalf * kHalf / 3);
    return kMass * (speed2 / 2 + kGravity * pose.position.y) + flat / 2 * (spin2 - about * about) +
           polar / 2 * about * about;
  }
};

TEST(Rims, WhatRollsRoundOnItsRimGainsNothing) {
  for (const double degrees : {10, 20, 30, 45, 60, 70}) {
    for (const bool disk_first : {true, false}) {
      Scene scene(engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_GYROSCOPIC,
                  {0, -kGravity, 0}, 1);
      scene.body.material.friction = 1;
      Disk disk{degrees * std::numbers::pi / 180};
      if (disk_first) disk.put(scene);
      scene.ground();
      if (!disk_first) disk.put(scene);
      const double start = disk.energy(scene);
      double least = start, rise = 0;
      for (int step = 0; step < 600; ++step) {
        scene.run(1);
        const double now = disk.energy(scene);
        rise = std::max(rise, now - least);
        least = std::min(least, now);
      }
      EXPECT_LT(rise, 3e-3 * start) << degrees << ' ' << disk_first;
    }
  }
}

}  // namespace
}  // namespace plumb::impulse::test
