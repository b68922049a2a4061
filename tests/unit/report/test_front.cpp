#include "report/front.hpp"

#include <gtest/gtest.h>

#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

std::vector<std::size_t> indices(const std::vector<FrontPoint>& points) {
  std::vector<std::size_t> out;
  for (const FrontPoint& point : points) out.push_back(point.sample.row().index);
  return out;
}

TEST(Front, WhatNoOtherBeatsStandsOnItAndTheRestKnowsByWhom) {
  const std::vector<Json> rows{
      testing::sample_row("S", "a", 0.5, 1),      // 0: cheapest
      testing::sample_row("S", "a", 0.1, 4),      // 1
      testing::sample_row("S", "b", 0.2, 5),      // 2: beaten by 1
      testing::sample_row("S", "b", 0.1, 4),      // 3: the same as 1
      testing::sample_row("S", "b", 0.1, 9),      // 4: as exact as 1, dearer
      testing::sample_row("S", "b", 0.0001, 20),  // 5: most exact
      testing::sample_row("S", "a", 0.7, 1),      // 6: as cheap as 0, less exact
      testing::sample_row("S", "a", 0.6, 30),     // 7: by 0, which is the cheapest that is as exact
  };
  const Study study(parse_rows(rows));
  const std::vector<Front> fronts = pareto_fronts(study);
  ASSERT_EQ(fronts.size(), 1u);
  EXPECT_EQ(indices(fronts[0].best), (std::vector<std::size_t>{0, 1, 3, 5}));
  std::map<std::size_t, std::size_t> beaten;
  for (const Dominated& other : fronts[0].others)
    beaten[other.point.sample.row().index] = fronts[0].best[other.by].sample.row().index;
  EXPECT_EQ(beaten, (std::map<std::size_t, std::size_t>{{2, 1}, {4, 1}, {6, 0}, {7, 0}}));
}

TEST(Front, EqualsBruteForce) {
  const Study study(parse_rows(testing::sample_rows(7)));
  const std::vector<Front> fronts = pareto_fronts(study);
  ASSERT_GT(fronts.size(), 20u);
  for (const Front& front : fronts) {
    std::vector<FrontPoint> all = front.best;
    for (const Dominated& other : front.others) all.push_back(other.point);
    const auto beats = [](const FrontPoint& a, const FrontPoint& b) {
      return a.ms <= b.ms && a.error <= b.error && (a.ms < b.ms || a.error < b.error);
    };
    for (const FrontPoint& point : front.best) {
      for (const FrontPoint& other : all) EXPECT_FALSE(beats(other, point));
    }
    for (const Dominated& other : front.others) EXPECT_TRUE(beats(front.best[other.by], other.point));
  }
}

TEST(Front, WhatFellDownOrWasMeasuredInACrowdIsNotInTheRace) {
  std::vector<Json> rows{testing::sample_row("S", "a", 0.2, 5), testing::sample_row("S", "a", 0.001, 1),
                         testing::sample_row("S", "a", 0.001, 1)};
  for (Json& row : rows) row["metrics"]["stands"] = {{"error", 0}, {"threshold", 0}, {"pass", true}};
  rows[1]["metrics"]["stands"] = {{"error", 1}, {"threshold", 0}, {"pass", false}};
  rows[2]["contended"] = {{"load", 9}, {"why", "load 9 on 2 cores"}};
  const Study study(parse_rows(rows));
  const std::vector<Front> fronts = pareto_fronts(study);
  ASSERT_EQ(fronts.size(), 1u) << "and the question has no front";
  EXPECT_EQ(indices(fronts[0].best), (std::vector<std::size_t>{0}));
  EXPECT_TRUE(fronts[0].others.empty());
}

}  // namespace
}  // namespace plumb::harness
