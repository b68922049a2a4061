// Contacts as the whole engine solves them, against dense algebra in double and the laws of friction.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kContactNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                     PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES;
constexpr double kDt = 1.0 / 60;
using Vector = Eigen::Vector3d;

Vector vector(const PlumbVec3& v) { return {v.x, v.y, v.z}; }

struct Motion {
  Vector linear, angular;
};
Motion motion(Scene& scene, PlumbBody body) {
  const std::vector<double> v = scene.velocity(body);
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

/// Mass and inverse inertia in world axes at a pose, from the interface's own mass row.
struct Mass {
  double inverse_mass;
  Eigen::Matrix3d inverse_inertia;
};
Mass mass(Scene& scene, PlumbBody body, const PlumbQuat& turn) {
  double row[11];
  check(scene.world(), scene.world().read(PLUMB_FIELD_MASS, {&body, 1},
                                          Rows(reinterpret_cast<std::byte*>(row), 1, sizeof row, PLUMB_F64)));
  const Eigen::Quaterniond to_body(row[10], row[7], row[8], row[9]), to_world(turn.w, turn.x, turn.y, turn.z);
  const Eigen::Matrix3d axes = (to_world * to_body).toRotationMatrix();
  const Vector inverse(1 / row[4], 1 / row[5], 1 / row[6]);
  return {1 / row[0], axes * inverse.asDiagonal() * axes.transpose()};
}

Eigen::Matrix3d cross_matrix(const Vector& r) {
  Eigen::Matrix3d m;
  m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return m;
}

/// A ball flies into a brick that is turned at random: one contact point, whose impulse follows from the matrix of the
/// point, K = 1/m + [r]^T I^-1 [r] of both.
void hit_a_brick(std::uint64_t seed, double friction) {
  Random random(seed);
  Scene scene(engine(), kContactNeeds, {0, 0, 0}, 1);
  scene.body.material.friction = friction;
  const PlumbQuat turn = random.turn();
  const PlumbBody brick = scene.add(scene.box({0.3, 0.5, 0.8}), {0, 0, 0}, turn);
  const PlumbVec3 place = {random.between(-0.2, 0.2), 1.6, random.between(-0.2, 0.2)};
  scene.body.linear_velocity = {random.between(-2, 2), -10, random.between(-2, 2)};
  scene.body.density = random.between(300, 3000);
  const PlumbBody ball = scene.add(scene.sphere(0.25), place);

  for (int i = 0; i < 20; ++i) {
    const std::vector<PlumbPose> poses = scene.poses();
    const Motion ball_before = motion(scene, ball), brick_before = motion(scene, brick);
    scene.run(1);
    const std::span<const PlumbContact> contacts = scene.world().contacts();
    if (contacts.empty() || contacts[0].normal_impulse == 0) continue;
    ASSERT_EQ(contacts.size(), 1U);
    const PlumbContact& contact = contacts[0];
    const bool brick_first = contact.body_a == brick;
    const Vector point = vector(contact.position), normal = vector(contact.normal) * (brick_first ? 1 : -1);
    // They touch later than the contact was found, each with its own surface.
    const Vector half_gap = std::max(-contact.depth, 0.0) / 2 * normal;
    const Vector to_brick = point - half_gap - vector(poses[0].position);
    const Vector to_ball = point + half_gap - vector(poses[1].position);
    EXPECT_NEAR((to_ball + 0.25 * normal).norm(), 0, 1e-5) << "seed " << seed;
    const Mass brick_mass = mass(scene, brick, poses[0].orientation), ball_mass = mass(scene, ball, {0, 0, 0, 1});
    const auto give = [&](const Mass& of, const Vector& arm) -> Eigen::Matrix3d {
      const Eigen::Matrix3d r = cross_matrix(arm);
      return of.inverse_mass * Eigen::Matrix3d::Identity() + r.transpose() * of.inverse_inertia * r;
    };
    const Eigen::Matrix3d k = give(brick_mass, to_brick) + give(ball_mass, to_ball);
    const Vector closing = ball_before.linear + ball_before.angular.cross(to_ball) - brick_before.linear -
                           brick_before.angular.cross(to_brick);
    const Vector expected = friction == 0 ? Vector(-normal * normal.dot(closing) / normal.dot(k * normal))
                                          : Vector(-k.inverse() * closing);  // sticks
    const Vector found =
        (vector(contact.normal) * contact.normal_impulse + vector(contact.tangent_impulse)) * (brick_first ? 1 : -1);
    EXPECT_NEAR((found - expected).norm() / expected.norm(), 0, friction == 0 ? 1e-4 : 5e-3) << "seed " << seed;
    const Motion ball_after = motion(scene, ball), brick_after = motion(scene, brick);
    EXPECT_NEAR((ball_after.linear - ball_before.linear - ball_mass.inverse_mass * found).norm(), 0, 1e-4);
    EXPECT_NEAR(
        (brick_after.angular - brick_before.angular + brick_mass.inverse_inertia * to_brick.cross(found)).norm(), 0,
        2e-3)
        << "seed " << seed;
    return;
  }
  FAIL() << "the ball missed, seed " << seed;
}

TEST(Contacts, AnImpulseIsThatOfTheEffectiveMass) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) hit_a_brick(seed, 0);
}

