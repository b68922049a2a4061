// Continuous collision against what is not convex, and of what turns: nothing passes that is flagged not to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kSurfaceNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_CCD | PLUMB_NEED_KINEMATIC;

constexpr const char* kSolvers[] = {"tgs_soft", "si", "jacobi", "xpbd"};

enum class Floor { kPlane, kSheet, kFineSheet, kHills, kField, kCompound, kCylinder };
constexpr Floor kFloors[] = {Floor::kPlane, Floor::kSheet,    Floor::kFineSheet, Floor::kHills,
                             Floor::kField, Floor::kCompound, Floor::kCylinder};

/// Its surface is at y = 0, or no more than `kRough` away.
constexpr double kRough = 0.3, kCell = 6.1;
double hills(double x, double z) { return kRough * std::sin(0.17 * x) * std::cos(0.11 * z); }

void add_floor(Scene& scene, Floor floor) {
  const std::uint32_t cells = 40;
  switch (floor) {
    case Floor::kPlane: scene.add_static(scene.make(shape_desc(PLUMB_PLANE)), {0, 0, 0}); return;
    case Floor::kSheet: scene.add_static(scene.make(flat_grid(2, 200).desc()), {0, 0, 0}); return;
    case Floor::kFineSheet: scene.add_static(scene.make(flat_grid(cells, kCell).desc()), {0, 0, 0}); return;
    case Floor::kHills: scene.add_static(scene.make(grid(cells, kCell, hills).desc()), {0, 0, 0}); return;
    case Floor::kField: {
      std::vector<double> heights;
      for (std::uint32_t r = 0; r <= cells; ++r)
        for (std::uint32_t c = 0; c <= cells; ++c) heights.push_back(hills(c * kCell, r * kCell));
      scene.add_static(scene.make(field_desc(heights, cells + 1, cells + 1, kCell)), {0, 0, 0});
      return;
    }
    case Floor::kCompound: {
      const PlumbShape tile = scene.box({60, 0.02, 60});
      std::vector<PlumbCompoundChild> children;
      for (int i = 0; i < 4; ++i) children.push_back(child(tile, {i % 2 * 120.0 - 60, -0.02, i / 2 * 120.0 - 60}));
      scene.add_static(make_compound(scene, children), {0, 0, 0});
      return;
    }
    case Floor::kCylinder: {
      PlumbShapeDesc disc = shape_desc(PLUMB_CYLINDER);
      disc.radius = 170;
      disc.half_height = 0.02;
      scene.add_static(scene.make(disc), {0, -0.02, 0});
      return;
    }
  }
}

enum class Bullet { kBall, kCube, kCapsule, kCylinder, kHull, kCompound };
constexpr Bullet kBullets[] = {Bullet::kBall,     Bullet::kCube, Bullet::kCapsule,
                               Bullet::kCylinder, Bullet::kHull, Bullet::kCompound};
PlumbShape make_bullet(Scene& scene, Bullet bullet) {
  switch (bullet) {
    case Bullet::kBall: return scene.sphere(0.1);
    case Bullet::kCube: return scene.box({0.1, 0.08, 0.06});
    case Bullet::kCapsule: return scene.capsule(0.05, 0.1);
    case Bullet::kHull: return scene.hull({{0.1, 0, 0}, {-0.1, 0.1, 0}, {-0.1, -0.1, 0.1}, {-0.1, -0.1, -0.1}});
    case Bullet::kCompound:
      return make_compound(scene, {child(scene.sphere(0.06), {0.1, 0, 0}), child(scene.box({0.1, 0.04, 0.04}))});
    default: break;
  }
  PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
  desc.radius = 0.06;
  desc.half_height = 0.1;
  return scene.make(desc);
}

