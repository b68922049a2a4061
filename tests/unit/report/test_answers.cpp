#include "report/findings/answers.hpp"

#include <gtest/gtest.h>

#include "report/findings/needs.hpp"
#include "report/findings/overview.hpp"
#include "report/findings/robustness.hpp"
#include "report/ordered/order.hpp"
#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

Json scene_row(const char* scene, const char* slug, const char* backend, double ms, const Json& metrics) {
  Json row = testing::sample_row(scene, backend, 0.001, ms);
  row["slug"] = slug;
  row["metrics"] = metrics;
  return row;
}

Json metric(double value, double error, const Json& threshold) {
  Json out{{"value", value}, {"truth", 0}, {"error", error}, {"unit", "1"}, {"threshold", threshold}};
  if (!threshold.is_null()) out["pass"] = error <= threshold.get<double>();
  return out;
}

const AnsweredQuestion* find(const std::vector<AnsweredQuestion>& all, const std::string& words) {
  for (const AnsweredQuestion& answer : all) {
    if (answer.question.find(words) != std::string::npos) return &answer;
  }
  return nullptr;
}

TEST(Answers, TheTowerOfFiftyIsStoodByTheCheapestThatStandsIt) {
  std::vector<Json> rows;
  for (const auto& [backend, ms, fell] : {std::tuple{"a", 9.0, 0}, std::tuple{"b", 4.0, 0}, std::tuple{"c", 1.0, 1}}) {
    rows.push_back(scene_row("D1", "tower", backend, ms, {{"stands", metric(1 - fell, fell, 0)}}));
    rows.back()["params"]["H"] = 50;
    rows.push_back(scene_row("D1", "tower", backend, 0.1, {{"stands", metric(1, 0, 0)}}));
    rows.back()["params"]["H"] = 10;
  }
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<AnsweredQuestion> all = answers(ordered, cost_of_accuracy(ordered));
  const AnsweredQuestion* tower = find(all, "tower of 50");
  ASSERT_NE(tower, nullptr);
  ASSERT_EQ(tower->lines.size(), 3u);
  EXPECT_EQ(tower->verdict.rfind("b, at 400 ms", 0), 0u) << tower->verdict;
  EXPECT_EQ(tower->lines[0].backend, "b");
  EXPECT_EQ(tower->lines[1].backend, "a");
  EXPECT_FALSE(tower->lines[2].good);
  EXPECT_EQ(tower->lines[2].statements.at(0).text.rfind("never", 0), 0u);
}

TEST(Answers, ATowerOnItsWayDownDoesNotStand) {
  std::vector<Json> rows;
  for (const auto& [backend, ms, moving] : {std::tuple{"a", 9.0, 1e-7}, std::tuple{"b", 4.0, 3.0}}) {
    rows.push_back(scene_row("D1", "tower", backend, ms,
                             {{"stands", metric(1, 0, 0)}, {"kinetic_energy", metric(moving, moving, 1e-6)}}));
    rows.back()["params"]["H"] = 50;
  }
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<AnsweredQuestion> all = answers(ordered, cost_of_accuracy(ordered));
  const AnsweredQuestion* tower = find(all, "tower of 50");
  ASSERT_NE(tower, nullptr);
  EXPECT_EQ(tower->verdict.rfind("a, at 900 ms", 0), 0u) << tower->verdict;
  EXPECT_FALSE(tower->lines[1].good);
}

TEST(Answers, EnergyIsConservedByWhomNoRunLosesOrGainsIt) {
  const OrderedRows ordered(
      parse_rows({scene_row("A7", "pendulum", "a", 1, {{"energy_drift", metric(-0.9, 0.9, 0.05)}}),
                  scene_row("A9", "double", "a", 1, {{"energy_drift", metric(0, 0.001, 0.05)}}),
                  scene_row("A7", "pendulum", "b", 1, {{"energy_drift", metric(0.001, 0.002, 0.05)}})}));
  const std::vector<AnsweredQuestion> all = answers(ordered, cost_of_accuracy(ordered));
  const AnsweredQuestion* energy = find(all, "energy");
  ASSERT_NE(energy, nullptr);
  EXPECT_EQ(energy->verdict.rfind("b, within", 0), 0u) << energy->verdict;
  EXPECT_EQ(energy->lines[1].statements.at(0).text.rfind("loses up to 90 % (A7)", 0), 0u)
      << energy->lines[1].statements.at(0).text;
}

TEST(Answers, APyramidIsToldByTheSpreadOfHeadings) {
  const OrderedRows ordered(
      parse_rows({scene_row("C2", "sliding-stop", "a", 1, {{"spread", metric(0.35, 0.35, 0.02)}}),
                  scene_row("C2", "sliding-stop", "b", 1, {{"spread", metric(0.01, 0.01, 0.02)}}),
                  scene_row("C2", "sliding-stop", "c", 1, {{"spread", metric(0.04, 0.04, 0.02)}})}));
  EXPECT_TRUE(friction_of(ordered, "a").pyramid());
  EXPECT_FALSE(friction_of(ordered, "c").pyramid());
  const std::vector<AnsweredQuestion> all = answers(ordered, cost_of_accuracy(ordered));
  const AnsweredQuestion* friction = find(all, "pyramid");
  ASSERT_NE(friction, nullptr);
  EXPECT_EQ(friction->verdict.rfind("That of a at", 0), 0u) << friction->verdict;
  EXPECT_EQ(friction->lines.front().backend, "a");
}

