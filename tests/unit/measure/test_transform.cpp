// Transformed scenes: what must change does, by the right power, and nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "measure/instruments/transform.hpp"

namespace plumb::harness {
namespace {

/// A box with everything set, hinged to the world and to a sphere.
Scene sample() {
  Scene scene;
  scene.id = "T1";
  scene.shapes.resize(2);
  scene.shapes[0].desc = shape_desc(PLUMB_BOX);
  scene.shapes[0].desc.half_extents = {1, 2, 3};
  scene.shapes[1].desc = shape_desc(PLUMB_SPHERE);
  scene.shapes[1].desc.radius = 0.5;
  scene.bodies.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    scene.bodies[i].name = i == 0 ? "box" : "ball";
    scene.bodies[i].shape = i;
    scene.bodies[i].desc = body_desc();
  }
  PlumbBodyDesc& box = scene.bodies[0].desc;
  box.pose.position = {1, 2, 3};
  box.linear_velocity = {4, 0, 0};
  box.angular_velocity = {0, 6, 0};
  box.mass_mode = PLUMB_MASS_EXPLICIT;
  box.mass = 2;
  box.inertia = {1, 2, 3};
  box.linear_damping = 0.5;
  scene.joints.resize(2);
  scene.joints[0].desc = joint_desc(PLUMB_JOINT_HINGE);
  scene.joints[0].body_b = 0;
  scene.joints[0].desc.frame_a.position = {1, 0, 0};
  scene.joints[0].desc.motors[3] = {5, 7, 1, 0};
  scene.joints[0].desc.springs[3] = {0.1, 2, 3, 1, PLUMB_SPRING_STIFFNESS};
  scene.joints[1].desc = joint_desc(PLUMB_JOINT_SLIDER);
  scene.joints[1].body_a = 0;
  scene.joints[1].body_b = 1;
  scene.joints[1].desc.frame_a.position = {0, 1, 0};
  scene.joints[1].desc.limits[0] = {-1, 2, 1, 0};
  scene.joints[1].desc.motors[0] = {5, 7, 1, 0};
  scene.joints[1].desc.springs[0] = {0.1, 2, 3, 1, PLUMB_SPRING_STIFFNESS};
  return scene;
}

TEST(Transform, ScaledByFour) {
  const Scene before = sample(), after = scaled(before, 4);
  EXPECT_DOUBLE_EQ(after.dt, 2 * before.dt);
  EXPECT_DOUBLE_EQ(after.seconds, 2 * before.seconds);
  EXPECT_EQ(after.gravity.y, before.gravity.y);
  EXPECT_EQ(after.shapes[0].desc.half_extents.z, 12);
  EXPECT_EQ(after.shapes[1].desc.radius, 2);
  const PlumbBodyDesc& box = after.bodies[0].desc;
  EXPECT_EQ(box.pose.position.x, 4);
  EXPECT_EQ(box.linear_velocity.x, 8);
  EXPECT_EQ(box.angular_velocity.y, 3);
  EXPECT_EQ(box.mass, 2 * 64);
  EXPECT_EQ(box.inertia.z, 3 * 1024);
  EXPECT_EQ(box.density, before.bodies[0].desc.density);
  EXPECT_EQ(box.linear_damping, 0.25);
  const PlumbJointDesc &hinge = after.joints[0].desc, &slider = after.joints[1].desc;
  EXPECT_EQ(hinge.frame_a.position.x, 4);
  EXPECT_EQ(hinge.motors[3].target_velocity, 2.5);
  EXPECT_EQ(hinge.motors[3].max_force, 7 * 256);
  EXPECT_EQ(slider.limits[0].upper, 8);
  EXPECT_EQ(slider.motors[0].target_velocity, 10);
  EXPECT_EQ(slider.motors[0].max_force, 7 * 64);
  const PlumbSpring &turning = hinge.springs[3], &sliding = slider.springs[0];
  EXPECT_EQ(turning.rest, 0.1);
  EXPECT_EQ(turning.frequency, 2 * 256) << "torque over an angle";
  EXPECT_EQ(turning.damping_ratio, 3 * 512) << "torque over a rate, which is halved";
  EXPECT_EQ(sliding.rest, 0.4);
  EXPECT_EQ(sliding.frequency, 2 * 16);
  EXPECT_EQ(sliding.damping_ratio, 3 * 32);
}

TEST(Transform, HeavierKeepsWhatMoves) {
  const Scene after = heavier(sample(), 10);
  EXPECT_EQ(after.bodies[0].desc.mass, 20);
  EXPECT_EQ(after.bodies[0].desc.inertia.x, 10);
  EXPECT_EQ(after.bodies[1].desc.density, 10000);
  EXPECT_EQ(after.bodies[0].desc.linear_velocity.x, 4);
  EXPECT_EQ(after.joints[0].desc.motors[3].max_force, 70);
  EXPECT_EQ(after.joints[0].desc.springs[3].frequency, 20);
  EXPECT_EQ(after.joints[0].desc.springs[3].damping_ratio, 30);
  EXPECT_EQ(after.joints[0].desc.motors[3].target_velocity, 5);
}

TEST(Transform, TranslatedMovesOnlyTheWorldsFrames) {
  const Scene after = translated(sample(), {10, 0, 0});
  EXPECT_EQ(after.bodies[0].desc.pose.position.x, 11);
  EXPECT_EQ(after.bodies[1].desc.pose.position.x, 10);
  EXPECT_EQ(after.joints[0].desc.frame_a.position.x, 11);
  EXPECT_EQ(after.joints[1].desc.frame_a.position.x, 0);
}

TEST(Transform, BoostedAddsAVelocityToFreeBodiesOnly) {
  Scene scene = sample();
  EXPECT_THROW(static_cast<void>(boosted(scene, {10, 0, 0})), std::logic_error);  // hinged to the world
  scene.joints.erase(scene.joints.begin());
  const Scene after = boosted(scene, {10, 20, 0});
  EXPECT_EQ(after.bodies[0].desc.linear_velocity.x, 14);
  EXPECT_EQ(after.bodies[1].desc.linear_velocity.y, 20);
  EXPECT_EQ(after.bodies[0].desc.angular_velocity.y, 6);
  EXPECT_EQ(after.bodies[0].desc.pose.position.x, 1);
  scene.bodies[0].desc.motion = PLUMB_STATIC;
  EXPECT_THROW(static_cast<void>(boosted(scene, {10, 0, 0})), std::logic_error);
}

TEST(Transform, RotatedAQuarterAboutZ) {
  const referee::Quat turn(Eigen::AngleAxisd(std::numbers::pi / 2, referee::Vec3::UnitZ()));
  const Scene after = rotated(sample(), turn);
  EXPECT_NEAR(after.gravity.x, 9.81, 1e-12);
  EXPECT_NEAR(after.gravity.y, 0, 1e-12);
  const PlumbBodyDesc& box = after.bodies[0].desc;
  EXPECT_NEAR(box.pose.position.x, -2, 1e-12);
  EXPECT_NEAR(box.pose.position.y, 1, 1e-12);
  EXPECT_NEAR(box.linear_velocity.y, 4, 1e-12);
  EXPECT_NEAR(box.angular_velocity.x, -6, 1e-12);
  EXPECT_NEAR(box.pose.orientation.z, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(box.inertia.x, 1);
  EXPECT_NEAR(after.joints[0].desc.frame_a.position.y, 1, 1e-12);
  EXPECT_EQ(after.joints[1].desc.frame_a.position.y, 1);
}

TEST(Transform, RotatedRefusesLockedAxes) {
  Scene scene = sample();
  scene.bodies[1].desc.locks = PLUMB_LOCK_LINEAR_Z;
  EXPECT_THROW(static_cast<void>(rotated(scene, referee::Quat::Identity())), std::logic_error);
}

TEST(Transform, MirroredTwiceIsTheSameAndSpinsTurnTheOtherWay) {
  Scene scene = sample();
  EXPECT_THROW(static_cast<void>(mirrored(scene)), std::logic_error);  // a hinge has a hand
  scene.joints.erase(scene.joints.begin(), scene.joints.end());
  scene.bodies[0].desc.pose.orientation = {0.1, 0.5, 0.3, std::sqrt(1 - 0.35)};
  const Scene after = mirrored(scene);
  EXPECT_EQ(after.bodies[0].desc.pose.position.x, -1);
  EXPECT_EQ(after.bodies[0].desc.pose.position.y, 2);
  EXPECT_EQ(after.bodies[0].desc.linear_velocity.x, -4);
  EXPECT_EQ(after.bodies[0].desc.angular_velocity.y, -6);
  // A point of the mirrored box, seen in the mirror, is a point of the box.
  const auto corner = [](const Scene& of, double x) -> referee::Vec3 {
    const PlumbPose& pose = of.bodies[0].desc.pose;
    return referee::quat(pose.orientation) * referee::Vec3(x, 2, 3) + referee::vec(pose.position);
  };
  const referee::Vec3 seen = corner(after, -1).cwiseProduct(referee::Vec3(-1, 1, 1));
  EXPECT_NEAR((seen - corner(scene, 1)).norm(), 0, 1e-14);
  EXPECT_EQ(mirrored(after).bodies[0].desc.pose.orientation.y, 0.5);
}

TEST(Transform, PermutedTakesJointsAlong) {
  const std::vector<std::size_t> order{1, 0};
  const Scene after = permuted(sample(), order);
  EXPECT_EQ(after.bodies[0].name, "ball");
  EXPECT_EQ(after.joints[0].body_b, 1u);
  EXPECT_FALSE(after.joints[0].body_a);
  EXPECT_EQ(after.joints[1].body_a, 1u);
  EXPECT_EQ(after.joints[1].body_b, 0u);
}

}  // namespace
}  // namespace plumb::harness
