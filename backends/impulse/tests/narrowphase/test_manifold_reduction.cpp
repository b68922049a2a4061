// Contacts with triangles that face the same way are one: what is left of them, and that a body cannot tell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>

#include "math/quat.hpp"
#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kReductionNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_CONTACTS;
constexpr PlumbVec3 kHalf = {0.5, 0.25, 0.4};
constexpr double kMass = 400, kGravity = 9.81, kStep = 1.0 / 60;  // of water

constexpr Flat kFlats[] = {Flat::kMesh, Flat::kBackOfMesh, Flat::kField};

/// A quaternion about y.
PlumbQuat heading(double angle) { return {0, std::sin(angle / 2), 0, std::cos(angle / 2)}; }

/// The distance of a point of contact from the nearest lower corner of a box of kHalf.
double from_corner(const PlumbVec3& point, const PlumbPose& box) {
  const Quat4<double> turn = {box.orientation.x, box.orientation.y, box.orientation.z, box.orientation.w};
  const Vec3<double> local =
      rotate_back(turn, {point.x - box.position.x, point.y - box.position.y, point.z - box.position.z});
  return std::hypot(std::abs(local.x) - kHalf.x, local.y + kHalf.y, std::abs(local.z) - kHalf.z);
}

double between_normals(const PlumbContact& a, const PlumbContact& b) {
  return std::hypot(a.normal.x - b.normal.x, a.normal.y - b.normal.y, a.normal.z - b.normal.z);
}
/// How many manifolds there are of a body with another, by their normals.
std::size_t count_sides(std::span<const PlumbContact> contacts) {
  std::size_t sides = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    sides += std::none_of(contacts.begin(), contacts.begin() + static_cast<std::ptrdiff_t>(i),
                          [&](const PlumbContact& other) { return between_normals(contacts[i], other) == 0; });
  return sides;
}

TEST(ManifoldReduction, ABoxTouchesAFlatSurfaceAtItsCorners) {
  for (const Flat flat : kFlats)
    for (const double side : {5.0, 0.31, 0.04})
      for (const double angle : {0.0, 0.4, std::numbers::pi / 4}) {
        SCOPED_TRACE(::testing::Message() << "flat " << static_cast<int>(flat) << " side " << side << " at " << angle);
        Scene scene(engine(), kReductionNeeds, kDown, 1);
        scene.add_static(make_flat(scene, flat, static_cast<std::uint32_t>(4 / side) + 2, side), {0, 0, 0});
        scene.add(scene.box(kHalf), {0.113, kHalf.y, 0.071}, heading(angle));
        scene.run(30);
        const auto contacts = scene.world().contacts();
        ASSERT_EQ(contacts.size(), 4U);
        for (const PlumbContact& contact : contacts)
          EXPECT_LT(from_corner(contact.position, scene.poses().back()), 2e-3);
      }
}

/// Of more corners than four, four far apart are left, and nothing between them.
TEST(ManifoldReduction, APrismTouchesAFlatSurfaceAtCorners) {
  constexpr double kRadius = 0.5;
  for (const int sides : {6, 12})
    for (const double side : {5.0, 0.31, 0.04}) {
      SCOPED_TRACE(::testing::Message() << sides << " sides on cells of " << side);
      Scene scene(engine(), kReductionNeeds, kDown, 1);
      scene.add_static(make_flat(scene, Flat::kMesh, static_cast<std::uint32_t>(4 / side) + 2, side), {0, 0, 0});
      std::vector<PlumbVec3> corners;
      for (int i = 0; i < sides; ++i)
        for (const double y : {-kHalf.y, kHalf.y}) {
          const double angle = 2 * std::numbers::pi * i / sides;
          corners.push_back({kRadius * std::cos(angle), y, kRadius * std::sin(angle)});
        }
      scene.add(scene.hull(corners), {0.113, kHalf.y, 0.071}, heading(0.2));
      scene.run(30);
      const PlumbPose at = scene.poses().back();
      const auto contacts = scene.world().contacts();
      ASSERT_EQ(contacts.size(), 4U);
      for (std::size_t i = 0; i < 4; ++i) {
        const PlumbVec3 &p = contacts[i].position, &q = contacts[(i + 1) % 4].position;
        EXPECT_NEAR(std::hypot(p.x - at.position.x, p.z - at.position.z), kRadius, 5e-3);
        EXPECT_GT(std::hypot(p.x - q.x, p.z - q.z), 0.3 * kRadius);
      }
    }
}

