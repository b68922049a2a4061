#include "report/findings/profile.hpp"

#include <gtest/gtest.h>

#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

/// Four scenes; costs to reach 1 %: S1 a 1, b 2; S2 a 6, b 2; S3 a 4, b never; S4 nobody. dt is 0.01 s.
std::vector<Json> four_scenes() {
  return {testing::sample_row("S1", "a", 0.005, 1), testing::sample_row("S1", "b", 0.005, 2),
          testing::sample_row("S2", "a", 0.005, 6), testing::sample_row("S2", "b", 0.005, 2),
          testing::sample_row("S3", "a", 0.005, 4), testing::sample_row("S3", "b", 0.5, 1),
          testing::sample_row("S4", "a", 0.5, 1),   testing::sample_row("S4", "b", 0.5, 1)};
}

TEST(Profile, SharesAreThoseCountedByHand) {
  const OrderedRows ordered(parse_rows(four_scenes()));
  const std::vector<CostLine> costs = cost_of_accuracy(ordered);
  const Profile profile = cost_profile(ordered, costs, "", 1);
  EXPECT_EQ(profile.tests, 4u);
  EXPECT_EQ(profile.unsolved, 1u);
  ASSERT_EQ(profile.curves.size(), 2u);
  const ProfileCurve &a = profile.curves[0], &b = profile.curves[1];
  EXPECT_EQ(a.at(1), 0.5) << "cheapest on S1 and S3";
  EXPECT_EQ(a.at(2.9), 0.5);
  EXPECT_EQ(a.at(3), 0.75) << "S2 at three times the cost";
  EXPECT_EQ(a.reliability(), 0.75);
  EXPECT_EQ(b.at(1), 0.25);
  EXPECT_EQ(b.at(2), 0.5);
  EXPECT_EQ(b.reliability(), 0.5);
}

TEST(Profile, ATestThatNotAllRanCountsForNobody) {
  std::vector<Json> rows = four_scenes();
  rows.pop_back();
  const OrderedRows ordered(parse_rows(rows));
  const Profile profile = cost_profile(ordered, cost_of_accuracy(ordered), "", 1);
  EXPECT_EQ(profile.tests, 3u);
  EXPECT_EQ(profile.unsolved, 0u);
}

TEST(Profile, AnEngineThatRanLittleIsLeftOutAndSpoilsNothing) {
  std::vector<Json> rows = four_scenes();
  rows.push_back(testing::sample_row("S1", "c", 0.005, 0.1));
  const OrderedRows ordered(parse_rows(rows));
  const Profile profile = cost_profile(ordered, cost_of_accuracy(ordered), "", 1);
  EXPECT_EQ(profile.tests, 4u);
  ASSERT_EQ(profile.curves.size(), 2u);
  EXPECT_EQ(profile.curves[0].at(1), 0.5) << "relative to the engines that take part";
}

TEST(Profile, ACrashIsNotSolvedAndWhatContentionHidesIsSolvedAtAnUnknownCost) {
  std::vector<Json> rows = four_scenes();
  rows[0]["status"] = "crashed";
  rows[3]["contended"] = {{"load", 9}, {"why", "load 9 on 2 cores"}};
  const OrderedRows ordered(parse_rows(rows));
  const Profile profile = cost_profile(ordered, cost_of_accuracy(ordered), "", 1);
  EXPECT_EQ(profile.tests, 4u);
  EXPECT_EQ(profile.unpriced, 1u) << "S2 has no fair time of b";
  EXPECT_EQ(profile.curves[0].reliability(), 0.5) << "S2 and S3";
  EXPECT_EQ(profile.curves[0].at(1e9), 0.25) << "on S3 its cost is known";
  EXPECT_EQ(profile.curves[1].reliability(), 0.5) << "S1 and S2";
  EXPECT_EQ(profile.curves[1].at(1e9), 0.25);
}

TEST(Profile, ErrorsAtDefaultsAreSharesOfGradedTests) {
  const OrderedRows ordered(parse_rows(four_scenes()));
  const Profile profile = error_profile(ordered, cost_of_accuracy(ordered), "");
  EXPECT_EQ(profile.tests, 4u);
  EXPECT_EQ(profile.curves[0].at(0.01), 0.75);
  EXPECT_EQ(profile.curves[1].at(0.01), 0.5);
  EXPECT_EQ(profile.curves[1].at(1), 1);
  EXPECT_EQ(cost_profile(ordered, cost_of_accuracy(ordered), "no such group", 1).tests, 0u);
}

}  // namespace
}  // namespace plumb::harness
