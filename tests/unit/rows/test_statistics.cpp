#include "rows/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumb::harness {
namespace {

TEST(Statistics, QuantilesLieBetweenOrderStatistics) {
  EXPECT_FALSE(quantile({}, 0.5));
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(quantile({10, 20, 30, 40, 50}, 0.25), 20);
  EXPECT_DOUBLE_EQ(*quantile({10, 20, 30, 40, 50}, 0.1), 14);
  EXPECT_EQ(quantile({1, 2, 3}, 1), 3);
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(median({infinite, infinite, 1}), infinite) << "and not NaN";
}

TEST(Statistics, TheMediansIntervalIsThatOfTheSignTest) {
  EXPECT_FALSE(median_interval({1, 2, 3, 4, 5})) << "all five on one side: 1/16 is more than 5 %";
  const auto six = median_interval({6, 1, 5, 2, 4, 3});
  ASSERT_TRUE(six);
  EXPECT_EQ(six->low, 1);
  EXPECT_EQ(six->high, 6);
  // Tables of the sign test give the 2nd and 9th of ten at 97.9 %, the 6th and 15th of twenty at 95.9 %.
  std::vector<double> values;
  for (int i = 1; i <= 20; ++i) values.push_back(i);
  const auto twenty = median_interval(values);
  ASSERT_TRUE(twenty);
  EXPECT_EQ(twenty->low, 6);
  EXPECT_EQ(twenty->high, 15);
  values.resize(10);
  const auto ten = median_interval(values);
  ASSERT_TRUE(ten);
  EXPECT_EQ(ten->low, 2);
  EXPECT_EQ(ten->high, 9);
}

TEST(Statistics, StudentsQuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(student_t(1), 12.7062, 1e-3);
  EXPECT_NEAR(student_t(2), 4.30265, 1e-4);
  EXPECT_NEAR(student_t(5), 2.57058, 1e-4);
  EXPECT_NEAR(student_t(30), 2.04227, 1e-4);
  EXPECT_NEAR(student_t(5, 0.99), 4.03214, 1e-4);
}

TEST(Statistics, ALineHasItsSlopeAndTheSlopesInterval) {
  EXPECT_FALSE(fit_line({1}, {2}));
  EXPECT_FALSE(fit_line({1, 1, 1}, {2, 3, 4})) << "no two different x";
  const auto two = fit_line({0, 2}, {1, 5});
  ASSERT_TRUE(two);
  EXPECT_EQ(two->slope, 2);
  EXPECT_EQ(two->offset, 1);
  EXPECT_FALSE(two->slope_interval);
  // y = 2 x + 1 with residuals 1, -2, 1 over x = 0, 1, 2: standard error of the slope sqrt(6 / 2), t(1) = 12.706.
  const auto three = fit_line({0, 1, 2}, {2, 1, 6});
  ASSERT_TRUE(three && three->slope_interval);
  EXPECT_DOUBLE_EQ(three->slope, 2);
  EXPECT_NEAR(three->slope_interval->high - 2, 12.7062 * std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(2 - three->slope_interval->low, 12.7062 * std::sqrt(3.0), 1e-3);
}

}  // namespace
}  // namespace plumb::harness