/// Each point says on which triangle it lies: cell (column, row) of the grid has the triangles 2 (cells row + column),
/// before its diagonal, and one more, behind it.
TEST(ManifoldReduction, PointsNameTheirTriangles) {
  constexpr std::uint32_t kCells = 16;
  constexpr double kSide = 0.25;
  Scene scene(engine(), kReductionNeeds, kDown, 1);
  scene.add_static(scene.make(flat_grid(kCells, kSide).desc()), {0, 0, 0});
  scene.add(scene.box(kHalf), {0.113, kHalf.y, 0.071}, heading(0.4));
  scene.run(30);
  ASSERT_EQ(scene.world().contacts().size(), 4U);
  for (const PlumbContact& contact : scene.world().contacts()) {
    const double column = contact.position.x / kSide + kCells / 2.0, row = contact.position.z / kSide + kCells / 2.0;
    const auto cell = static_cast<std::uint32_t>(row) * kCells + static_cast<std::uint32_t>(column);
    const bool behind = (column - std::floor(column)) + (row - std::floor(row)) > 1;
    EXPECT_EQ(contact.child_a + contact.child_b, 2 * cell + (behind ? 1 : 0));
  }
}

/// Beyond the rim of the surface nothing is touched, so that there the points are on the rim.
TEST(ManifoldReduction, ABoxAcrossARimTouchesItThere) {
  Scene scene(engine(), kReductionNeeds, kDown, 1);
  scene.add_static(scene.make(flat_grid(10, 0.2).desc()), {0, 0, 0});
  scene.add(scene.box(kHalf), {0.8, kHalf.y, 0.03});
  scene.run(30);
  const auto contacts = scene.world().contacts();
  ASSERT_EQ(contacts.size(), 4U);
  double least = 1, most = 0;
  for (const PlumbContact& contact : contacts) {
    least = std::min(least, contact.position.x);
    most = std::max(most, contact.position.x);
  }
  EXPECT_NEAR(least, 0.3, 2e-3);
  EXPECT_NEAR(most, 1, 2e-3);
}

/// A slab that is larger than the surface below it rests on the surface's corners, and on nothing between them.
TEST(ManifoldReduction, ASlabOverAllOfASurfaceTouchesItsCorners) {
  for (const std::uint32_t cells : {1U, 2U, 5U, 24U}) {
    SCOPED_TRACE(cells);
    Scene scene(engine(), kReductionNeeds, kDown, 1);
    TriangleSet diamond = flat_grid(cells, 1.0 / cells);  // corners on the axes, half a diagonal from the middle
    for (std::size_t i = 0; i < diamond.vertices.size(); i += 3) {
      const double x = diamond.vertices[i], z = diamond.vertices[i + 2];
      diamond.vertices[i] = std::numbers::sqrt2 / 2 * (x - z);
      diamond.vertices[i + 2] = std::numbers::sqrt2 / 2 * (x + z);
    }
    scene.add_static(scene.make(diamond.desc()), {0, 0, 0});
    scene.add(scene.box({2, kHalf.y, 2}), {0.013, kHalf.y, -0.021}, heading(0.2));
    scene.run(30);
    const auto contacts = scene.world().contacts();
    ASSERT_EQ(contacts.size(), 4U);
    for (const PlumbContact& contact : contacts) {
      const double x = std::abs(contact.position.x), z = std::abs(contact.position.z);
      EXPECT_NEAR(std::max(x, z), std::numbers::sqrt2 / 2, 2e-3);
      EXPECT_NEAR(std::min(x, z), 0, 2e-3);
    }
  }
}

/// Two slopes that meet in a furrow along z: one contact as long as nobody could tell it from a plane, else two.
TEST(ManifoldReduction, ABentSurfaceIsNoFlatOne) {
  for (const auto& [slope, wanted] : {std::pair{5e-5, 1U}, {2e-2, 2U}, {0.2, 2U}}) {
    SCOPED_TRACE(slope);
    Scene scene(engine(), kReductionNeeds, kDown, 1);
    const TriangleSet furrow = grid(20, 0.25, [slope = slope](double x, double) { return slope * std::abs(x); });
    scene.add_static(scene.make(furrow.desc()), {0, 0, 0});
    const PlumbBody box = scene.add(scene.box(kHalf), {0, kHalf.y + slope * kHalf.x, 0});
    scene.run(60);
    EXPECT_EQ(count_sides(scene.world().contacts()), wanted);
    for (const double speed : scene.velocity(box)) EXPECT_NEAR(speed, 0, 1e-4);
  }
}

