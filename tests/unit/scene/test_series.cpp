#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/instruments/series.hpp"

namespace plumb::harness {
namespace {

constexpr double dt = 1.0 / 60;

TEST(Series, FindsApexesBetweenSamples) {
  Series height;
  for (int i = 0; i <= 120; ++i) height.add(i * dt, 10 * i * dt - 9.81 / 2 * i * dt * i * dt);
  ASSERT_EQ(height.maxima().size(), 1u);
  EXPECT_NEAR(height.maxima()[0].time, 10 / 9.81, 1e-12);
  EXPECT_NEAR(height.maxima()[0].value, 50 / 9.81, 1e-12);
  EXPECT_TRUE(height.minima().empty());
}

TEST(Series, CountsATopOfTwoEqualSamplesOnce) {
  Series flat;
  int i = 0;
  for (const double value : {0.0, 1.0, 1.0, 0.0}) flat.add(i++, value);
  ASSERT_EQ(flat.maxima().size(), 1u);
  EXPECT_NEAR(flat.maxima()[0].time, 1.5, 1e-12);
}

TEST(Series, FindsCrossingsAndValuesBetweenSamples) {
  Series wave;
  for (int i = 0; i <= 600; ++i) wave.add(i * dt, std::cos(2 * i * dt));
  const auto passes = wave.crossings(0);
  ASSERT_EQ(passes.size(), 6u);
  EXPECT_NEAR(passes[5] - passes[1], 2 * std::numbers::pi, 1e-6);
  EXPECT_NEAR(wave.at(1.2345), std::cos(2.469), 1e-5);
  EXPECT_TRUE(std::isnan(Series().at(1)));
}

TEST(Series, ExtrapolatesAnEvenFall) {
  Series speed;
  for (int i = 0; i <= 60; ++i) speed.add(i * dt, std::max(0.0, 3 - 10.3 * i * dt));
  EXPECT_NEAR(speed.end_of_fall().value(), 3 / 10.3, 1e-12);
  Series steady;
  for (int i = 0; i <= 60; ++i) steady.add(i * dt, 3);
  EXPECT_FALSE(steady.end_of_fall().has_value());
}

TEST(Series, MaximaForgetNoExplosion) {
  EXPECT_EQ(largest(1, 2), 2);
  EXPECT_EQ(largest(2, 1), 2);
  EXPECT_TRUE(std::isnan(largest(1, not_measured)));
  EXPECT_TRUE(std::isnan(largest(not_measured, 1)));
}

TEST(Unwrapped, FollowsAnglesAcrossTheSeam) {
  Unwrapped unwrap;
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.3 * i;
    EXPECT_NEAR(unwrap(std::atan2(std::sin(angle), std::cos(angle))), angle, 1e-12);
  }
}

}  // namespace
}  // namespace plumb::harness
