// Closed forms of single joints and driven mechanisms against digits worked out elsewhere in high precision.
#include <gtest/gtest.h>

#include <cmath>

#include "../truth_units.hpp"
#include "truth/mechanisms.hpp"

namespace plumb::truth {
namespace {

TEST(TopplingRod, FromTenDegrees) {
  EXPECT_NEAR(toppling_time(g, 2, 10 * degree), 1.08608519, 5e-9);
  EXPECT_NEAR(toppling_speed(g, 2, 10 * degree), 3.80676320, 5e-9);
}

TEST(DampedOscillation, OneHertz) {
  EXPECT_NEAR(damped_oscillation(1, 0.1, 0.5, 1), 0.26576756, 5e-9);
  EXPECT_NEAR(logarithmic_decrement(0.1), 0.63148388, 5e-9);
  EXPECT_EQ(damped_oscillation(1, 0.1, 0.5, 0), 0.5);
}

TEST(FourBar, RockerOfTheUpperBranch) {
  const auto rocker = [](double crank_degrees) {
    return four_bar_rocker(1, 3.5, 3, 4, crank_degrees * degree) / degree;
  };
  EXPECT_NEAR(rocker(60), 102.89032693, 5e-8);
  EXPECT_NEAR(rocker(90), 109.73033589, 5e-8);
  EXPECT_NEAR(rocker(180), 136.46884783, 5e-8);
  for (double angle = 0; angle < 720; angle += 1)  // without a jump, all the way round
    EXPECT_LT(std::abs(rocker(angle + 1) - rocker(angle)), 1) << angle;
}

TEST(UniversalJoint, ThirtyDegrees) {
  EXPECT_NEAR(universal_turn(30 * degree, 30 * degree) / degree, 26.56505118, 5e-9);
  EXPECT_NEAR(universal_turn(30 * degree, 45 * degree) / degree, 40.89339465, 5e-9);
  EXPECT_NEAR(universal_turn(30 * degree, (720 + 45) * degree) / degree, 720 + 40.89339465, 5e-9);
}

}  // namespace
}  // namespace plumb::truth