/// What slides from triangle to triangle is held up by its weight in every single step: impulses go along.
TEST(ManifoldReduction, ASlidingBoxIsHeldUpByItsWeightInEveryStep) {
  for (const Flat flat : kFlats) {
    SCOPED_TRACE(static_cast<int>(flat));
    Scene scene(engine(), kReductionNeeds | PLUMB_NEED_CONTACT_IMPULSES, kDown, 1);
    scene.add_static(make_flat(scene, flat, 80, 0.3), {0, 0, 0});
    scene.body.material.friction = 0.1;
    scene.body.linear_velocity = {4, 0, 1};
    scene.add(scene.box(kHalf), {-3, kHalf.y, 0}, heading(0.3));
    scene.run(20);
    for (int step = 0; step < 60; ++step) {
      scene.run(1);
      double impulse = 0;
      for (const PlumbContact& contact : scene.world().contacts()) impulse += contact.normal_impulse;
      EXPECT_NEAR(impulse, kMass * kGravity * kStep, 0.01 * kMass * kGravity * kStep) << "step " << step;
    }
  }
}

/// However fine a mesh is cut, a body that turns and slides over it goes the way that it goes on a plane.
TEST(ManifoldReduction, AMeshIsTheSameGroundAsAPlane) {
  const auto thrown = [](PlumbShape (*make_rider)(Scene&), std::uint32_t cells) {
    Scene scene(engine(), kReductionNeeds, kDown, 1);
    scene.add_static(
        cells == 0 ? scene.make(shape_desc(PLUMB_PLANE)) : scene.make(flat_grid(cells, 12.0 / cells).desc()),
        {0, 0, 0});
    scene.body.material.friction = 0.4;
    scene.body.linear_velocity = {3, 0, 0.5};
    scene.body.angular_velocity = {0, 2, 0};
    scene.add(make_rider(scene), {-1, kHalf.y, 0});
    scene.run(120);
    return scene.poses().back();
  };
  using MakeRider = PlumbShape (*)(Scene&);
  const MakeRider riders[] = {
      [](Scene& scene) { return scene.box(kHalf); },
      [](Scene& scene) {  // a wedge
        return scene.hull(
            {{-0.5, -0.25, -0.4}, {0.5, -0.25, -0.4}, {0.5, -0.25, 0.4}, {-0.5, -0.25, 0.4}, {0.1, 0.3, 0}});
      },
      [](Scene& scene) {
        PlumbShapeDesc cylinder = shape_desc(PLUMB_CYLINDER);
        cylinder.radius = 0.4;
        cylinder.half_height = kHalf.y;
        return scene.make(cylinder);
      },
      [](Scene& scene) { return scene.sphere(kHalf.y); }};
  for (const MakeRider rider : riders) {
    const PlumbPose on_plane = thrown(rider, 0);
    for (const std::uint32_t cells : {1U, 2U, 7U, 40U, 80U, 200U}) {
      SCOPED_TRACE(cells);
      const PlumbPose on_mesh = thrown(rider, cells);
      EXPECT_NEAR(on_mesh.position.x, on_plane.position.x, 1e-4);
      EXPECT_NEAR(on_mesh.position.y, on_plane.position.y, 1e-5);
      EXPECT_NEAR(on_mesh.position.z, on_plane.position.z, 1e-4);
      EXPECT_NEAR(on_mesh.orientation.y, on_plane.orientation.y, 2e-4);
    }
  }
}

/// Terraces face the same way, and are not one ground: half a box on the upper one stands there if its middle does, and
/// else tips onto the lower one.
TEST(ManifoldReduction, TerracesBearABoxAtTheirOwnHeights) {
  constexpr double kRise = 0.02;
  for (const double middle : {0.06, -0.06}) {
    SCOPED_TRACE(middle);
    Scene scene(engine(), kReductionNeeds, kDown, 1);
    TriangleSet terraces;  // the upper one from x = 0 on, a wall, the lower one
    const auto strip = [&](double x0, double y0, double x1, double y1) {
      const std::uint32_t a = terraces.add(x0, y0, -3), b = terraces.add(x0, y0, 3), c = terraces.add(x1, y1, -3),
                          d = terraces.add(x1, y1, 3);
      terraces.triangle(a, b, c);
      terraces.triangle(c, b, d);
    };
    strip(-3, 0, 0, 0);
    strip(0, 0, 1e-3, kRise);
    strip(1e-3, kRise, 3, kRise);
    scene.add_static(scene.make(terraces.desc()), {0, 0, 0});
    scene.body.material.friction = 0.8;
    const PlumbBody box = scene.add(scene.box(kHalf), {middle, kRise + kHalf.y, 0});
    scene.run(240);
    const PlumbPose end = scene.poses().back();
    if (middle > 0) {
      EXPECT_NEAR(end.position.y, kRise + kHalf.y, 1e-3);
      EXPECT_NEAR(end.orientation.z, 0, 1e-3);
    } else {  // its lower edge on the lower terrace, so far from the other's rim
      EXPECT_LT(end.position.y, kRise + kHalf.y - 1e-3);
      EXPECT_GT(std::abs(end.orientation.z), 5e-3);
    }
    for (const double speed : scene.velocity(box)) EXPECT_NEAR(speed, 0, 1e-3);
  }
}