TEST(Contacts, AnImpulseThatSticksIsThatOfTheWholeMatrix) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) hit_a_brick(seed, 100);
}

/// Gravity leans by 30 degrees; a cube slides at any yaw. Friction is mu times the load, straight against the slip.
TEST(Contacts, ASlidingCubeFeelsMuTimesItsLoadAtAnyYaw) {
  constexpr double kG = 9.81, kFriction = 0.3, kSine = 0.5, kCosine = 0.8660254037844386;
  for (int yaw = 0; yaw < 12; ++yaw) {
    Scene scene(engine(), kContactNeeds, {kG * kSine, -kG * kCosine, 0}, 1);
    scene.body.material.friction = kFriction;
    scene.ground();
    scene.body.linear_velocity = {1, 0, 0};
    const double half = 0.5 * 0.13 * yaw;
    const PlumbBody cube = scene.add(scene.box({0.5, 0.5, 0.5}), {-40, 0.5, 0}, {0, std::sin(half), 0, std::cos(half)});
    scene.run(30);  // the solver has found the load of each corner
    const Motion before = motion(scene, cube);
    constexpr int kSteps = 60;
    scene.run(kSteps);
    const Motion after = motion(scene, cube);
    const double friction = kG * kSine - (after.linear.x() - before.linear.x()) / (kSteps * kDt);
    EXPECT_NEAR(friction / (kFriction * kG * kCosine), 1, 1e-3) << "yaw " << yaw;
    EXPECT_NEAR(after.linear.z() / after.linear.x(), 0, 1e-3) << "yaw " << yaw;
  }
}

/// Points are known again from step to step, and carry what they carried: a tower whose impulses begin at 0 in each
/// step sags twenty times as much.
TEST(Contacts, AreRememberedFromStepToStep) {
  Scene scene(engine(), kContactNeeds, {0, -9.81, 0}, 1);
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  constexpr unsigned kCubes = 10;
  for (unsigned i = 0; i < kCubes; ++i) scene.add(cube, {0, 0.5 + i, 0}, {0, 0.2, 0, 0.9797958971132712});
  const PlumbBody ground = scene.world().bodies().front();
  scene.run(120);
  EXPECT_NEAR(scene.poses().back().position.y, kCubes - 0.5, 0.005);
  std::vector<std::uint64_t> features;
  for (int step = 0; step < 10; ++step) {
    scene.run(1);
    double sum = 0;
    std::vector<std::uint64_t> now;
    for (const PlumbContact& contact : scene.world().contacts()) {
      now.push_back(contact.feature);
      if (contact.body_a == ground || contact.body_b == ground) sum += contact.normal_impulse;
    }
    ASSERT_EQ(now.size(), 4 * kCubes);
    EXPECT_TRUE(step == 0 || now == features);
    features = now;
    EXPECT_NEAR(sum / (kCubes * 1000 * 9.81 * kDt), 1, 1e-3);
  }
}