/// Shots from above and, where there is a below, from below.
TEST(ContinuousSurfaces, NoBulletPasses) {
  for (const Floor floor : kFloors)
    for (const Bullet bullet : kBullets) {
      Random random(static_cast<std::uint64_t>(floor) * 100 + static_cast<std::uint64_t>(bullet));
      for (int shot = 0; shot < 24; ++shot) {
        Scene scene(engine(), kSurfaceNeeds, {0, 0, 0}, 1, {"solver", kSolvers[shot % 4]});
        add_floor(scene, floor);
        const double speed = 15 * std::pow(10.0, random.between(0, 2.5));
        const double side = floor != Floor::kPlane && shot % 3 == 2 ? -1 : 1;
        const double x = random.between(-4, 4), z = random.between(-4, 4), height = random.between(0.7, 6);
        scene.body.flags = PLUMB_BODY_CCD;
        scene.body.linear_velocity = {speed * random.between(-0.7, 0.7), -side * speed,
                                      speed * random.between(-0.7, 0.7)};
        scene.body.angular_velocity = {random.between(-20, 20), random.between(-20, 20), random.between(-20, 20)};
        const PlumbBody body = scene.add(make_bullet(scene, bullet), {x, side * height, z}, random.turn());
        const int steps = static_cast<int>(height / speed * 60) + 3;
        for (int step = 0; step < steps; ++step) scene.run(1);
        const double end = scene.poses()[1].position.y * side;
        EXPECT_GT(end, -kRough - 0.1) << "floor " << static_cast<int>(floor) << " bullet " << static_cast<int>(bullet)
                                      << " shot " << shot << " by " << kSolvers[shot % 4] << " at " << speed << " m/s";
        const std::vector<double> v = scene.velocity(body);
        const PlumbVec3& came = scene.body.linear_velocity;
        const double most = came.x * came.x + came.y * came.y + came.z * came.z + 1;
        EXPECT_LT(v[0] * v[0] + v[1] * v[1] + v[2] * v[2], most) << "nobody pushes it";
      }
    }
}

/// Across the x axis, in squares of half a metre.
TriangleSet upright_sheet(std::uint32_t cells) {
  TriangleSet sheet = flat_grid(cells, 0.5);
  for (std::size_t i = 0; i < sheet.vertices.size(); i += 3) std::swap(sheet.vertices[i], sheet.vertices[i + 1]);
  return sheet;
}

/// How far the rod's ends come beyond x = 0; half: of its length, along its y axis.
double reach_of(const PlumbPose& pose, double half, double thick) {
  const PlumbQuat& q = pose.orientation;
  const double x = 2 * (q.x * q.y - q.w * q.z);
  return pose.position.x + half * std::abs(x) + thick * std::sqrt(std::max(0.0, 1 - x * x));
}

/// A rod of 2 m that turns by 48 degrees a step, beside a wall and thrown at it. Box, sheet, and a door that closes.
struct Rod {
  double distance, speed;
  bool sheet;
  double door = 0;  ///< speed of the wall, m/s
};
void throw_rod(const Rod& rod) {
  Scene scene(engine(), kSurfaceNeeds, {0, 0, 0}, 1);
  const PlumbShape shape = rod.sheet ? scene.make(upright_sheet(24).desc()) : scene.box({0.125, 6, 6});
  const double face = rod.sheet ? 0 : 0.125;
  const PlumbBody wall = scene.add_kinematic(shape, {rod.distance + face, 0, 0});
  scene.write(PLUMB_FIELD_VELOCITY, wall, {-rod.door, 0, 0, 0, 0, 0});
  scene.body.flags = PLUMB_BODY_CCD;
  scene.body.angular_velocity = {0, 0, 50};
  scene.body.linear_velocity = {rod.speed, 0, 0};
  scene.add(scene.box({0.025, 1, 0.025}), {0, 0, 0});
  double deepest = -10;
  for (int step = 0; step < 60; ++step) {
    scene.run(1);
    const PlumbPose pose = scene.poses()[1];
    deepest = std::max(deepest, reach_of(pose, 1, 0.025) - (scene.poses()[0].position.x - face));
    if (pose.position.x < -3) break;
  }
  // Of the rod's length 1 %; where wall and rod meet as fast as bullets a step may end with more.
  EXPECT_LT(deepest, rod.speed + rod.door > 50 ? 0.05 : 0.02)
      << "at " << rod.distance << " m, " << rod.speed << " m/s, sheet " << rod.sheet << ", door " << rod.door;
}
TEST(ContinuousSurfaces, ASpinningRodDoesNotPass) {
  for (const bool sheet : {false, true}) {
    for (const double distance : {0.2, 0.5, 0.9, 0.99}) throw_rod({distance, 0, sheet});
    for (const double speed : {5.0, 30.0, 100.0, 400.0}) throw_rod({2, speed, sheet});
    for (const double door : {5.0, 60.0, 300.0}) throw_rod({4, 0, sheet, door});
  }
}

