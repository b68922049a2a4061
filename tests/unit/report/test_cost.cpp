#include "report/ordered/cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

TEST(Cost, EqualsBruteForceOverAllRows) {
  const OrderedRows ordered(parse_rows(testing::sample_rows(7)));
  const std::vector<CostLine> lines = cost_of_accuracy(ordered);
  ASSERT_GT(lines.size(), 100u);
  constexpr double none = std::numeric_limits<double>::infinity();
  std::size_t never = 0, reached = 0, only_failing = 0;
  for (const CostLine& line : lines) {
    std::array<double, 2> floor{none, none};  // of runs that pass, of runs that fail
    std::array<std::array<double, target_errors.size()>, 2> best{};
    for (auto& of_target : best) of_target.fill(none);
    for (const Row& row : ordered.rows) {
      const MetricResult* metric = row.metric(line.metric);
      if (row.scene != line.problem->scene || row.variant() != line.problem->variant || row.backend != line.backend)
        continue;
      if ((row.status != "ok" && row.status != "failed") || !metric || !metric->error || !row.time.median_ms) continue;
      const bool fell = std::any_of(row.metrics.begin(), row.metrics.end(), [&](const MetricResult& other) {
        return (other.name == "stands" || other.name == "survival") && other.error != 0;
      });
      const bool graded = line.metric != "stands" && line.metric != "survival";
      if (fell && graded) continue;
      const std::size_t fails = row.status == "failed";
      floor[fails] = std::min(floor[fails], *metric->error);
      for (std::size_t t = 0; t < target_errors.size(); ++t) {
        if (*metric->error <= target_errors[t])
          best[fails][t] = std::min(best[fails][t], *row.time.median_ms / *row.dt);
      }
    }
    for (std::size_t t = 0; t < target_errors.size(); ++t) {
      EXPECT_EQ(line.at[t] ? line.at[t]->ms.value() : none, best[0][t]);
      const bool failing = best[0][t] == none && best[1][t] < none;
      EXPECT_EQ(line.failing[t] ? line.failing[t]->ms.value() : none, failing ? best[1][t] : none);
      ++(line.at[t] ? reached : failing ? only_failing : never);
      if (!line.at[t]) continue;
      EXPECT_LE(line.at[t]->error, target_errors[t]);
      EXPECT_EQ(line.at[t]->row->metric(line.metric)->error, line.at[t]->error);
      EXPECT_TRUE(line.at[t]->row->passes());
    }
    EXPECT_EQ(line.floor ? line.floor->error : none, floor[0] < none ? floor[0] : floor[1]);
  }
  EXPECT_GT(never, 10u);
  EXPECT_GT(reached, 10u);
  EXPECT_GT(only_failing, 10u);
}

TEST(Cost, WhatABusyMachineTimedIsReachedAtAnUnknownPrice) {
  std::vector<Json> rows{testing::sample_row("S", "a", 0.005, 5), testing::sample_row("S", "a", 0.005, 2),
                         testing::sample_row("S", "b", 0.005, 3)};
  rows[1]["contended"] = {{"load", 9}, {"why", "load 9 on 2 cores"}};
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<CostLine> lines = cost_of_accuracy(ordered);
  ASSERT_EQ(lines.size(), 2u);
  ASSERT_TRUE(lines[0].at[1]);
  EXPECT_EQ(lines[0].at[1]->ms.value(), 500) << "an upper bound";
  EXPECT_EQ(lines[0].at[1]->untimed, 1u);
  const std::vector<CostTest> tests = tests_of(lines);
  ASSERT_EQ(tests.size(), 1u);
  EXPECT_TRUE(tests[0].reached(1));
  EXPECT_FALSE(tests[0].cheapest(1)) << "a's other run may be cheaper than b's";
  const ReachCount count = count_reached(tests, "b", 1);
  EXPECT_EQ(count.reached, 1u);
  EXPECT_EQ(count.compared, 0u);
}

TEST(Cost, OfEqualErrorsTheFloorIsTheCheapest) {
  std::vector<Json> rows{testing::sample_row("S", "b", 0.003, 5), testing::sample_row("S", "b", 0.003, 2),
                         testing::sample_row("S", "b", 0.003, 9)};
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<CostLine> lines = cost_of_accuracy(ordered);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].floor->row->origin.index, 1u);
  EXPECT_EQ(lines[0].at[1]->row->origin.index, 1u);
  EXPECT_FALSE(lines[0].at[2]);
}

TEST(Cost, ARunThatDidNotEndReachesNothing) {
  std::vector<Json> rows{testing::sample_row("S", "b", 1e-6, 1)};
  rows[0]["status"] = "crashed";
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<CostLine> lines = cost_of_accuracy(ordered);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_FALSE(lines[0].floor);
  EXPECT_FALSE(lines[0].at[0]);
  EXPECT_EQ(lines[0].representative, &ordered.rows[0]);
}

TEST(Cost, VariantsAreNotMixed) {
  std::vector<Json> rows{testing::sample_row("S", "b", 0.5, 9), testing::sample_row("S", "b", 0.001, 1)};
  rows[0]["params"]["H"] = 100;
  rows[1]["params"]["H"] = 10;
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<CostLine> lines = cost_of_accuracy(ordered);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].problem->variant, "H=10");
  EXPECT_TRUE(lines[0].at[1]);
  EXPECT_FALSE(lines[1].at[0]) << "a low tower's cost is not that of a high one";
}

}  // namespace
}  // namespace plumb::harness
