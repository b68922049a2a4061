#include "report/findings/distributions.hpp"

#include <gtest/gtest.h>

#include "page_reader.hpp"
#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

/// A scene of several seeds: error_of_it (threshold 0.01), "stands" (0 or 1), and a height without a truth.
std::vector<Json> seeds(const char* backend, const std::vector<double>& errors, bool falls_with_the_last) {
  std::vector<Json> rows;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    Json row = testing::sample_row("S", backend, errors[i], 1);
    row["params"] = {{"H", 5}, {"seed", i + 1}};
    const double fallen = falls_with_the_last && i + 1 == errors.size() ? 1 : 0;
    row["metrics"]["stands"] = {{"value", 1 - fallen}, {"unit", "1"}, {"truth", 1},         {"error", fallen},
                                {"threshold", 0},      {"gold", 0},   {"pass", fallen == 0}};
    row["metrics"]["height"] = {{"value", 2.0 + static_cast<double>(i)}, {"unit", "m"}};
    rows.push_back(row);
  }
  return rows;
}

std::vector<Json> two_engines() {
  std::vector<Json> rows = seeds("b", {0.03, 0.001, 0.002, 0.004}, true);
  for (Json& row : seeds("c", {0.001, 0.002, 0.003}, false)) rows.push_back(std::move(row));
  return rows;
}

const DistributionLine& line_of(const std::vector<DistributionLine>& lines, std::string_view metric) {
  for (const DistributionLine& line : lines)
    if (line.metric == metric) return line;
  throw std::out_of_range(std::string(metric));
}

TEST(Distributions, SayHowManyPassAndHowFarTheyLieApart) {
  const OrderedRows ordered(parse_rows(two_engines()));
  const std::vector<DistributionLine> lines = distributions(ordered);
  ASSERT_EQ(lines.size(), 3u);
  const DistributionLine& error = line_of(lines, "error_of_it");
  ASSERT_EQ(error.cells.size(), 2u);
  EXPECT_TRUE(error.scored && !error.asked);
  EXPECT_EQ(error.cells[0]->runs, 4u);
  EXPECT_EQ(error.cells[0]->passed, 3u);
  EXPECT_EQ(error.cells[0]->least, 0.001);
  EXPECT_DOUBLE_EQ(*error.cells[0]->median, 0.003);
  EXPECT_EQ(error.cells[0]->most, 0.03);
  EXPECT_EQ(error.cells[0]->row->origin.index, 0u);
  EXPECT_EQ(error.cells[1]->passed, 3u);
  const DistributionLine& stands = line_of(lines, "stands");
  EXPECT_TRUE(stands.asked);
  EXPECT_EQ(stands.cells[0]->passed, 3u);
  EXPECT_EQ(stands.cells[0]->row->origin.index, 3u);
  const DistributionLine& height = line_of(lines, "height");
  EXPECT_FALSE(height.scored);
  EXPECT_DOUBLE_EQ(*height.cells[0]->median, 3.5);
  EXPECT_EQ(height.cells[0]->most, 5);
}

TEST(Distributions, ARunThatDidNotComeThroughHasNotPassed) {
  std::vector<Json> rows = seeds("b", {0.001, 0.002, 0.003}, false);
  rows[1]["status"] = "crashed";
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<DistributionLine> lines = distributions(ordered);
  const DistributionLine& error = line_of(lines, "error_of_it");
  EXPECT_EQ(error.cells[0]->runs, 3u);
  EXPECT_EQ(error.cells[0]->passed, 2u);
  EXPECT_EQ(error.cells[0]->row->origin.index, 1u);
}

TEST(Distributions, FewSeedsAndOtherSettingsAreNone) {
  EXPECT_TRUE(distributions(OrderedRows(parse_rows(seeds("b", {0.1, 0.2}, false)))).empty());
  std::vector<Json> rows = seeds("b", {0.1, 0.2, 0.3}, false);
  rows[2]["settings"]["iterations"] = 40;
  EXPECT_TRUE(distributions(OrderedRows(parse_rows(rows))).empty());
}

TEST(Distributions, StandOnThePage) {
  const std::string page = testing::page_of(parse_rows(two_engines()));
  EXPECT_EQ(testing::count(page, "<section id=\"seeds\""), 1u);
  EXPECT_EQ(testing::count(page, ">3 of 4</a>"), 2u) << "error_of_it and stands";
  EXPECT_EQ(testing::count(testing::page_of(parse_rows(testing::sample_rows(1))), "<section id=\"seeds\""), 0u);
}

}  // namespace
}  // namespace plumb::harness
