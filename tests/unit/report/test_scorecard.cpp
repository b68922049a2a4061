// The scorecard: factors over the best, worked out by hand.
#include "report/findings/scorecard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "report/text/scorecard_text.hpp"
#include "sample_rows.hpp"

namespace plumb::harness::testing {
namespace {

Json in_group(const char* group, Json row) {
  row["group"] = group;
  return row;
}

/// The row with another value of a knob, so that it is no default.
Json tuned(Json row, int iterations) {
  row["settings"] = {{"iterations", iterations}};
  row["defaults"] = {{"iterations", 10}};
  row["cell"] = row["cell"].get<std::string>() + std::to_string(iterations);
  return row;
}

std::vector<EngineScore> scores_of(const std::vector<Json>& rows) {
  // Statements point into rows: what is looked at here is their text.
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<CostLine> costs = cost_of_accuracy(ordered);
  return scorecard(ordered, costs, overviews(ordered, costs));
}

/// Threshold 0.01, so that errors from 1e-5 on count as they are; dt 0.01 s.
std::vector<Json> two_groups() {
  return {in_group("stacking", sample_row("D1", "alpha", 0.001, 1)),
          in_group("stacking", sample_row("D1", "omega", 0.004, 2)),
          in_group("stacking", sample_row("D2", "alpha", 0.009, 4)),
          in_group("stacking", sample_row("D2", "omega", 0.001, 2)),
          in_group("friction", sample_row("C1", "alpha", 0.002, 1)),
          in_group("friction", sample_row("C1", "omega", 0.5, 1))};
}

TEST(Scorecard, factors_are_geometric_means_over_the_best_engines) {
  const std::vector<EngineScore> scores = scores_of(two_groups());
  ASSERT_EQ(scores.size(), 2u);
  const std::size_t friction = 0, stacking = 1;  // groups in order of their first scene: C1 before D1
  const GroupScore &alpha = scores[0].groups[stacking], &omega = scores[1].groups[stacking];
  EXPECT_EQ(alpha.passed, 2);
  EXPECT_EQ(alpha.scored, 2);
  EXPECT_NEAR(alpha.error.factor.value(), std::sqrt(1.0 * 9), 1e-9);
  EXPECT_NEAR(omega.error.factor.value(), std::sqrt(4.0 * 1), 1e-9);
  // All errors are below 1 %: what counts is the cost, per test that of the cheaper one.
  EXPECT_NEAR(alpha.cost.factor.value(), std::sqrt(1.0 * 2), 1e-9);
  EXPECT_NEAR(omega.cost.factor.value(), std::sqrt(2.0 * 1), 1e-9);
  const GroupScore& failed = scores[1].groups[friction];
  EXPECT_EQ(failed.passed, 0);
  EXPECT_FALSE(failed.error.factor) << "a run that fails its scene has no accuracy";
  EXPECT_EQ(failed.error.reached, 0u);
  EXPECT_EQ(failed.error.tests, 1u);
  EXPECT_EQ(score_text(failed.error), "\u2013 (0 of 1)");
  EXPECT_NEAR(scores[0].all.error.factor.value(), std::cbrt(1.0 * 9 * 1), 1e-9);
  EXPECT_EQ(scores[0].all.error.tests, 3u);
}

TEST(Scorecard, equal_cost_lets_the_cheap_engine_take_what_it_can_pay_for) {
  const Json alpha = sample_row("D1", "alpha", 0.008, 1), omega = sample_row("D1", "omega", 0.004, 5);
  const std::vector<EngineScore> scores =
      scores_of({tuned(alpha, 10), tuned(sample_row("D1", "alpha", 0.002, 4), 40),  // within what omega costs
                 tuned(sample_row("D1", "alpha", 0.0001, 9), 80),                   // beyond
                 omega});
  EXPECT_NEAR(scores[0].all.error.factor.value(), 1, 1e-9);
  EXPECT_NEAR(scores[1].all.error.factor.value(), 2, 1e-9);
}

TEST(Scorecard, names_where_each_is_best_and_breaks) {
  std::vector<Json> rows = two_groups();
  rows[5]["status"] = "crashed";
  rows[5]["reason"] = "SIGSEGV";
  rows[5]["metrics"] = Json::object();
  const std::vector<EngineScore> scores = scores_of(rows);
  ASSERT_EQ(scores[0].best.size(), 2u);
  EXPECT_EQ(scores[0].best[0].text, "C1: alone passes");
  EXPECT_EQ(scores[0].best[1].text, "D1: error_of_it 4.00\u00d7 smaller than that of omega");
  EXPECT_TRUE(scores[0].breaks.empty());
  ASSERT_EQ(scores[1].best.size(), 1u);
  EXPECT_EQ(scores[1].best[0].text, "D2: error_of_it 9.00\u00d7 smaller than that of alpha");
  ASSERT_EQ(scores[1].breaks.size(), 1u);
  EXPECT_EQ(scores[1].breaks[0].text, "crashed in C1: SIGSEGV");
}

TEST(Scorecard, at_most_three_scenes_and_each_once) {
  std::vector<Json> rows;
  for (const char* scene : {"A1", "A2", "A3", "A4", "A5"}) {
    for (const int variant : {1, 2}) {
      for (const auto& [backend, error] : {std::pair{"alpha", 0.001}, std::pair{"omega", 0.5 * variant}}) {
        rows.push_back(sample_row(scene, backend, error, 1));
        rows.back()["params"] = {{"H", variant}};
        rows.back()["cell"] = rows.back()["cell"].get<std::string>() + std::to_string(variant);
      }
    }
  }
  const std::vector<EngineScore> scores = scores_of(rows);
  ASSERT_EQ(scores[0].best.size(), 3u);
  EXPECT_EQ(scores[0].best[1].text, "A2 H=1: alone passes");
  ASSERT_EQ(scores[1].breaks.size(), 3u);
}

TEST(Scorecard, counts_what_changed_since_a_baseline) {
  const std::vector<Row> before = parse_rows(two_groups());
  std::vector<Json> rows = two_groups();
  rows[1] = in_group("stacking", sample_row("D1", "omega", 0.5, 2));    // worse
  rows[5] = in_group("friction", sample_row("C1", "omega", 0.001, 1));  // better
  const std::vector<Row> after = parse_rows(rows);
  const Comparison comparison = compare_results(before, after, {});
  const std::string stacking = "stacking", friction = "friction";
  EXPECT_EQ(change_text(score_change(comparison, "omega", &stacking)), "\u22121");
  EXPECT_EQ(change_text(score_change(comparison, "omega", &friction)), "+1");
  EXPECT_EQ(change_text(score_change(comparison, "omega", nullptr)), "+1 \u22121");
  EXPECT_EQ(change_text(score_change(comparison, "alpha", nullptr)), "0");
}

TEST(Scorecard, is_written_as_text_and_markdown_where_there_are_two_engines) {
  const std::vector<Row> rows = parse_rows(two_groups());
  std::ostringstream text, markdown, alone;
  print_scorecard(text, rows, &rows, {}, 0, false);
  EXPECT_NE(text.str().find("stacking  alpha   2 of 2  3.00\u00d7 (2 of 2)  1.41\u00d7 (2 of 2)      0\n"),
            std::string::npos)
      << text.str();
  EXPECT_NE(text.str().find("alpha is best in:\n  C1: alone passes\n"), std::string::npos) << text.str();
  write_scorecard_markdown(markdown, rows, nullptr, {});
  EXPECT_NE(markdown.str().find("## Scorecard\n"), std::string::npos);
  EXPECT_NE(markdown.str().find("| stacking | alpha | 2 of 2 | 3.00\u00d7 (2 of 2) | 1.41\u00d7 (2 of 2) |\n"),
            std::string::npos)
      << markdown.str();
  EXPECT_EQ(markdown.str().find("since"), std::string::npos);
  print_scorecard(alone, parse_rows({sample_row("D1", "alpha", 0.001, 1)}), nullptr, {}, 0, false);
  EXPECT_EQ(alone.str(), "") << "nobody to be held against";
}

}  // namespace
}  // namespace plumb::harness::testing
