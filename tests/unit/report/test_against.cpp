#include "report/ordered/against.hpp"

#include <gtest/gtest.h>

#include "report/text/against_text.hpp"
#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

/// A row that repeated itself to the bit, measured three times within the interval.
Json row_of(double error, double ms, double spread = 0.01) {
  Json row = testing::sample_row("S", "b", error, ms);
  row["metrics"]["determinism"] = {{"value", 1}, {"truth", 1}, {"error", 0}};
  row["machine"] = {{"cpu", "X"}, {"cores", 2}, {"date", "2026-01-01"}};
  row["time"]["runs"] = {ms * (1 - spread), ms, ms * (1 + spread)};
  return row;
}

struct Compared {
  std::vector<Row> before, after;
  Comparison result;
};

Compared compare(const std::vector<Json>& before, const std::vector<Json>& after) {
  Compared out{parse_rows(before), parse_rows(after), {}};
  out.result = compare_results(out.before, out.after, {});
  return out;
}

/// The only cell's changes as "error_of_it worse, time better".
std::string changes(const Comparison& comparison) {
  std::string out;
  for (const CellChange& cell : comparison.cells) {
    for (const Change& change : cell.changes)
      out += (out.empty() ? "" : ", ") + change.what + " " + std::string(sense_word(change.sense));
  }
  return out;
}

TEST(Against, EqualResultsHaveNoDifference) {
  const std::vector<Json> rows = testing::sample_rows(3);
  const Compared compared = compare(rows, rows);
  EXPECT_EQ(compared.result.both, rows.size());
  EXPECT_TRUE(compared.result.cells.empty());
  EXPECT_TRUE(compared.result.only_before.empty());
  EXPECT_TRUE(compared.result.only_after.empty());
}

TEST(Against, AnErrorOfARunThatRepeatsItselfHasNoNoise) {
  EXPECT_EQ(changes(compare({row_of(0.004, 1)}, {row_of(0.004 * (1 + 1e-10), 1)}).result), "");
  EXPECT_EQ(changes(compare({row_of(0.004, 1)}, {row_of(0.004 * (1 + 1e-8), 1)}).result), "error_of_it worse");
  EXPECT_EQ(changes(compare({row_of(0.004, 1)}, {row_of(0.003, 1)}).result), "error_of_it better");
  EXPECT_EQ(changes(compare({row_of(1e-15, 1)}, {row_of(3e-15, 1)}).result), "") << "rounding, and gold either way";
}

TEST(Against, ARunThatDoesNotRepeatItselfIsJudgedByThresholdsOnly) {
  std::vector<Json> before{row_of(0.004, 1)}, after{row_of(0.008, 1)};
  after[0]["metrics"]["determinism"]["error"] = 1;
  const Compared within = compare(before, after);
  EXPECT_EQ(within.result.noisy, 1u);
  EXPECT_EQ(changes(within.result), "determinism worse") << "the error is within its noise; that it has any is new";
  after[0] = row_of(0.02, 1);
  after[0]["metrics"]["determinism"]["error"] = 1;
  const Compared across = compare(before, after);
  EXPECT_EQ(across.result.cells.at(0).sense, Sense::worse);
  EXPECT_NE(changes(across.result).find("error_of_it worse"), std::string::npos);
}

TEST(Against, AMetricWithoutAThresholdHasChangedAndNoMore) {
  std::vector<Json> before{row_of(0.004, 1)}, after{row_of(0.004, 1)};
  before[0]["metrics"]["extra"] = {{"value", 1}, {"error", 1}};
  after[0]["metrics"]["extra"] = {{"value", 2}, {"error", 2}};
  const Compared compared = compare(before, after);
  EXPECT_EQ(changes(compared.result), "extra changed");
  EXPECT_EQ(compared.result.count(Sense::worse), 0u);
}

TEST(Against, WhatNobodyCouldJudgeIsNeitherWorseNorBetter) {
  std::vector<Json> passed{row_of(0.004, 1)}, unjudged{row_of(0.004, 1)};
  unjudged[0]["status"] = "unjudged";
  EXPECT_EQ(changes(compare(passed, unjudged).result), "result changed");
  EXPECT_EQ(changes(compare(unjudged, passed).result), "result changed");
}

