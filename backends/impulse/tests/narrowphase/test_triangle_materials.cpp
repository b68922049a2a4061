// Materials by triangle: what slides, bounces and is shown on meshes and height fields, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                              PLUMB_NEED_RESTITUTION | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES;

enum class Kind { kMesh, kField };
constexpr Kind kKinds[] = {Kind::kMesh, Kind::kField};

PlumbMaterial material(double friction, double restitution = 0) { return {friction, restitution, {}}; }

/// A level square of 40 x 40 cells of .25 m about the origin, with materials by the middle of each cell.
struct Ground {
  static constexpr std::uint32_t kCells = 40;
  static constexpr double kSide = 0.25;

  std::vector<PlumbMaterial> materials;
  std::vector<std::uint32_t> of;

  Ground(std::vector<PlumbMaterial> rows, const std::function<std::uint32_t(double, double)>& row)
      : materials(std::move(rows)) {
    for (std::uint32_t z = 0; z < kCells; ++z)
      for (std::uint32_t x = 0; x < kCells; ++x)
        for (int k = 0; k < 2; ++k)
          of.push_back(row((x + 0.5 - kCells / 2.0) * kSide, (z + 0.5 - kCells / 2.0) * kSide));
  }
  [[nodiscard]] PlumbShape make(Scene& scene, Kind kind) const {
    const TriangleSet set = flat_grid(kCells, kSide);
    const std::vector<double> heights(std::size_t{kCells + 1} * (kCells + 1), 0.0);
    PlumbShapeDesc desc = kind == Kind::kMesh ? set.desc() : field_desc(heights, kCells + 1, kCells + 1, kSide);
    desc.materials = materials.data();
    desc.material_count = static_cast<std::uint32_t>(materials.size());
    desc.triangle_materials = of.data();
    return scene.make(desc);
  }
};

/// Ice where x < 0, beyond it sand, seen by a body of friction 1.
Ground ice_and_sand() {
  return {{material(0.01), material(0.36)}, [](double x, double) { return x < 0 ? 0U : 1U; }};
}

TEST(TriangleMaterials, ABoxSlidesOverIceAndStopsOnSand) {
  for (const Kind kind : kKinds) {
    Scene scene(engine(), kNeeds, kDown, 1);
    scene.body.material = material(1);
    scene.add_static(ice_and_sand().make(scene, kind), {0, 0, 0});
    scene.body.linear_velocity = {4, 0, 0};
    const PlumbBody box = scene.add(scene.box({0.2, 0.1, 0.2}), {-3, 0.1, 0.03});
    const double at_edge = 16 - 2 * 0.1 * 9.81 * 3;  // m2/s2; pair's frictions are .1 and .6
    scene.run(60 * 3);
    EXPECT_NEAR(scene.poses().back().position.x, at_edge / (2 * 0.6 * 9.81), 0.02);
    EXPECT_NEAR(scene.velocity(box)[0], 0, 1e-4);
  }
}

TEST(TriangleMaterials, WhereATriangleHasNoneTheBodysCounts) {
  for (const Kind kind : kKinds) {
    Scene scene(engine(), kNeeds, kDown, 1);
    scene.body.material = material(0.25);
    const Ground ground({material(9)}, [](double, double z) { return z < 0 ? PLUMB_BODY_MATERIAL : 0U; });
    scene.add_static(ground.make(scene, kind), {0, 0, 0});
    scene.body.linear_velocity = {2, 0, 0};
    const PlumbShape shape = scene.box({0.2, 0.1, 0.2});
    const PlumbBody on_body = scene.add(shape, {-3, 0.1, -2.03}), on_row = scene.add(shape, {-3, 0.1, 2.03});
    scene.run(12);
    EXPECT_NEAR(scene.velocity(on_body)[0], 2 - 0.2 * 0.25 * 9.81, 2e-3);
    EXPECT_NEAR(scene.velocity(on_row)[0], 0, 2e-3) << "2 m/s are gone after .14 s of friction 1.5";
  }
}

