// Bodies that tumble as they touch.
#include <gtest/gtest.h>

#include <algorithm>

#include "bodies/swung_frame.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr double kGravity = 9.81;

/// Of a box of 1000 kg/m3, J.
double energy(Scene& scene, PlumbBody body, const PlumbVec3& half) {
  const std::vector<double> motion = scene.velocity(body);
  const PlumbPose pose = scene.poses().back();
  const PlumbQuat& q = pose.orientation;
  const Vec3<double> w = rotate_back(Quat4<double>{q.x, q.y, q.z, q.w}, Vec3<double>{motion[3], motion[4], motion[5]});
  const Vec3<double> v = {motion[0], motion[1], motion[2]};
  const double mass = 8000 * half.x * half.y * half.z;
  const Vec3<double> inertia = {half.y * half.y + half.z * half.z, half.x * half.x + half.z * half.z,
                                half.x * half.x + half.y * half.y};
  return mass * (dot(v, v) / 2 + dot(w, scale(inertia, w)) / 6 + kGravity * pose.position.y);
}

/// The most energy of any time over that of the start, of a box thrown on the ground with a spin about any axis.
double gain(const char* solver, const PlumbVec3& half, double spin, std::uint64_t seed) {
  Scene scene(engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_GYROSCOPIC,
              {0, -kGravity, 0}, 1, {"solver", solver});
  Random random(seed);
  scene.ground();
  scene.body.linear_velocity = {3, 0, 0};
  scene.body.angular_velocity = {random.between(-spin, spin), random.between(-spin, spin), random.between(-spin, spin)};
  const PlumbBody body = scene.add(scene.box(half), {0, 1.2, 0}, random.turn());
  const double start = energy(scene, body, half);
  double most = 0;
  for (int i = 0; i < 180; ++i) {
    scene.run(1);
    most = std::max(most, energy(scene, body, half));
  }
  return most / start;
}

/// A rod that turns by 40 degrees in a step has a hundredth of its inertia where the solver saw all of it.
TEST(Tumbling, BodiesThatTouchGainNoEnergy) {
  for (const char* solver : {"tgs_soft", "si", "jacobi", "xpbd"})
    for (const PlumbVec3& half : {PlumbVec3{0.02, 1, 0.02}, PlumbVec3{0.1, 1, 0.1}, PlumbVec3{0.05, 0.5, 0.2}})
      for (std::uint64_t seed = 1; seed <= 12; ++seed)
        EXPECT_LT(gain(solver, half, 30, seed), 1.05) << solver << " " << half.x << " " << seed;
}

/// At 2000 rad/s a body turns four radians in a sub-step: no row tells where it will be.
TEST(Tumbling, JointsHoldWhatSpinsBeyondReason) {
  for (const char* solver : {"tgs_soft", "si", "jacobi", "xpbd"})
    for (const bool limited : {false, true}) {
      Scene scene(engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS | PLUMB_NEED_GYROSCOPIC, {0, -kGravity, 0}, 1,
                  {"solver", solver});
      scene.body.material.friction = 0;
      scene.body.angular_velocity = {2000, 300, -200};
      const PlumbBody body = scene.add(scene.box({0.3, 0.2, 0.4}), {0, 0, 0});
      PlumbJointDesc hinge = joint_desc(PLUMB_JOINT_HINGE);
      hinge.body_b = body;
      if (limited) hinge.motors[3] = {1, 0.001, 1, 0};  // rows that do not always hold
      PlumbJoint id = 0;
      check(scene.world(), scene.world().joints()->create_joints({&hinge, 1}, {&id, 1}));
      scene.run(600);
      const std::vector<double> v = scene.velocity(body);
      EXPECT_LT(v[3] * v[3] + v[4] * v[4] + v[5] * v[5], 4000.0 * 4000) << solver << " " << limited;
    }
}

TEST(Tumbling, TheSwingTakesTheAxisToItsEnd) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const PlumbQuat turned = random.turn(), start = random.turn();
    const auto quat = [](const PlumbQuat& q) {
      return Quat{static_cast<Real>(q.x), static_cast<Real>(q.y), static_cast<Real>(q.z), static_cast<Real>(q.w)};
    };
    const Vec axis = rotate(quat(start), Vec{0, 1, 0});
    const Quat swing = swing_of(quat(turned), axis);
    EXPECT_LT(length(rotate(swing, axis) - rotate(quat(turned), axis)), 1e-5);
    EXPECT_NEAR(dot(vector_part(swing), axis), 0, 1e-6) << "a part about the axis is left";
  }
}

}  // namespace
}  // namespace plumb::impulse::test
