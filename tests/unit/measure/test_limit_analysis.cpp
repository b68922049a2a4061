// Limit analysis against closed forms, and against critical values that another program's linear programming gave.
#include <gtest/gtest.h>

#include <cmath>

#include "../truth_units.hpp"
#include "truth/limit_analysis.hpp"

namespace plumb::truth {
namespace {

TEST(LimitAnalysis, ABlockOnASlopeByItsFriction) {
  const auto slope = [](double angle, double friction) {
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), up(-along.y(), along.x());
    PlaneStructure block;
    block.blocks = {{0.5 * up, 1}};
    block.add_face(PlaneContact::ground, 0, -0.5 * along, 0.5 * along, up, friction);
    return block;
  };
  EXPECT_NEAR(critical_value(0, 2, [&](double mu) { return slope(20 * degree, mu); }), std::tan(20 * degree), 1e-8);
  // With friction enough it topples over its lower edge, a unit square at 45 degrees.
  EXPECT_NEAR(critical_value(60 * degree, 0, [&](double angle) { return slope(angle, 2); }), 45 * degree, 1e-8);
  EXPECT_NEAR(unbalance(slope(0.1, 0.5)), 0, 1e-14);
  // What friction cannot hold is the part of the weight beyond the cone: its distance from the force.
  EXPECT_NEAR(unbalance(slope(30 * degree, 0)), std::sin(30 * degree), 1e-12);
}

TEST(LimitAnalysis, HarmonicStackStandsUpToItsShareOfOne) {
  const auto stack = [](double share) { return harmonic_stack(5, 0.3, share, 0.5); };
  EXPECT_NEAR(critical_value(1.2, 0.5, stack), 1, 1e-8);
}

TEST(LimitAnalysis, ThicknessOfSemicircularArches) {
  const auto critical = [](std::size_t stones) {
    return critical_value(0.02, 0.3, [&](double t) {
      return voussoir_arch({stones, 5 * (1 - t / 2), 5 * (1 + t / 2)}, 0.8);
    });
  };
  EXPECT_NEAR(critical(7), .095705, 3e-6);
  EXPECT_NEAR(critical(11), .104591, 3e-6);
  EXPECT_NEAR(critical(15), .106069, 3e-6);
  EXPECT_NEAR(critical(21), .106695, 3e-6);
  // Milankovitch's limit of infinitely many stones is approached from below.
  EXPECT_LT(critical(31), .1075);
  EXPECT_GT(critical(31), .1069);
  EXPECT_NEAR(critical_value(0.05, 0.8, [](double mu) { return voussoir_arch({15, 4.5, 5.5}, mu); }), .30899, 6e-6);
}

/// A sixteenth of the dome of D11, as an arch of stones whose weights go with their width; at the eye the ring of the
/// uppermost stones props it with level forces.
TEST(LimitAnalysis, AGoreOfTheDomeStandsOnItsOwnThickness) {
  const auto gore = [](double thickness) {
    PlaneStructure arch;
    const double inner = 5 * (1 - thickness / 2), outer = 5 * (1 + thickness / 2), step = 12.5 * degree;
    const auto along = [](double angle) { return Eigen::Vector2d(std::cos(angle), std::sin(angle)); };
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector2d low = along(i * step), high = along((i + 1) * step);
      arch.add_face(i - 1, i, inner * low, outer * low, {-low.y(), low.x()}, 0.8);
      const Eigen::Vector2d corners[] = {inner * low, outer * low, outer * high, inner * high};
      PlaneBlock stone = polygon_block(corners);
      stone.weight *= stone.centre.x();
      arch.blocks.push_back(stone);
    }
    const Eigen::Vector2d top = along(6 * step);
    arch.add_face(PlaneContact::ground, 5, inner * top, outer * top, {1, 0}, 0);
    return arch;
  };
  EXPECT_TRUE(can_stand(gore(0.15)));
  EXPECT_FALSE(can_stand(gore(0.01)));
}

TEST(LimitAnalysis, FrictionOfCattosArch) {
  const auto critical = [](std::size_t boxes, bool wide) {
    return critical_value(0.05, 2, [&](double mu) { return catto_arch(boxes, wide, mu); });
  };
  const double expected[] = {.21701, .35809, .52710, .65142, .74721};
  for (std::size_t boxes = 0; boxes < 5; ++boxes) EXPECT_NEAR(critical(boxes, false), expected[boxes], 6e-6);
  // What rests on the neighbours too pushes them apart less: it takes less friction.
  EXPECT_NEAR(critical(0, true), .21701, 6e-6);
  for (std::size_t boxes = 1; boxes < 5; ++boxes) EXPECT_LT(critical(boxes, true), expected[boxes]);
  EXPECT_NEAR(critical(4, true), .48233, 6e-6);
}

TEST(LimitAnalysis, CardsThatLeanOnEachOther) {
  EXPECT_NEAR(card_frame_friction(25 * degree), .23315383, 6e-9);
  for (const double lean : {10.0, 25.0, 40.0}) {
    const auto frame = [&](double mu) { return card_frame(lean * degree, mu); };
    EXPECT_NEAR(critical_value(0.01, 2, frame), card_frame_friction(lean * degree), 1e-8) << lean;
  }
}

TEST(LimitAnalysis, Ladder) {
  EXPECT_NEAR(ladder_slope(2, 0.05, 0.5) / degree, 35.15076632, 6e-9);
  EXPECT_NEAR(ladder_slope(2, 0, 0.5) / degree, 36.86989765, 6e-9);
  for (const double mu : {0.2, 0.5, 0.8}) {
    const auto slope = [&](double angle) { return ladder(2, 0.05, angle, mu); };
    EXPECT_NEAR(critical_value(0, 85 * degree, slope), ladder_slope(2, 0.05, mu), 1e-8) << mu;
  }
}

TEST(PolygonBlock, CentroidAndArea) {
  const Eigen::Vector2d corners[] = {{1, 1}, {4, 1}, {1, 3}};
  const PlaneBlock triangle = polygon_block(corners, 10);
  EXPECT_NEAR(triangle.weight, 30, 1e-14);
  EXPECT_NEAR((triangle.centre - Eigen::Vector2d(2, 5.0 / 3)).norm(), 0, 1e-14);
}

}  // namespace
}  // namespace plumb::truth