/// What bounces about in a room as fast as it may never leaves it, whatever turn its way takes within a step. A
/// hull may get stuck with its tip through a wall (of 640 others 21 did, by up to 5 cm); it must not be through.
TEST(ContinuousSurfaces, NobodyLeavesTheRoom) {
  for (const bool sheets : {false, true})
    for (const Bullet bullet : kBullets) {
      Random random(7 + static_cast<std::uint64_t>(bullet));
      Scene scene(engine(), kSurfaceNeeds | PLUMB_NEED_RESTITUTION, {0, 0, 0}, 1);
      scene.body.material.friction = 0.3;
      scene.body.material.restitution = 0.7;
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
          PlumbVec3 half = {8, 8, 8}, at = {0, 0, 0};
          (&half.x)[axis] = 0.02;
          (&at.x)[axis] = side * 5;
          TriangleSet wall = flat_grid(12, 1);
          for (std::size_t i = 0; i < wall.vertices.size(); i += 3)
            std::swap(wall.vertices[i + 1], wall.vertices[i + static_cast<std::size_t>(axis)]);
          scene.add_static(sheets ? scene.make(wall.desc()) : scene.box(half), at);
        }
      scene.body.flags = PLUMB_BODY_CCD;
      const PlumbShape shape = make_bullet(scene, bullet);
      for (int i = 0; i < 8; ++i) {
        const double speed = 20 * std::pow(3.0, i % 5);
        scene.body.linear_velocity = {speed * random.between(-1, 1), speed * random.between(-1, 1),
                                      speed * random.between(-1, 1)};
        scene.add(shape, {random.between(-4, 4), random.between(-4, 4), random.between(-4, 4)}, random.turn());
      }
      scene.run(120);
      const std::vector<PlumbPose> poses = scene.poses();
      for (std::size_t i = 6; i < poses.size(); ++i) {
        const PlumbVec3& at = poses[i].position;
        EXPECT_LT(std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}), bullet == Bullet::kHull ? 5.1 : 5.0)
            << "sheets " << sheets << " bullet " << static_cast<int>(bullet) << " number " << i;
      }
    }
}

/// A ball of 500 m/s into ten boxes: they share its momentum, and it stays behind them.
TEST(ContinuousSurfaces, AStackTakesTheMomentumOfABullet) {
  for (const bool row : {false, true}) {
    Scene scene(engine(), kSurfaceNeeds, {0, 0, 0}, 1);
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = 10;
    std::vector<PlumbBody> boxes;
    const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
    for (int i = 0; i < 10; ++i)
      boxes.push_back(scene.add(cube, row ? PlumbVec3{1.0 * i, 0, 0} : PlumbVec3{0, 1.0 * i - 4.4, 0}));
    scene.body.mass = 4;
    scene.body.flags = PLUMB_BODY_CCD;
    scene.body.linear_velocity = {500, 0, 0};
    const PlumbBody ball = scene.add(scene.sphere(0.2), {-11, 0.1, 0.05});
    scene.run(5);
    double momentum[3] = {}, last = -100;
    for (int k = 0; k < 3; ++k) momentum[k] = 4 * scene.velocity(ball)[static_cast<std::size_t>(k)];
    for (const PlumbBody box : boxes) {
      const std::vector<double> v = scene.velocity(box);
      for (int k = 0; k < 3; ++k) momentum[k] += 10 * v[static_cast<std::size_t>(k)];
      last = std::max(last, v[0]);
    }
    EXPECT_NEAR(momentum[0], 2000, 2);
    EXPECT_NEAR(momentum[1], 0, 2);
    EXPECT_NEAR(momentum[2], 0, 2);
    EXPECT_GT(last, 10) << "somebody was hit";
    EXPECT_LE(scene.velocity(ball)[0], last + 1);
  }
}

