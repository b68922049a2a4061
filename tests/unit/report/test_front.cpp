#include "report/findings/front.hpp"

#include <gtest/gtest.h>

#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

/// A run that passes its scene, whatever its error.
Json passing_row(const char* scene, const char* backend, double error, double ms) {
  Json row = testing::sample_row(scene, backend, error, ms);
  row["status"] = "ok";
  row["metrics"]["error_of_it"]["threshold"] = 1;
  row["metrics"]["error_of_it"]["pass"] = true;
  return row;
}

std::vector<std::size_t> indices(const std::vector<FrontPoint>& points) {
  std::vector<std::size_t> out;
  for (const FrontPoint& point : points) out.push_back(point.sample.row().origin.index);
  return out;
}

TEST(Front, WhatNoOtherBeatsStandsOnItAndTheRestKnowsByWhom) {
  const std::vector<Json> rows{
      passing_row("S", "a", 0.5, 1),      // 0: cheapest
      passing_row("S", "a", 0.1, 4),      // 1
      passing_row("S", "b", 0.2, 5),      // 2: beaten by 1
      passing_row("S", "b", 0.1, 4),      // 3: the same as 1
      passing_row("S", "b", 0.1, 9),      // 4: as exact as 1, dearer
      passing_row("S", "b", 0.0001, 20),  // 5: most exact
      passing_row("S", "a", 0.7, 1),      // 6: as cheap as 0, less exact
      passing_row("S", "a", 0.6, 30),     // 7: by 0, which is the cheapest that is as exact
  };
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<Front> fronts = pareto_fronts(ordered);
  ASSERT_EQ(fronts.size(), 1u);
  EXPECT_EQ(indices(fronts[0].best), (std::vector<std::size_t>{0, 1, 3, 5}));
  std::map<std::size_t, std::size_t> beaten;
  for (const Dominated& other : fronts[0].others)
    beaten[other.point.sample.row().origin.index] = fronts[0].best[other.by].sample.row().origin.index;
  EXPECT_EQ(beaten, (std::map<std::size_t, std::size_t>{{2, 1}, {4, 1}, {6, 0}, {7, 0}}));
}

TEST(Front, EqualsBruteForce) {
  const OrderedRows ordered(parse_rows(testing::sample_rows(7)));
  const std::vector<Front> fronts = pareto_fronts(ordered);
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

TEST(Front, WhatFailsOrWasMeasuredInACrowdIsNotInTheRace) {
  std::vector<Json> rows{passing_row("S", "a", 0.2, 5), passing_row("S", "a", 0.001, 1),
                         passing_row("S", "a", 0.001, 1), passing_row("S", "a", 0.001, 1)};
  for (Json& row : rows) row["metrics"]["stands"] = {{"error", 0}, {"threshold", 0}, {"pass", true}};
  rows[1]["metrics"]["stands"] = {{"error", 1}, {"threshold", 0}, {"pass", false}};
  rows[2]["contended"] = {{"load", 9}, {"why", "load 9 on 2 cores"}};
  rows[3]["metrics"]["error_of_it"]["pass"] = false;
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<Front> fronts = pareto_fronts(ordered);
  ASSERT_EQ(fronts.size(), 1u) << "and the question has no front";
  EXPECT_EQ(indices(fronts[0].best), (std::vector<std::size_t>{0}));
  EXPECT_TRUE(fronts[0].others.empty());
  EXPECT_EQ(fronts[0].untimed, 1u);
}

TEST(Front, IsCountedWhereItSaysSomething) {
  std::vector<Json> rows;
  for (const char* scene : {"S1", "S2", "S3"}) {
    rows.push_back(passing_row(scene, "a", 0.5, 1));
    rows.push_back(passing_row(scene, "a", 0.1, 4));
    rows.push_back(passing_row(scene, "b", 0.2, 5));
  }
  rows.pop_back();                                                     // S3 has two points
  rows[3]["contended"] = {{"load", 9}, {"why", "load 9 on 2 cores"}};  // and of S2 one is not known
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<Front> fronts = pareto_fronts(ordered);
  ASSERT_EQ(fronts.size(), 3u);
  const FrontCount a = count_fronts(fronts, "a"), b = count_fronts(fronts, "b");
  EXPECT_EQ(a.ran, 1u);
  EXPECT_EQ(a.on, 1u);
  EXPECT_EQ(a.alone, 1u);
  EXPECT_EQ(b.ran, 1u);
  EXPECT_EQ(b.on, 0u);
}

}  // namespace
}  // namespace plumb::harness