/// A light body in the slot and place of a heavy one does not get its impulses. Bodies lie on it, or the one contact
/// would be solved exactly whatever it began with.
TEST(Contacts, OfTheDeadAreForgotten) {
  Scene scene(engine(), kContactNeeds, {0, -9.81, 0}, 1);
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  scene.body.density = 1e5;
  const PlumbBody heavy = scene.add(cube, {0, 0.5, 0});
  scene.body.density = 10;
  std::vector<PlumbBody> stack;
  for (int i = 1; i < 4; ++i) stack.push_back(scene.add(cube, {0, 0.5 + i, 0}));
  scene.run(60);
  check(scene.world(), scene.world().destroy_bodies({&heavy, 1}));
  const PlumbBody light = scene.add(cube, {0, 0.5, 0});
  ASSERT_EQ(slot_of(light), slot_of(heavy));
  stack.push_back(light);
  scene.run(1);
  for (const PlumbBody body : stack) EXPECT_LT(motion(scene, body).linear.norm(), 0.05);
}

/// The contacts of a step stay readable, and true, when a body of others dies or is moved after it.
void a_body_dies(bool another_is_moved) {
  Scene scene(engine(), kContactNeeds, {0, -9.81, 0}, 1);
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  const PlumbBody stays = scene.add(cube, {0, 0.5, 0}), dies = scene.add(cube, {5, 0.5, 0});
  scene.run(10);
  const PlumbPose away = {{0, 30, 0}, {0, 0, 0, 1}};
  if (another_is_moved)
    check(scene.world(),
          scene.world().write(PLUMB_FIELD_POSE, {&stays, 1}, const_rows_over(std::span<const PlumbPose>(&away, 1))));
  check(scene.world(), scene.world().destroy_bodies({&dies, 1}));
  const std::span<const PlumbContact> contacts = scene.world().contacts();
  ASSERT_EQ(contacts.size(), 4U);
  for (const PlumbContact& contact : contacts) {
    EXPECT_TRUE(contact.body_a == stays || contact.body_b == stays);
    EXPECT_NEAR(contact.position.y, 0, 0.01);
  }
}
TEST(Contacts, OutliveTheDeathOfOthers) {
  a_body_dies(false);
  a_body_dies(true);
}

/// Over boxes side by side cubes slide as over one: v^2 / (2 mu g) far, straight, whatever their heading and yaw.
TEST(Contacts, LevelTilesAreOneFloor) {
  constexpr double kSpeed = 5, kFriction = 0.5, kFar = kSpeed * kSpeed / (2 * kFriction * 9.81);
  Scene scene(engine(), kContactNeeds, {0, -9.81, 0}, 1);
  scene.body.material.friction = kFriction;
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int i = -12; i <= 12; ++i)
    for (int j = -12; j <= 12; ++j) scene.add_static(cube, {i + 0.137, -0.5, j + 0.291});
  std::vector<PlumbBody> cubes;
  const auto start = [](int k) { return Vector(8 * (k % 3 - 1), 0.5, 8 * (k / 3 - 1)); };
  const auto heading = [](int k) { return Vector(std::cos(0.7 * k), 0, std::sin(0.7 * k)); };
  for (int k = 0; k < 9; ++k) {
    const Vector v = kSpeed * heading(k), at = start(k);
    scene.body.linear_velocity = {v.x(), v.y(), v.z()};
    cubes.push_back(scene.add(cube, {at.x(), at.y(), at.z()}, {0, std::sin(0.2 * k), 0, std::cos(0.2 * k)}));
    scene.body.linear_velocity = {};
  }
  scene.run(90);
  const std::vector<PlumbPose> poses = scene.poses();
  for (int k = 0; k < 9; ++k) {
    const Vector way = vector(poses[poses.size() - 9 + static_cast<std::size_t>(k)].position) - start(k);
    EXPECT_LT((way - kFar * heading(k)).norm(), 0.02 * kFar) << k;
  }
}

}  // namespace
}  // namespace plumb::impulse::test
