// Closed forms of stacks, chains and linkages against digits worked out elsewhere in high precision.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../truth_units.hpp"
#include "truth/structures.hpp"

namespace plumb::truth {
namespace {

TEST(HarmonicStack, OverhangOfItsTip) {
  EXPECT_NEAR(harmonic_overhang(1, 5), 1.14166667, 5e-9);
  EXPECT_NEAR(harmonic_overhang(1, 5, 0.5), 1.14166667 / 2, 5e-9);
}

TEST(FourSpheres, CriticalFrictionAndForces) {
  const FourSpheres spheres = four_spheres();
  EXPECT_NEAR(spheres.critical_friction, 0.31783725, 5e-9);
  EXPECT_NEAR(spheres.critical_friction, std::sqrt(3) - std::sqrt(2), 1e-15);
  EXPECT_NEAR(spheres.ground_friction, 0.07945931, 5e-9);
  EXPECT_NEAR(spheres.normal, 1.0 / 3, 1e-15);
  EXPECT_NEAR(spheres.friction, 0.10594575, 5e-9);
  EXPECT_NEAR(spheres.ground, 4.0 / 3, 1e-15);
}

TEST(ChainModes, TenRodsAlone) {
  const auto modes = chain_modes(g, 10, 1, 1, 0);
  ASSERT_EQ(modes.size(), 10u);
  EXPECT_NEAR(modes[0].frequency, 1.19129593, 5e-9);
  EXPECT_NEAR(2 * std::numbers::pi / modes[0].frequency, 5.27424390, 5e-9);
}

TEST(ChainModes, TenRodsWithAHeavyPoint) {
  const auto modes = chain_modes(g, 10, 1, 1, 100);
  EXPECT_NEAR(modes[0].frequency, 0.99831362, 5e-9);
  EXPECT_NEAR(2 * std::numbers::pi / modes[0].frequency, 6.29379907, 5e-9);
  EXPECT_NEAR(modes[1].frequency, 10.22029679, 5e-8);
}

TEST(ChainModes, OneRodIsAPendulum) {
  const auto modes = chain_modes(g, 1, 3, 2, 0);
  EXPECT_NEAR(modes[0].frequency, std::sqrt(3 * g / (2 * 2)), 1e-12);
  EXPECT_EQ(modes[0].shape, std::vector<double>{1});
}

TEST(Catenary, TwentyPlanksOverEighteenMetres) {
  const Catenary bridge = catenary(g, 20, 1, 1, 18);
  EXPECT_NEAR(bridge.horizontal_force, 109.79215923, 5e-9);
  EXPECT_NEAR(bridge.sag(), 3.81891077, 5e-9);
  EXPECT_NEAR(bridge.end_force, 147.23426309, 5e-9);
  const double depths[] = {0.64713092, 1.25195189, 1.80864221, 2.31086439, 2.75191321,
                           3.12496526, 3.42343784, 3.64144177, 3.77427996, 3.81891077};
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(bridge.depths[i + 1], depths[i], 5e-9) << i;
    EXPECT_NEAR(bridge.depths[19 - i], depths[i], 5e-9) << i;
  }
  EXPECT_NEAR(bridge.depths[20], 0, 1e-12);
}

TEST(SliderCrank, PistonAtTwoAngles) {
  EXPECT_NEAR(slider_crank(0.25, 1, 60 * degree), 1.10128121, 5e-9);
  EXPECT_NEAR(slider_crank(0.25, 1, 90 * degree), 0.96824584, 5e-9);
}

TEST(FallingRod, HitsAStopThirtyDegreesBelow) {
  EXPECT_NEAR(falling_rod_time(g, 1, 30 * degree), 0.26800135, 5e-9);
  EXPECT_NEAR(falling_rod_speed(g, 1, 30 * degree), 3.83601356, 5e-9);
}

TEST(Parallelogram, PeriodFromSixtyDegreesAndSmall) {
  EXPECT_NEAR(parallelogram_period(g, 1, 60 * degree), 1.96529670, 5e-9);
  EXPECT_NEAR(parallelogram_period(g, 1, 1e-6), 1.83127995, 5e-9);
}

}  // namespace
}  // namespace plumb::truth