TEST(Answers, AWinnerPassesItsSceneAndWhatTheOthersMissIsSaid) {
  std::vector<Json> rows;
  for (const auto& [backend, ms, drift] : {std::tuple{"a", 9.0, 0.002}, std::tuple{"b", 4.0, 0.0139}}) {
    rows.push_back(
        scene_row("D1", "tower", backend, ms, {{"stands", metric(1, 0, 0)}, {"drift", metric(drift, drift, 0.01)}}));
    rows.back()["params"]["H"] = 50;
    rows.back()["status"] = drift > 0.01 ? "failed" : "ok";
  }
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<AnsweredQuestion> all = answers(ordered, cost_of_accuracy(ordered));
  const AnsweredQuestion* tower = find(all, "tower of 50");
  ASSERT_NE(tower, nullptr);
  EXPECT_EQ(tower->verdict.rfind("a, at 900 ms", 0), 0u) << tower->verdict;
  EXPECT_TRUE(tower->lines[0].good);
  EXPECT_FALSE(tower->lines[1].good);
  EXPECT_NE(tower->lines[1].statements.at(0).text.find("misses drift 0.0139 > 0.01"), std::string::npos)
      << tower->lines[1].statements.at(0).text;
}

TEST(Answers, ABusyMachineLeavesWhoDoesItAndTakesAtWhatCost) {
  std::vector<Json> rows;
  for (const auto& [backend, ms, fell] : {std::tuple{"a", 9.0, 0}, std::tuple{"b", 4.0, 0}, std::tuple{"c", 1.0, 1}}) {
    rows.push_back(scene_row("D1", "tower", backend, ms, {{"stands", metric(1 - fell, fell, 0)}}));
    rows.back()["params"]["H"] = 50;
    rows.back()["status"] = fell ? "failed" : "ok";
    if (backend != std::string("a")) rows.back()["contended"] = {{"load", 3}, {"why", "load 3 on 2 cores"}};
  }
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<CostLine> costs = cost_of_accuracy(ordered);
  const std::vector<AnsweredQuestion> all = answers(ordered, costs);
  const AnsweredQuestion* tower = find(all, "tower of 50");
  ASSERT_NE(tower, nullptr);
  EXPECT_EQ(tower->verdict.rfind("a and b can. Who is cheapest is not known", 0), 0u) << tower->verdict;
  EXPECT_TRUE(tower->lines[0].good && tower->lines[1].good);
  EXPECT_FALSE(tower->lines[2].good);
  EXPECT_EQ(overviews(ordered, costs)[1].reach[1].reached, 1u);
  EXPECT_EQ(overviews(ordered, costs)[0].reach[1].cheapest, 0u) << "b may be cheaper";
}

TEST(Answers, LosingIsFailingNeverReachingWhatAnotherReachesOrPayingMore) {
  const OrderedRows ordered(
      parse_rows({testing::sample_row("S1", "a", 0.5, 1), testing::sample_row("S1", "b", 0.001, 1),
                  testing::sample_row("S2", "a", 0.001, 1), testing::sample_row("S2", "b", 0.001, 7)}));
  const std::vector<CostLine> costs = cost_of_accuracy(ordered);
  const std::vector<CostTest> tests = tests_of(costs);
  ASSERT_EQ(never_reached(tests, "a", 1).size(), 1u);
  EXPECT_EQ(never_reached(tests, "a", 1)[0]->problem->scene, "S1");
  EXPECT_TRUE(never_reached(tests, "b", 1).empty());
  ASSERT_EQ(beaten_at(tests, "b", 1).size(), 1u);
  EXPECT_DOUBLE_EQ(beaten_at(tests, "b", 1)[0].factor, 7);
  const std::vector<AnsweredQuestion> all = answers(ordered, costs);
  const AnsweredQuestion* losing = find(all, "lose");
  ASSERT_NE(losing, nullptr);
  EXPECT_EQ(losing->lines[0].statements.at(0).text, "fails 1 of 2 scene variants at its defaults: S1");
  EXPECT_NE(losing->lines[0].statements.at(1).text.find("S1 error_of_it"), std::string::npos);
  EXPECT_NE(losing->lines[1].statements.at(0).text.find("7.00\u00d7 what a does"), std::string::npos);
  EXPECT_EQ(losing->verdict, "Scene variants failed at the defaults: b 0 of 2 and a 1 of 2.");
}

