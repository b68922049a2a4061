#include "report/cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

TEST(Cost, EqualsBruteForceOverAllRows) {
  const Study study(parse_rows(testing::sample_rows(7)));
  const std::vector<CostLine> lines = cost_of_accuracy(study);
  ASSERT_GT(lines.size(), 100u);
  std::size_t never = 0, reached = 0;
  for (const CostLine& line : lines) {
    double floor = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < target_errors.size(); ++t) {
      double best = std::numeric_limits<double>::infinity();
      for (const ResultRow& row : study.rows) {
        const MetricResult* metric = row.metric(line.metric);
        if (row.scene != line.problem->scene || row.variant() != line.problem->variant || row.backend != line.backend) {
          continue;
        }
        if ((row.status != "ok" && row.status != "failed") || !metric || !metric->error || !row.median_ms) continue;
        const bool fell = std::any_of(row.metrics.begin(), row.metrics.end(), [&](const MetricResult& other) {
          return (other.name == "stands" || other.name == "survival") && other.error != 0;
        });
        const bool graded = line.metric != "stands" && line.metric != "survival";
        if (fell && graded) continue;
        floor = std::min(floor, *metric->error);
        if (*metric->error <= target_errors[t]) best = std::min(best, *row.median_ms / *row.dt);
      }
      if (line.at[t]) {
        ++reached;
        EXPECT_EQ(line.at[t]->ms, best);
        EXPECT_LE(line.at[t]->error, target_errors[t]);
        EXPECT_EQ(line.at[t]->row->metric(line.metric)->error, line.at[t]->error);
      } else {
        ++never;
        EXPECT_EQ(best, std::numeric_limits<double>::infinity());
      }
    }
    EXPECT_EQ(line.floor ? line.floor->error : std::numeric_limits<double>::infinity(), floor);
  }
  EXPECT_GT(never, 10u);
  EXPECT_GT(reached, 10u);
}

TEST(Cost, OfEqualErrorsTheFloorIsTheCheapest) {
  std::vector<Json> rows{testing::sample_row("S", "b", 0.003, 5), testing::sample_row("S", "b", 0.003, 2),
                         testing::sample_row("S", "b", 0.003, 9)};
  const Study study(parse_rows(rows));
  const std::vector<CostLine> lines = cost_of_accuracy(study);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].floor->row->index, 1u);
  EXPECT_EQ(lines[0].at[1]->row->index, 1u);
  EXPECT_FALSE(lines[0].at[2]);
}

TEST(Cost, ARunThatDidNotEndReachesNothing) {
  std::vector<Json> rows{testing::sample_row("S", "b", 1e-6, 1)};
  rows[0]["status"] = "crashed";
  const Study study(parse_rows(rows));
  const std::vector<CostLine> lines = cost_of_accuracy(study);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_FALSE(lines[0].floor);
  EXPECT_FALSE(lines[0].at[0]);
  EXPECT_EQ(lines[0].representative, &study.rows[0]);
}

TEST(Cost, VariantsAreNotMixed) {
  std::vector<Json> rows{testing::sample_row("S", "b", 0.5, 9), testing::sample_row("S", "b", 0.001, 1)};
  rows[0]["params"]["H"] = 100;
  rows[1]["params"]["H"] = 10;
  const Study study(parse_rows(rows));
  const std::vector<CostLine> lines = cost_of_accuracy(study);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].problem->variant, "H=10");
  EXPECT_TRUE(lines[0].at[1]);
  EXPECT_FALSE(lines[1].at[0]) << "a low tower's cost is not that of a high one";
}

}  // namespace
}  // namespace plumb::harness