TEST(Against, VerdictsAreWorseBetterOrChanged) {
  std::vector<Json> passed{row_of(0.004, 1)}, crashed{row_of(0.004, 1)};
  crashed[0]["status"] = "crashed";
  crashed[0]["reason"] = "SIGSEGV in step 10";
  const Compared worse = compare(passed, crashed);
  EXPECT_EQ(changes(worse.result), "result worse");
  EXPECT_NE(worse.result.cells[0].changes[0].text.find("SIGSEGV"), std::string::npos);
  EXPECT_EQ(changes(compare(crashed, passed).result), "result better");
  EXPECT_EQ(changes(compare({row_of(0.02, 1)}, {row_of(0.004, 1)}).result), "result better, error_of_it better");
}

TEST(Against, TimesCountWhereIntervalsDoNotOverlap) {
  EXPECT_EQ(changes(compare({row_of(0.004, 1)}, {row_of(0.004, 1.019)}).result), "") << "they overlap";
  EXPECT_EQ(changes(compare({row_of(0.004, 1)}, {row_of(0.004, 1.05)}).result), "time worse");
  EXPECT_EQ(changes(compare({row_of(0.004, 1.05)}, {row_of(0.004, 1)}).result), "time better");
  EXPECT_EQ(changes(compare({row_of(0.004, 1, 0.001)}, {row_of(0.004, 1.015, 0.001)}).result), "")
      << "apart, but by less than the least";
  std::vector<Json> wide{row_of(0.004, 1.05)};
  wide[0]["time"]["ci95"] = {0.9, 1.2};
  EXPECT_EQ(changes(compare({row_of(0.004, 1)}, wide).result), "") << "the 95 % interval is taken before the runs";
}

TEST(Against, ATimeThatWasMeasuredOnceNeedsTheStatedShare) {
  const auto once = [](double ms) {
    Json row = row_of(0.004, ms);
    row["time"].erase("runs");
    return row;
  };
  EXPECT_EQ(changes(compare({once(1)}, {once(1.09)}).result), "");
  EXPECT_EQ(changes(compare({once(1)}, {once(1.11)}).result), "time worse");
  EXPECT_EQ(changes(compare({row_of(0.004, 1)}, {once(1.09)}).result), "") << "one side once is enough";
}

TEST(Against, TimesOfOtherMachinesAndOfCrowdsAreLeftOutAndCounted) {
  std::vector<Json> other{row_of(0.004, 9)};
  other[0]["machine"]["cpu"] = "Y";
  const Compared machines = compare({row_of(0.004, 1)}, other);
  EXPECT_EQ(changes(machines.result), "");
  EXPECT_EQ(machines.result.other_machine, 1u);
  EXPECT_EQ(machines.result.machine_before, "X, 2 cores");
  std::vector<Json> crowded{row_of(0.004, 9)};
  crowded[0]["contended"] = {{"load", 8}, {"why", "load 8 on 2 cores"}};
  const Compared crowd = compare({row_of(0.004, 1)}, crowded);
  EXPECT_EQ(changes(crowd.result), "");
  EXPECT_EQ(crowd.result.contended, 1u);
}

TEST(Against, CellsAreTheSameWhenTheSameWasAskedFor) {
  std::vector<Json> before{row_of(0.004, 1)}, after{row_of(0.004, 1)};
  for (Json* row : {&before[0], &after[0]}) {
    (*row)["settings"] = {{"iterations", 10}, {"erp", 0.2}};
    (*row)["defaults"] = Json::object();
  }
  after[0]["settings"]["erp"] = 0.3;  // the engine's own value has changed, not what was asked
  after[0]["backend_version"] = "2";
  EXPECT_EQ(compare(before, after).result.both, 1u);
  after[0]["defaults"] = {{"iterations", 5}};  // now 10 was asked for
  const Compared apart = compare(before, after);
  EXPECT_EQ(apart.result.both, 0u);
  EXPECT_EQ(apart.result.only_before.size(), 1u);
  EXPECT_EQ(apart.result.only_after.size(), 1u);
}

TEST(Against, OtherBitsAreAChange) {
  std::vector<Json> before{row_of(0.004, 1)}, after{row_of(0.004, 1)};
  after[0]["hash"] = "01";
  EXPECT_EQ(changes(compare(before, after).result), "state changed");
}

TEST(Against, JsonHasTheLists) {
  const Compared compared = compare({row_of(0.004, 1)}, {row_of(0.02, 1)});
  const Json json = against_json(compared.result, "base", {});
  EXPECT_EQ(json["against"], "base");
  ASSERT_EQ(json["worse"].size(), 1u);
  EXPECT_EQ(json["worse"][0]["scene"], "S");
  EXPECT_EQ(json["worse"][0]["changes"][0]["what"], "result");
  EXPECT_EQ(json["worse"][0]["changes"][1]["after"], 0.02);
  EXPECT_TRUE(json["better"].empty());
}

}  // namespace
}  // namespace plumb::harness