TEST(Answers, WhoGetsThereMostOftenNeedNotBeTheCheapest) {
  std::vector<Json> rows;
  for (const char* scene : {"S1", "S2", "S3"}) {
    rows.push_back(testing::sample_row(scene, "exact", 0.001, 7));
    rows.push_back(testing::sample_row(scene, "cheap", scene == std::string("S3") ? 0.5 : 0.001, 1));
  }
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<AnsweredQuestion> all = answers(ordered, cost_of_accuracy(ordered));
  const AnsweredQuestion* reach = find(all, "most often");
  ASSERT_NE(reach, nullptr);
  EXPECT_EQ(reach->verdict, "exact most often, in 3 of 3 metrics; the cheapest most often is cheap, in 2 of 2.");
}

TEST(Answers, OneRunIsNotSeveral) {
  const OrderedRows ordered(
      parse_rows({scene_row("A7", "pendulum", "a", 1, {{"energy_drift", metric(-0.9, 0.9, 0.05)}}),
                  scene_row("A7", "pendulum", "b", 1, {{"energy_drift", metric(0.001, 0.002, 0.05)}})}));
  EXPECT_EQ(energy_statement(energy_of(ordered, "a")).text.rfind("loses up to 90 % (A7)", 0), 0u);
  EXPECT_EQ(energy_statement(energy_of(ordered, "a")).text.find("1 runs"), std::string::npos);
  EXPECT_EQ(energy_statement(energy_of(ordered, "b")).text.rfind("keeps it within 0.20 % in the one run of a scene", 0),
            0u);
}

TEST(Needs, PairsAreEqualButForTheNeeds) {
  std::vector<Json> rows{testing::sample_row("S", "b", 0.1, 2), testing::sample_row("S", "b", 0.1, 3),
                         testing::sample_row("T", "b", 0.1, 1), testing::sample_row("T", "b", 0.1, 4),
                         testing::sample_row("U", "b", 0.1, 9)};
  rows[1]["needs"] = rows[3]["needs"] = rows[4]["needs"] = "scene+sleeping";
  rows[0]["needs"] = "scene";
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<NeedCost> costs = costs_of_needs(ordered);
  ASSERT_EQ(costs.size(), 1u);
  EXPECT_EQ(costs[0].need, "sleeping");
  ASSERT_EQ(costs[0].pairs.size(), 2u) << "U has no run without";
  EXPECT_DOUBLE_EQ(costs[0].pairs[0].factor, 4);
  EXPECT_DOUBLE_EQ(costs[0].median.value(), 2.75);
}

TEST(Needs, WhatChangesTheRunIsNotItsPrice) {
  std::vector<Json> rows{testing::sample_row("S", "b", 0.1, 2), testing::sample_row("S", "b", 0.1, 3),
                         testing::sample_row("T", "b", 0.1, 1), testing::sample_row("T", "b", 0.1, 0.04)};
  rows[1]["needs"] = rows[3]["needs"] = "all";
  rows[3]["hash"] = "asleep";
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<NeedCost> costs = costs_of_needs(ordered);
  ASSERT_EQ(costs.size(), 1u);
  ASSERT_EQ(costs[0].pairs.size(), 1u);
  EXPECT_DOUBLE_EQ(costs[0].median.value(), 1.5);
  ASSERT_EQ(costs[0].changed.size(), 1u);
  EXPECT_DOUBLE_EQ(costs[0].changed[0].factor, 0.04);
}

TEST(Robustness, WorstMedianAndCountOverScenes) {
  std::vector<Json> rows;
  for (const auto& [scene, value] : {std::pair{"S1", 0.001}, std::pair{"S2", 0.2}, std::pair{"S3", 0.005}})
    rows.push_back(scene_row(scene, "s", "b", 1, {{"energy_injected", metric(value, value, nullptr)}}));
  rows.push_back(scene_row("S1", "s", "b", 1, {{"energy_injected", metric(9, 9, nullptr)}}));
  rows.back()["dt"] = 0.001;
  const OrderedRows ordered(parse_rows(rows));
  const std::vector<RobustnessLine> lines = robustness(ordered);
  ASSERT_EQ(lines.size(), 1u);
  const RobustnessCell& cell = lines[0].cells.at(0).value();
  EXPECT_EQ(cell.worst, 0.2) << "at the defaults";
  EXPECT_EQ(cell.row->scene, "S2");
  EXPECT_EQ(cell.median, 0.005);
  EXPECT_EQ(cell.beyond, 1u);
  EXPECT_EQ(cell.runs, 3u);
}

TEST(Order, IsTheSlopeInLogarithms) {
  EXPECT_FALSE(fit_order({{0.1, 1}, {0.05, 0.5}})) << "two points lie on a line in any case";
  const auto order = fit_order({{0.1, 0.02}, {0.05, 0.005}, {0.025, 0.00125}, {0.01, 0}});
  ASSERT_TRUE(order);
  EXPECT_EQ(order->points, 3u) << "zero has no logarithm";
  EXPECT_NEAR(order->power, 2, 1e-9);
  EXPECT_NEAR(order->at(0.2), 0.08, 1e-9);
  EXPECT_EQ(order_text(*order), "2.00 (2.00 to 2.00)");
}

}  // namespace
}  // namespace plumb::harness