/// Nobody else bounces: neither the balls nor the body of the ground.
TEST(TriangleMaterials, BallsBounceWhereTrianglesDo) {
  for (const Kind kind : kKinds) {
    Scene scene(engine(), kNeeds, {0, 0, 0}, 1);
    scene.body.material = material(0);
    const Ground ground({material(0, 0.8), material(0, 0.3)}, [](double x, double) {
      return x < -1 ? 0U : x < 1 ? 1U : PLUMB_BODY_MATERIAL;
    });
    scene.add_static(ground.make(scene, kind), {0, 0, 0});
    scene.body.linear_velocity = {0, -5, 0};
    const PlumbShape ball = scene.sphere(0.25);
    const double expected[] = {4, 1.5, 0};
    PlumbBody balls[3];
    for (int i = 0; i < 3; ++i) balls[i] = scene.add(ball, {2.03 * (i - 1), 0.75, 0.04});
    scene.run(30);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(scene.velocity(balls[i])[1], expected[i], 1e-3) << i;
  }
}

/// A broad box slides askew over a chequered ground: every point is rubbed as its own triangle does, and no manifold
/// is made of two materials.
TEST(TriangleMaterials, EachPointIsRubbedByItsTriangle) {
  for (const Kind kind : kKinds) {
    Scene scene(engine(), kNeeds | PLUMB_NEED_CONTACT_IMPULSES, kDown, 1);
    scene.body.material = material(1);
    const Ground ground({material(0.04), material(0.25)}, [](double x, double z) {
      return (static_cast<int>(std::floor(x)) + static_cast<int>(std::floor(z))) % 2 == 0 ? 0U : 1U;
    });
    const PlumbBody below = scene.add_static(ground.make(scene, kind), {0, 0, 0});
    scene.body.linear_velocity = {6, 0, 1};
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = 60;
    scene.add(scene.box({0.9, 0.1, 0.9}), {-3, 0.1, -0.5});
    int points[2] = {0, 0};
    for (int step = 0; step < 40; ++step) {
      scene.run(1);
      double weight = 0;
      for (const PlumbContact& contact : scene.world().contacts()) {
        const std::uint32_t row = ground.of[contact.body_a == below ? contact.child_a : contact.child_b];
        const PlumbVec3& t = contact.tangent_impulse;
        const double rub = std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z);
        EXPECT_LE(rub, (row == 0 ? 0.2 : 0.5) * contact.normal_impulse * 1.02 + 1e-4);
        if (contact.normal_impulse > 1e-2) ++points[row];
        weight += contact.normal_impulse;
      }
      if (step > 10) {
        EXPECT_NEAR(weight, 9.81, 0.98) << step;
      }
    }
    EXPECT_GT(points[0], 40);
    EXPECT_GT(points[1], 40);
  }
}

TEST(TriangleMaterials, AreShownToTheHost) {
  for (const Kind kind : kKinds) {
    Scene scene(engine(), kNeeds | PLUMB_NEED_CONTACT_MODIFICATION, kDown, 1);
    scene.body.material = material(1, 0.1);
    const Ground ground({material(0.49, 0.7)}, [](double, double) { return 0U; });
    scene.add_static(ground.make(scene, kind), {0, 0, 0});
    scene.body.flags = PLUMB_BODY_MODIFY_CONTACTS;
    scene.add(scene.box({0.2, 0.1, 0.2}), {0.03, 0.1, 0.04});
    int shown = 0;
    scene.modify_contacts = [&](std::span<const PlumbManifold> rows, std::vector<PlumbManifoldChange>& /*changes*/) {
      for (const PlumbManifold& manifold : rows) {
        EXPECT_NEAR(manifold.friction, 0.7, 1e-6);
        EXPECT_NEAR(manifold.restitution, 0.7, 1e-6);
        ++shown;
      }
    };
    scene.run(2);
    EXPECT_GE(shown, 2);
  }
}

/// A shape with materials that no body has, beside bodies that touch no surface at all.
TEST(TriangleMaterials, OfShapesThatNobodyHasAreNotAsked) {
  Scene scene(engine(), kNeeds, kDown, 1);
  (void)ice_and_sand().make(scene, Kind::kMesh);
  scene.ground();
  const PlumbBody box = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  scene.run(30);
  EXPECT_NEAR(scene.velocity(box)[1], 0, 1e-3);
}

}  // namespace
}  // namespace plumb::impulse::test