/// What has slid and sleeps on a surface wakes with the impulses that it fell asleep with: as it does on a plane.
TEST(ManifoldReduction, WhatWakesIsStillHeldUp) {
  const auto heights = [](bool on_mesh) {
    Scene scene(engine(), kReductionNeeds | PLUMB_NEED_SLEEPING, kDown, 1);
    scene.add_static(on_mesh ? make_flat(scene, Flat::kMesh, 40, 0.11) : scene.make(shape_desc(PLUMB_PLANE)),
                     {0, 0, 0});
    scene.body.material.friction = 0.5;
    scene.body.linear_velocity = {2, 0, 0.5};
    std::vector<PlumbBody> boxes;
    for (int i = 0; i < 4; ++i) boxes.push_back(scene.add(scene.box(kHalf), {0.013, kHalf.y * (2 * i + 1), 0.027}));
    scene.run(240);
    const double asleep = scene.poses().back().position.y;
    scene.write(PLUMB_FIELD_VELOCITY, boxes[0], {0, 0, 0, 0, 1e-3, 0});
    std::vector<double> above;
    for (int step = 0; step < 30; ++step) {
      scene.run(1);
      above.push_back(scene.poses().back().position.y - asleep);
    }
    return above;
  };
  const std::vector<double> on_mesh = heights(true), on_plane = heights(false);
  for (std::size_t step = 0; step < on_mesh.size(); ++step)
    EXPECT_NEAR(on_mesh[step], on_plane[step], 3e-6) << "step " << step;
}

/// A host that treats contacts each in its own way is shown those with every triangle.
TEST(ManifoldReduction, WhatIsShownStaysAsItIs) {
  Scene scene(engine(), kReductionNeeds | PLUMB_NEED_CONTACT_MODIFICATION, kDown, 1);
  scene.add_static(make_flat(scene, Flat::kMesh, 40, 0.11), {0, 0, 0});
  scene.body.flags = static_cast<std::uint32_t>(PLUMB_BODY_MODIFY_CONTACTS);
  scene.add(scene.box(kHalf), {0.013, kHalf.y, 0.027});
  std::set<std::uint32_t> triangles;
  scene.modify_contacts = [&](std::span<const PlumbManifold> rows, std::vector<PlumbManifoldChange>& /*changes*/) {
    triangles.clear();
    for (const PlumbManifold& row : rows) triangles.insert(row.child_a + row.child_b);
    EXPECT_EQ(triangles.size(), rows.size());
  };
  scene.run(30);
  EXPECT_GT(triangles.size(), 50U);
  EXPECT_NEAR(scene.poses().back().position.y, kHalf.y, 1e-3);
}

/// On hilly ground a body has as many contacts as it touches sides: no two with the same normal.
TEST(ManifoldReduction, HillsKeepTheirNormals) {
  Scene scene(engine(), kReductionNeeds, kDown, 1);
  const TriangleSet hills = grid(
      30, 0.2, [](double x, double z) { return 0.05 * std::sin(9 * x) * std::cos(7 * z) + 0.02 * std::sin(31 * x); });
  scene.add_static(scene.make(hills.desc()), {0, 0, 0});
  for (int i = 0; i < 9; ++i) scene.add(scene.box(kHalf), {1.5 * (i % 3) - 1.5, 0.6, 1.5 * (i / 3) - 1.5}, heading(i));
  std::size_t most = 0;
  for (int step = 0; step < 120; ++step) {
    scene.run(1);
    const auto contacts = scene.world().contacts();
    most = std::max(most, count_sides(contacts));
    for (const PlumbContact& one : contacts)
      for (const PlumbContact& other : contacts) {
        if (one.body_a != other.body_a || one.body_b != other.body_b || between_normals(one, other) == 0) continue;
        EXPECT_GT(between_normals(one, other), 9e-4) << "step " << step;
      }
  }
  EXPECT_GT(most, 20U);
}

