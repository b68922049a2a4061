#include "plumb/helpers/combined_materials.hpp"

#include <cmath>

#include "backend_under_test.hpp"

namespace plumb::helpers::test {
namespace {

constexpr PlumbNeeds kRuleNeeds = TestWorld::usual | CombinedMaterials::needs | PLUMB_NEED_RESTITUTION;

TEST(CombinedMaterials, RulesAreWhatTheySay) {
  EXPECT_DOUBLE_EQ(geometric_mean(0.2, 0.8), 0.4);
  EXPECT_DOUBLE_EQ(average(0.2, 0.8), 0.5);
  EXPECT_DOUBLE_EQ(smaller(0.2, 0.8), 0.2);
  EXPECT_DOUBLE_EQ(larger(0.2, 0.8), 0.8);
  EXPECT_DOUBLE_EQ(product(0.2, 0.8), 0.16);
}

/// On a slope of 1 in 2 a box of friction .2 on ground of 1: the larger holds it, the geometric mean (.45) does not,
/// and the acceleration down the slope tells which coefficient counts.
TEST(CombinedMaterials, DecideWhetherASlopeHolds) {
  if (!offers(kRuleNeeds)) GTEST_SKIP() << "the backend modifies no contacts, or does not bounce";
  struct Rule {
    CombineRule combine;
    double friction;
  };
  for (const Rule rule : {Rule{&larger, 1}, {&geometric_mean, std::sqrt(0.2)}, {&smaller, 0.2}, {&average, 0.6}}) {
    TestWorld s({0, -9.81, 0}, kRuleNeeds);
    const double slope = std::atan(0.5);
    PlumbBodyDesc ground = body_desc(PLUMB_STATIC);
    PlumbShapeDesc slab = shape_desc(PLUMB_BOX), cube = shape_desc(PLUMB_BOX);
    slab.half_extents = {20, 0.5, 5};
    cube.half_extents = {0.5, 0.25, 0.5};
    ground.shape = s.shape(slab);
    ground.material.friction = 1;
    ground.pose.orientation = {0, 0, std::sin(slope / 2), std::cos(slope / 2)};
    ground.flags = PLUMB_BODY_MODIFY_CONTACTS;
    const PlumbBody below = s.add(ground);
    PlumbBodyDesc load = body_desc(PLUMB_DYNAMIC);
    load.shape = s.shape(cube);
    load.mass = 3;
    load.mass_mode = PLUMB_MASS_FROM_TOTAL;
    load.material.friction = 0.2;
    load.pose.orientation = ground.pose.orientation;
    load.pose.position = {-0.75 * std::sin(slope), 0.75 * std::cos(slope), 0};
    const PlumbBody body = s.add(load);
    CombinedMaterials materials(rule.combine);
    materials.set(below, 1, 0);
    materials.set(body, 0.2, 0);
    for (int i = 0; i < 60; ++i) step_with(*s.world, 1.0 / 60, std::ref(materials));
    const double down = std::hypot(s.pose(body).position.x - load.pose.position.x,
                                   s.pose(body).position.y - load.pose.position.y),
                 acceleration = std::max(0.0, 9.81 * (std::sin(slope) - rule.friction * std::cos(slope)));
    EXPECT_NEAR(down, acceleration / 2, 0.03 + 0.03 * acceleration) << "friction " << rule.friction;
  }
}

TEST(CombinedMaterials, WhoIsNotKnownIsAsBefore) {
  CombinedMaterials materials(&smaller);
  materials.set(7, 0.5, 0);
  PlumbManifold row{};
  row.body_a = 7;
  row.body_b = 8;
  std::vector<PlumbManifoldChange> changes;
  materials({&row, 1}, changes);
  EXPECT_TRUE(changes.empty());
  materials.set(8, 0.25, 1);
  materials({&row, 1}, changes);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].friction, 0.25);
  EXPECT_EQ(changes[0].restitution, 1);
  materials.remove(7);
  changes.clear();
  materials({&row, 1}, changes);
  EXPECT_TRUE(changes.empty());
}

}  // namespace
}  // namespace plumb::helpers::test
