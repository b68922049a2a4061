#include <cmath>

#include "backend_under_test.hpp"
#include "plumb/backend/small_math.hpp"
#include "plumb/helpers/ragdoll.hpp"

namespace plumb::helpers::test {
namespace {

constexpr double dt = 1.0 / 120;

/// A trunk with two arms and two legs of one bone each.
std::vector<Bone> puppet() {
  Bone trunk{"trunk", -1, {0, 1, 0}, {0, 1.6, 0}, 0.12, 30};
  std::vector<Bone> bones{trunk};
  for (const double side : {-1.0, 1.0}) {
    bones.push_back(
        {"arm", 0, {0.25 * side, 1.55, 0}, {0.8 * side, 1.55, 0}, 0.05, 4, {-0.8, -0.3, -0.8}, {0.8, 0.3, 0.8}});
    bones.push_back({"leg", 0, {0.12 * side, 1, 0}, {0.12 * side, 0.2, 0}, 0.07, 10, {-1, -0.3, -0.5}, {1, 0.3, 0.5}});
  }
  return bones;
}

TEST(Ragdoll, WeighsWhatItsBonesWeigh) {
  TestWorld t;
  const std::vector<Bone> bones = puppet();
  Ragdoll doll(*t.world, bones, identity_pose());
  double mass = 0;
  for (const PlumbBody body : doll.bodies()) {
    std::array<double, 11> row{};
    check(*t.world, t.world->read(PLUMB_FIELD_MASS, {&body, 1}, rows_over(std::span(&row, 1))));
    mass += row[0];
  }
  EXPECT_NEAR(mass, 58, 1e-4);
  std::vector<BoneAngles> angles(bones.size());
  doll.read_angles(angles);
  for (const BoneAngles& bone : angles)
    for (const double angle : bone) EXPECT_NEAR(angle, 0, 1e-5);
}

TEST(Ragdoll, MotorsBringItToAPoseAndHoldIt) {
  TestWorld t;
  const std::vector<Bone> bones = puppet();
  Ragdoll doll(*t.world, bones, identity_pose());
  const PlumbBody trunk = doll.bodies()[0];
  std::vector<BoneAngles> pose(bones.size());
  pose[1] = {0.5, 0, 0};
  pose[2] = {0.4, 0, 0};
  std::vector<BoneAngles> angles(bones.size());
  for (int i = 0; i < 240; ++i) {
    t.set_velocity(trunk, {});  // held, as by a hand
    doll.drive(pose);
    t.step(dt);
  }
  doll.read_angles(angles);
  for (std::size_t i = 1; i < bones.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(angles[i][k], pose[i][k], 0.04) << i << ' ' << k;
}

TEST(Ragdoll, FallsLimpWithinItsLimitsAndComesToRest) {
  TestWorld t;
  t.box(PLUMB_STATIC, {20, 1, 20}, {0, -1, 0});
  const std::vector<Bone> bones = puppet();
  RagdollSettings settings;
  settings.friction_torque = 3;
  Ragdoll doll(*t.world, bones, {{0, 0.3, 0}, {std::sin(0.2), 0, 0, std::cos(0.2)}}, settings);
  std::vector<BoneAngles> angles(bones.size());
  for (int i = 0; i < 720; ++i) {
    t.step(dt);
    doll.read_angles(angles);
    for (std::size_t b = 1; b < bones.size(); ++b)
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_LT(angles[b][k], bones[b].upper[k] + 0.25) << i << ' ' << b << ' ' << k;
        ASSERT_GT(angles[b][k], bones[b].lower[k] - 0.25) << i << ' ' << b << ' ' << k;
      }
  }
  for (const PlumbBody body : doll.bodies()) {
    const PlumbVec3 v = t.velocity(body).linear;
    EXPECT_LT(std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z), 0.1);
    EXPECT_GT(t.pose(body).position.y, 0);
  }
}

/// Arms in cones, wherever an engine can drive a swing: a twist is about the arm, a swing about what is square to it.
TEST(Ragdoll, ArmsInConesAreBroughtToAPoseAndLetGo) {
  TestWorld t;
  if (backend_under_test().capability(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_SWING_TWIST, PLUMB_JOINT_HAS_MOTORS) ==
      PLUMB_NONE)
    GTEST_SKIP() << "it drives no swing";
  std::vector<Bone> bones = puppet();
  for (Bone& bone : bones) bone.in_cone = bone.name == "arm";
  Ragdoll doll(*t.world, bones, identity_pose());
  std::vector<BoneAngles> pose(bones.size()), angles(bones.size());
  pose[1] = {0.5, 0.2, -0.4};
  pose[3] = {0, -0.25, 0.6};
  const auto hold = [&](int steps, bool driven) {
    for (int i = 0; i < steps; ++i) {
      t.set_velocity(doll.bodies()[0], {});
      if (driven) doll.drive(pose);
      t.step(dt);
    }
    doll.read_angles(angles);
  };
  hold(240, true);
  for (std::size_t i = 1; i < bones.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(angles[i][k], pose[i][k], 0.04) << i << ' ' << k;
  const PlumbVec3 along = backend::rotate(t.pose(doll.bodies()[1]).orientation, {0, 1, 0});
  EXPECT_NEAR(std::acos(-along.x), std::hypot(0.5, 0.4), 0.04);
  doll.go_limp();
  hold(600, false);
  for (const std::size_t arm : {1U, 3U}) EXPECT_NEAR(std::hypot(angles[arm][0], angles[arm][2]), 0.8, 0.06) << arm;
}

TEST(Ragdoll, RefusesAConeThatIsNone) {
  TestWorld t;
  std::vector<Bone> bones = puppet();
  bones[1].in_cone = true;
  bones[1].upper[0] = 0.5;
  EXPECT_THROW(Ragdoll(*t.world, bones, identity_pose()), Error);
}

TEST(Ragdoll, RefusesASkeletonThatIsNone) {
  TestWorld t;
  std::vector<Bone> bones = puppet();
  bones[1].parent = 3;
  EXPECT_THROW(Ragdoll(*t.world, bones, identity_pose()), Error);
  EXPECT_THROW(Ragdoll(*t.world, {}, identity_pose()), Error);
}

}  // namespace
}  // namespace plumb::helpers::test