/// Heights of waves that are long beside the cells of a grid and short beside a box.
double wave(double x, double z) { return 0.01 * std::sin(3 * x) * std::cos(3 * z); }

/// How far the highest of a surface's vertices reaches into a box of kHalf that lies on it, m; negative: below it.
double deepest_vertex(const TriangleSet& surface, const PlumbPose& box) {
  const Quat4<double> turn = {box.orientation.x, box.orientation.y, box.orientation.z, box.orientation.w};
  double deepest = -1;
  for (std::size_t i = 0; i < surface.vertices.size(); i += 3) {
    const Vec3<double> local =
        rotate_back(turn, {surface.vertices[i] - box.position.x, surface.vertices[i + 1] - box.position.y,
                           surface.vertices[i + 2] - box.position.z});
    if (std::abs(local.x) < kHalf.x && std::abs(local.z) < kHalf.z) deepest = std::max(deepest, local.y + kHalf.y);
  }
  return deepest;
}

/// However many bumps there are below it, a box has a few contacts, and lies on the highest of them. (It may well rock
/// there: a flat face rolls over a round crest without loss.)
TEST(ManifoldReduction, ABoxLiesOnTheHighestOfManyBumps) {
  for (const double side : {0.1, 0.05}) {
    SCOPED_TRACE(side);
    Scene scene(engine(), kReductionNeeds, kDown, 1);
    const TriangleSet waves = grid(static_cast<std::uint32_t>(8 / side), side, wave);
    scene.add_static(scene.make(waves.desc()), {0, 0, 0});
    std::vector<PlumbBody> boxes;
    for (int i = 0; i < 9; ++i)
      boxes.push_back(scene.add(scene.box(kHalf), {1.7 * (i % 3) - 1.7, 0.29, 1.7 * (i / 3) - 1.7}, heading(i)));
    scene.run(240);
    const auto contacts = scene.world().contacts();
    const std::vector<PlumbPose> poses = scene.poses();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      SCOPED_TRACE(i);
      EXPECT_NEAR(deepest_vertex(waves, poses[poses.size() - boxes.size() + i]), 0, 2e-3);
      const auto count = std::count_if(contacts.begin(), contacts.end(), [&](const PlumbContact& contact) {
        return contact.body_a == boxes[i] || contact.body_b == boxes[i];
      });
      EXPECT_GE(count, 3);
      EXPECT_LE(count, 16);
    }
  }
}

/// In a round trough without friction a box swings as a pendulum does: m g r sin(angle) turns m r^2 + I.
TEST(ManifoldReduction, ABoxSwingsInARoundTrough) {
  constexpr double kRound = 20, kStart = 0.05;
  const double arm = std::sqrt(kRound * kRound - kHalf.x * kHalf.x) - kHalf.y;
  const double inertia = (kHalf.x * kHalf.x + kHalf.y * kHalf.y) / 3;  // about its centre, a kilogram
  const double half_period =
      std::numbers::pi * std::sqrt((arm * arm + inertia) / (kGravity * arm)) * (1 + kStart * kStart / 16);
  for (const double side : {0.1, 0.025}) {
    SCOPED_TRACE(side);
    Scene scene(engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION, kDown, 1);
    scene.body.material = {};
    const TriangleSet trough = grid(static_cast<std::uint32_t>(5 / side), side,
                                    [](double x, double) { return kRound - std::sqrt(kRound * kRound - x * x); });
    scene.add_static(scene.make(trough.desc()), {0, 0, 0});
    const PlumbBody box = scene.add(scene.box(kHalf), {arm * std::sin(kStart), kRound - arm * std::cos(kStart), 0},
                                    {0, 0, std::sin(kStart / 2), std::cos(kStart / 2)});
    scene.run(static_cast<int>(std::lround(half_period / kStep)));
    const PlumbPose end = scene.poses().back();
    EXPECT_NEAR(end.position.x, -arm * std::sin(kStart), 0.03 * arm * kStart);
    EXPECT_NEAR(end.position.z, 0, 1e-3);
    EXPECT_NEAR(scene.velocity(box)[0], 0, 0.05 * arm * kStart * std::sqrt(kGravity / arm));
  }
}

}  // namespace
}  // namespace plumb::impulse::test
