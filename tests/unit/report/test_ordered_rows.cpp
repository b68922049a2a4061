#include "report/ordered/ordered_rows.hpp"

#include <gtest/gtest.h>

#include "report/findings/overview.hpp"
#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

TEST(OrderedRows, ProblemsAreInTheOrderOfIdsAndNumbers) {
  const OrderedRows ordered(parse_rows(testing::sample_rows(0)));
  std::vector<std::string> titles;
  for (const Problem& problem : ordered.problems) titles.push_back(problem.title());
  const auto at = [&](const char* title) { return std::find(titles.begin(), titles.end(), title) - titles.begin(); };
  EXPECT_LT(at("B1 e=0.25"), at("B1 e=0.5"));
  EXPECT_LT(at("D1 H=50"), at("D1 H=100"));
  EXPECT_EQ(ordered.groups.front(), "integrator");
  EXPECT_EQ(ordered.groups.back(), "scale");
}

TEST(OrderedRows, DefaultsAreTheUsualCellsOfTheDefaultProfile) {
  const OrderedRows ordered(parse_rows(testing::sample_rows(6)));
  for (const Problem& problem : ordered.problems) {
    for (const std::string& backend : ordered.backends) {
      const Row* row = ordered.representative(problem, backend);
      ASSERT_NE(row, nullptr);
      EXPECT_DOUBLE_EQ(*row->dt, 1.0 / 60);
      EXPECT_EQ(row->settings["iterations"], 10);
      EXPECT_EQ(ordered.configuration(*row), "1/60 s");
    }
  }
}

TEST(OrderedRows, ASceneMayHaveATimeStepOfItsOwn) {
  std::vector<Json> rows{testing::sample_row("A1", "b", 0.1, 1), testing::sample_row("A2", "b", 0.1, 1),
                         testing::sample_row("C6", "b", 0.1, 1), testing::sample_row("A1", "b", 0.1, 1)};
  rows[2]["dt"] = 0.001;
  rows[3]["dt"] = 0.001;
  const OrderedRows ordered(parse_rows(rows));
  EXPECT_TRUE(ordered.is_default(ordered.rows[0]));
  EXPECT_TRUE(ordered.is_default(ordered.rows[2]));
  EXPECT_FALSE(ordered.is_default(ordered.rows[3])) << "as often as 0.01, which the other scenes have";
}

TEST(OrderedRows, TheCommandRunsTheCellAgain) {
  std::vector<Json> rows{testing::sample_row("S", "b", 0.1, 1), testing::sample_row("S", "b", 0.1, 1),
                         testing::sample_row("S", "b", 0.1, 1)};
  for (Json& row : rows) row["settings"]["iterations"] = 10;
  rows[2]["settings"]["iterations"] = 40;
  rows[2]["profile"] = "matched";
  rows[2]["dt"] = 0.005;
  rows[2]["params"] = {{"H", 50}, {"kind", "it's; rm -rf"}};
  const OrderedRows ordered(parse_rows(rows));
  EXPECT_EQ(
      ordered.command(ordered.rows[2]),
      "plumb run S --backend b --param H=50 --param 'kind=it'\\''s; rm -rf' --profile matched --set iterations=40 "
      "--dt 0.005 --seconds 1 --threads 1");
  EXPECT_EQ(ordered.configuration(ordered.rows[2]), "1/200 s, matched, iterations 40");
}

TEST(Overview, CountsEveryProblemOnce) {
  const OrderedRows ordered(parse_rows(testing::sample_rows(4)));
  for (const BackendOverview& overview : overviews(ordered, cost_of_accuracy(ordered))) {
    int sum = 0;
    for (const int count : overview.counts) sum += count;
    EXPECT_EQ(sum, static_cast<int>(ordered.problems.size()));
    EXPECT_EQ(overview.problems, sum);
    for (const ReachCount& count : overview.reach) EXPECT_LE(count.cheapest, count.reached);
    EXPECT_NE(describe_backend(overview, false).find("failed"), std::string::npos);
  }
}

TEST(Overview, WhatRanWithOtherSettingsOnlyIsNoWordOnTheDefaults) {
  std::vector<Json> rows{testing::sample_row("A1", "b", 1e-6, 1), testing::sample_row("A2", "b", 5.0, 1)};
  for (Json& row : rows) row["settings"] = {{"passes", 10}}, row["defaults"] = Json::object();
  rows[1]["settings"]["passes"] = 1;
  rows[1]["defaults"]["passes"] = 10;
  const OrderedRows ordered(parse_rows(rows));
  const BackendOverview overview = overviews(ordered, cost_of_accuracy(ordered)).at(0);
  EXPECT_EQ(overview.problems, 1);
  EXPECT_EQ(overview.elsewhere, 1);
  EXPECT_TRUE(overview.lost.empty());
  EXPECT_EQ(describe_counts(overview),
            "Of 1 scene variant at its defaults: 1 gold. 1 more scene variant ran with other settings only.");
}

TEST(Overview, TheWorstFailureIsNamedFirst) {
  std::vector<Json> rows{testing::sample_row("A1", "b", 0.02, 1), testing::sample_row("A2", "b", 5.0, 1),
                         testing::sample_row("A3", "b", 1e-6, 1)};
  const OrderedRows ordered(parse_rows(rows));
  const auto all = overviews(ordered, cost_of_accuracy(ordered));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(describe_backend(all[0], true),
            "Of 3 scene variants at its defaults: 1 gold, 2 failed. It gets within 1 % in 1 of 3 metrics. It misses by "
            "most in A2 "
            "(error_of_it at 500× its threshold), A1 (error_of_it at 2.00× its threshold).");
}

}  // namespace
}  // namespace plumb::harness