/// What moves by the host's will passes no flagged body, which may be at rest: a plate and a sheet, straight and
/// swung about the origin.
TEST(ContinuousSurfaces, NoPaddlePasses) {
  for (const bool sheet : {false, true})
    for (const double speed : {20.0, 100.0, 700.0})
      for (const double offset : {0.0, 0.37}) {
        Scene scene(engine(), kSurfaceNeeds, {0, 0, 0}, 1);
        const PlumbBody paddle = scene.add_kinematic(
            sheet ? scene.make(upright_sheet(6).desc()) : scene.box({0.05, 1.5, 1.5}), {4 + offset, 0, 0});
        scene.write(PLUMB_FIELD_VELOCITY, paddle, {-speed, 0, 0, 0, 0, 0});
        scene.body.flags = PLUMB_BODY_CCD;
        const PlumbBody ball = scene.add(scene.sphere(0.1), {0, 0.21, 0.13});
        scene.run(static_cast<int>(5 / speed * 60) + 2);
        EXPECT_LT(scene.poses()[1].position.x, scene.poses()[0].position.x) << speed << " m/s, sheet " << sheet;
        EXPECT_NEAR(scene.velocity(ball)[0], -speed, 0.02 * speed);
      }
  for (const bool sheet : {false, true})
    for (const double turn : {10.0, 40.0, 70.0}) {
      Scene scene(engine(), kSurfaceNeeds, {0, 0, 0}, 1);
      const PlumbBody paddle =
          scene.add_kinematic(sheet ? scene.make(upright_sheet(6).desc()) : scene.box({0.02, 1.5, 1.5}), {0, 0, 0});
      scene.write(PLUMB_FIELD_VELOCITY, paddle, {0, 0, 0, 0, 0, turn});
      scene.body.flags = PLUMB_BODY_CCD;
      const PlumbBody ball = scene.add(scene.sphere(0.05), {-1, 0.1, 0.2});  // the paddle's upper half comes its way
      scene.run(static_cast<int>(1.6 / turn * 60) + 2);
      EXPECT_GT(scene.velocity(ball)[1] * scene.velocity(ball)[1] + scene.velocity(ball)[0] * scene.velocity(ball)[0],
                0.6 * turn * turn)
          << turn << " rad/s, sheet " << sheet;
    }
}

/// Who sleeps is woken by a bullet, flagged or not, and takes its momentum.
TEST(ContinuousSurfaces, ASleeperIsHit) {
  for (const std::uint32_t flag : {0U, static_cast<std::uint32_t>(PLUMB_BODY_CCD)}) {
    Scene scene(engine(), kSurfaceNeeds | PLUMB_NEED_SLEEPING, {0, 0, 0}, 1);
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = 3;
    scene.body.flags = PLUMB_BODY_ASLEEP | flag;
    const PlumbBody sleeper = scene.add(scene.box({0.02, 1, 1}), {5, 0, 0});
    scene.body.mass = 1;
    scene.body.flags = PLUMB_BODY_CCD;
    scene.body.linear_velocity = {800, 0, 0};
    const PlumbBody bullet = scene.add(scene.sphere(0.1), {0, 0, 0});
    scene.run(3);
    EXPECT_NEAR(scene.velocity(sleeper)[0], 200, 1);
    EXPECT_NEAR(scene.velocity(bullet)[0], 200, 1);
    EXPECT_LT(scene.poses()[1].position.x, scene.poses()[0].position.x);
  }
}

/// Bodies without the flag go as where nobody asks, bit for bit, on surfaces and with what moves among them.
TEST(ContinuousSurfaces, CostNothingWithoutFlags) {
  std::uint64_t hashes[2];
  for (const bool asked : {false, true}) {
    Scene scene(engine(), asked ? kSurfaceNeeds : kSurfaceNeeds & ~PLUMB_NEED_CCD, {0, -9.81, 0}, 1);
    scene.add_static(scene.make(grid(20, 0.61, hills).desc()), {0, 0, 0});
    const PlumbBody sweeper = scene.add_kinematic(scene.box({0.3, 0.3, 3}), {-4, 0.4, 0});
    scene.write(PLUMB_FIELD_VELOCITY, sweeper, {6, 0, 0, 0, 2, 0});
    const PlumbShape cube = scene.box({0.3, 0.3, 0.3});
    for (int i = 0; i < 40; ++i)
      scene.add(cube, {0.8 * (i % 4) - 1.6 + 0.01 * i, 1 + 0.8 * (i / 16), 0.8 * (i / 4 % 4) - 1.6});
    scene.run(90);
    hashes[asked ? 1 : 0] = scene.hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

/// The same bits on any number of threads: who is put back first does not matter.
TEST(ContinuousSurfaces, HaveTheSameBitsOnThreads) {
  const auto hash = [](std::uint32_t threads) {
    Scene scene(engine(), kSurfaceNeeds, {0, -9.81, 0}, threads);
    scene.add_static(scene.make(grid(40, 0.61, hills).desc()), {0, 0, 0});
    scene.body.flags = PLUMB_BODY_CCD;
    Random random(3);
    for (int i = 0; i < 60; ++i) {
      scene.body.linear_velocity = {random.between(-200, 200), random.between(-900, 0), random.between(-200, 200)};
      scene.add(make_bullet(scene, kBullets[i % 6]), {0.5 * (i % 8), 2 + 0.5 * (i / 8), 0.7 * (i % 5)}, random.turn());
    }
    scene.run(30);
    return scene.hash();
  };
  EXPECT_EQ(hash(1), hash(3));
}

}  // namespace
}  // namespace plumb::impulse::test
