// Axes that a body neither moves along nor turns about.
#include <gtest/gtest.h>

#include <cmath>

#include "bodies/axis_locks.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kLockNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                  PLUMB_NEED_AXIS_LOCKS | PLUMB_NEED_FORCES | PLUMB_NEED_GYROSCOPIC;
constexpr const char* kSolvers[] = {"tgs_soft", "si", "jacobi", "xpbd"};

/// A heap of boxes that move in the plane z = 0 only: not a bit of z, and no turn out of the plane.
TEST(Locks, HoldExactly) {
  for (const char* solver : kSolvers) {
    Scene scene(engine(), kLockNeeds, kDown, 1, {"solver", solver});
    scene.ground();
    scene.body.locks = PLUMB_LOCK_LINEAR_Z | PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Y;
    const PlumbShape brick = scene.box({0.5, 0.3, 0.4});
    for (int i = 0; i < 20; ++i)
      scene.add(brick, {0.7 * (i % 4), 1 + 1.2 * (i / 4), 0.1 * (i % 3)}, {0, 0, std::sin(0.2 * i), std::cos(0.2 * i)});
    // A ball that is free comes from the side and pushes along z.
    scene.body.locks = 0;
    scene.body.linear_velocity = {0, 0, -8};
    scene.add(scene.sphere(0.5), {1, 1, 4});
    scene.run(120);
    const std::vector<PlumbPose> poses = scene.poses();
    for (std::size_t i = 1; i < 21; ++i) {
      EXPECT_EQ(poses[i].position.z, 0.1 * static_cast<double>((i - 1) % 3)) << solver;
      EXPECT_EQ(poses[i].orientation.x, 0) << solver;
      EXPECT_EQ(poses[i].orientation.y, 0) << solver;
    }
  }
}

/// Held along x, a ball on a slope stays where it is: the slope can only push it up and along x.
TEST(Locks, CarryWhatTheyHold) {
  Scene scene(engine(), kLockNeeds, kDown, 1);
  constexpr double kHalf = 0.38268343236508977;  // of 45 degrees
  scene.body.material.friction = 0;
  scene.add_static(scene.box({5, 0.5, 5}), {0, -0.70710678118654752, 0}, {0, 0, kHalf, std::sqrt(1 - kHalf * kHalf)});
  scene.body.locks = PLUMB_LOCK_LINEAR_X;
  const PlumbBody ball = scene.add(scene.sphere(0.5), {0, 0.70710678118654752, 0});
  scene.run(120);
  EXPECT_NEAR(scene.poses()[1].position.y, 0.70710678118654752, 5e-3);
  EXPECT_NEAR(scene.velocity(ball)[1], 0, 5e-3);
}

/// Free about z alone: it turns by the moment about z, however it lies; and not when it is pushed about others.
TEST(Locks, LeaveTheMomentAboutWhatIsFree) {
  Scene scene(engine(), kLockNeeds & ~PLUMB_NEED_COLLISION, {0, 0, 0}, 1);
  scene.body.mass_mode = PLUMB_MASS_EXPLICIT;
  scene.body.mass = 2;
  scene.body.inertia = {1, 3, 3.5};
  scene.body.locks = PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Y;
  constexpr double kSine = 0.47942553860420301, kCosine = 0.87758256189037271;  // of half a radian, about y
  const PlumbBody body = scene.add(0, {0, 0, 0}, {0, kSine, 0, kCosine});
  const double s = 2 * kSine * kCosine, c = kCosine * kCosine - kSine * kSine;
  const double about_z = 1 * s * s + 3.5 * c * c;
  scene.write(PLUMB_FIELD_ANGULAR_IMPULSE, body, {5, 7, 2});
  EXPECT_NEAR(scene.velocity(body)[5], 2 / about_z, 1e-6);
  EXPECT_EQ(scene.velocity(body)[3], 0);
  scene.write(PLUMB_FIELD_TORQUE, body, {1, 1, 3});
  scene.run(1);
  EXPECT_NEAR(scene.velocity(body)[5], (2 + 3.0 / 60) / about_z, 1e-6);
  scene.write(PLUMB_FIELD_VELOCITY, body, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(scene.velocity(body)[3], 0);
  EXPECT_EQ(scene.velocity(body)[5], 6);
}

/// The Schur complement, axis by axis, is the inverse of what is left of the inertia.
TEST(Locks, TheInertiaOfTwoFreeAxesIsTheirsAlone) {
  const Quat q = normalized(Quat{Real(0.1), Real(-0.4), Real(0.3), Real(0.8)});
  BodyMass mass{};
  mass.inertia = {1, 3, Real(3.5)};
  mass.inverse_inertia = {1, Real(1) / 3, Real(1) / Real(3.5)};
  mass.flags = kBodyLocked | kLockAngular << 1;
  const Sym inverse = world_inverse_inertia(q, mass);
  const Sym whole = rotated_diagonal(to_matrix(q), mass.inertia);
  const double determinant = static_cast<double>(whole.xx) * whole.zz - static_cast<double>(whole.xz) * whole.xz;
  EXPECT_NEAR(inverse.xx, whole.zz / determinant, 1e-5);
  EXPECT_NEAR(inverse.xz, -whole.xz / determinant, 1e-5);
  EXPECT_NEAR(inverse.zz, whole.xx / determinant, 1e-5);
  EXPECT_EQ(inverse.xy, 0);
  EXPECT_EQ(inverse.yy, 0);
}

}  // namespace
}  // namespace plumb::impulse::test
