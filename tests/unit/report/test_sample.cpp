#include "report/ordered/sample.hpp"

#include <gtest/gtest.h>

#include "report/ordered/cost.hpp"
#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

std::vector<Json> seeds(const std::vector<double>& errors) {
  std::vector<Json> rows;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    rows.push_back(testing::sample_row("S", "b", errors[i], static_cast<double>(i + 1)));
    rows.back()["params"] = {{"H", 5}, {"seed", i}};
  }
  return rows;
}

TEST(Sample, RowsThatDifferInTheSeedOnlyAreOneDistribution) {
  const OrderedRows ordered(parse_rows(seeds({0.3, 0.1, 0.2})));
  ASSERT_EQ(ordered.problems.size(), 1u);
  EXPECT_EQ(ordered.problems[0].variant, "H=5");
  const std::vector<Sample> samples = samples_of(ordered.problems[0], "b");
  ASSERT_EQ(samples.size(), 1u);
  const auto error = samples[0].error("error_of_it");
  ASSERT_TRUE(error && error->band);
  EXPECT_EQ(error->value, 0.2);
  EXPECT_EQ(error->band->low, 0.1);
  EXPECT_EQ(error->band->high, 0.3);
  EXPECT_EQ(samples[0].cost()->value, 200) << "the median of 1, 2, 3 ms at 0.01 s";
}

TEST(Sample, OtherSettingsAreAnotherOne) {
  std::vector<Json> rows = seeds({0.3, 0.1, 0.2});
  rows[2]["settings"]["iterations"] = 40;
  const OrderedRows ordered(parse_rows(rows));
  EXPECT_EQ(samples_of(ordered.problems[0], "b").size(), 2u);
}

TEST(Sample, ASeedThatDidNotComeThroughIsInfinitelyWrong) {
  std::vector<Json> rows = seeds({0.1, 0.2, 0.3});
  rows[0]["status"] = "crashed";
  const OrderedRows ordered(parse_rows(rows));
  EXPECT_EQ(samples_of(ordered.problems[0], "b")[0].error("error_of_it")->value, 0.3);
  rows[1]["status"] = "crashed";
  const OrderedRows most(parse_rows(rows));
  EXPECT_FALSE(samples_of(most.problems[0], "b")[0].error("error_of_it")) << "the median is infinite";
}

TEST(Sample, ContendedTimesDoNotCountAndErrorsDo) {
  std::vector<Json> rows{testing::sample_row("S", "b", 0.005, 1), testing::sample_row("S", "b", 0.005, 4)};
  rows[0]["contended"] = {{"load", 7.5}, {"why", "load 7.5 on 2 cores"}};
  rows[1]["time"]["ci95"] = {3.9, 4.2};
  const OrderedRows ordered(parse_rows(rows));
  EXPECT_EQ(ordered.rows[0].time.why_contended(), "load 7.5 on 2 cores");
  const std::vector<CostLine> costs = cost_of_accuracy(ordered);
  ASSERT_TRUE(costs.at(0).at[1]);
  EXPECT_EQ(costs[0].at[1]->row->origin.index, 1u);
  ASSERT_TRUE(costs[0].at[1]->band);
  EXPECT_DOUBLE_EQ(costs[0].at[1]->band->low, 390);
  const OrderedRows alone(parse_rows({rows[0]}));
  const std::vector<CostLine> none = cost_of_accuracy(alone);
  ASSERT_TRUE(none.at(0).at[0]) << "its error counts";
  EXPECT_FALSE(none.at(0).at[0]->ms) << "its time does not";
}

TEST(Sample, OfSeveralSeedsAContendedOneHidesTheirCost) {
  std::vector<Json> rows;
  for (int seed = 0; seed < 3; ++seed) {
    rows.push_back(testing::sample_row("S", "b", 0.005, 1 + seed));
    rows.back()["params"]["seed"] = seed;
  }
  const OrderedRows idle(parse_rows(rows));
  EXPECT_DOUBLE_EQ(samples_of(idle.problems[0], "b").at(0).cost()->value, 200);
  rows[2]["contended"] = {{"load", 7.5}, {"why", "load 7.5 on 2 cores"}};
  const OrderedRows busy(parse_rows(rows));
  EXPECT_FALSE(samples_of(busy.problems[0], "b").at(0).cost()) << "the median of the rest is another one";
}

TEST(Sample, PassesWhereMostSeedsDoAndIsNamedByOneThatDoes) {
  std::vector<Json> rows;
  for (const double error : {0.5, 0.001, 0.002}) {
    rows.push_back(testing::sample_row("S", "b", error, 1));
    rows.back()["params"]["seed"] = error;
  }
  const OrderedRows ordered(parse_rows(rows));
  const Sample sample = samples_of(ordered.problems[0], "b").at(0);
  EXPECT_TRUE(sample.passes());
  EXPECT_TRUE(sample.row().passes());
  EXPECT_TRUE(ordered.representative(ordered.problems[0], "b")->passes()) << "the one in the middle";
}

TEST(Sample, FailsWhereMostSeedsDoAndIsNamedByOneThatDoes) {
  std::vector<Json> rows;
  for (const double error : {0.001, 0.5, 0.4}) {
    rows.push_back(testing::sample_row("S", "b", error, 1));
    rows.back()["params"]["seed"] = error;
  }
  const OrderedRows ordered(parse_rows(rows));
  const Sample sample = samples_of(ordered.problems[0], "b").at(0);
  EXPECT_FALSE(sample.passes());
  EXPECT_FALSE(sample.row().missed().empty()) << "what is said of it is what it missed";
}

TEST(Sample, ATowerThatFellHasReachedNothing) {
  std::vector<Json> rows{testing::sample_row("S", "b", 1e-5, 1), testing::sample_row("S", "b", 0.005, 4)};
  rows[0]["metrics"]["stands"] = {{"error", 1}, {"threshold", 0}, {"pass", false}};
  rows[1]["metrics"]["stands"] = {{"error", 0}, {"threshold", 0}, {"pass", true}};
  const OrderedRows ordered(parse_rows(rows));
  for (const CostLine& line : cost_of_accuracy(ordered)) {
    ASSERT_TRUE(line.at[1]) << line.metric;
    EXPECT_EQ(line.at[1]->row->origin.index, 1u) << line.metric;
  }
}

}  // namespace
}  // namespace plumb::harness
