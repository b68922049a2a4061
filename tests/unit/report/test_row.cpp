#include <gtest/gtest.h>

#include <cmath>

#include "rows/row.hpp"
#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

TEST(Row, ReadsEveryFieldOfTheContract) {
  const Json line = Json::parse(R"({"scene":"D1","group":"stacking","params":{"H":50,"kind":"wall"},"backend":"b",
    "backend_version":"1.2","settings":{"iterations":10},"profile":"matched","dt":0.01,"seconds":10,"threads":2,
    "status":"failed","reason":"r","metrics":{"z":{"value":1.5,"unit":"m","truth":1,"error":0.5,"threshold":0.1,
    "gold":0.01,"pass":false},"a":{"value":2,"unit":"1","truth":null,"error":0.001,"threshold":0.1,"gold":0.01,
    "pass":true}},"time":{"ms_per_step":{"median":2,"min":1,"max":4,"p99":3},"window":[10,990],"steps":1000,
    "setup_ms":7,"phase_ms":{"broad":0.5,"solve":null}},"counts":{"bodies":51,"contacts_max":200,"dropped":3,
    "nonfinite":1},"restarted":2,"hash":"ab","peak_mb":12.5,"machine":{"cpu":"c"}})");
  const Row row = parse_row(line, 7);
  EXPECT_EQ(row.origin.index, 7u);
  EXPECT_EQ(row.scene + row.group + row.backend + row.engine.version, "D1stackingb1.2");
  EXPECT_EQ(row.profile + row.status + row.reason + row.hash, "matchedfailedrab");
  EXPECT_EQ(row.variant(), "H=50 kind=wall");
  EXPECT_EQ(row.settings["iterations"], 10);
  EXPECT_EQ(row.origin.machine["cpu"], "c");
  EXPECT_EQ(row.dt, 0.01);
  EXPECT_EQ(row.seconds, 10);
  EXPECT_EQ(row.threads, 2);
  ASSERT_EQ(row.metrics.size(), 2u);
  EXPECT_EQ(row.metrics[0].name, "z") << "metrics keep the order of the line";
  EXPECT_EQ(row.metrics[0].value, 1.5);
  EXPECT_EQ(row.metrics[0].truth, 1);
  EXPECT_EQ(row.metrics[0].error, 0.5);
  EXPECT_EQ(row.metrics[0].pass, false);
  EXPECT_FALSE(row.metrics[0].is_gold);
  EXPECT_FALSE(row.metrics[1].truth);
  EXPECT_TRUE(row.metrics[1].is_gold);
  EXPECT_EQ(row.time.median_ms, 2);
  EXPECT_EQ(row.time.min_ms, 1);
  EXPECT_EQ(row.time.max_ms, 4);
  EXPECT_EQ(row.time.p99_ms, 3);
  EXPECT_EQ(row.time.window_first, 10);
  EXPECT_EQ(row.time.window_last, 990);
  EXPECT_EQ(row.time.steps, 1000);
  EXPECT_EQ(row.time.setup_ms, 7);
  ASSERT_EQ(row.time.phase_ms.size(), 1u);
  EXPECT_EQ(row.time.phase_ms[0].second, 0.5);
  EXPECT_EQ(row.counts.bodies, 51);
  EXPECT_EQ(row.counts.contacts_max, 200);
  EXPECT_EQ(row.counts.dropped, 3);
  EXPECT_EQ(row.counts.nonfinite, 1);
  EXPECT_EQ(row.counts.peak_mb, 12.5);
  EXPECT_EQ(row.time.restarted, 2);
  EXPECT_EQ(row.ms_per_simulated_second(), 200);
  EXPECT_EQ(row.verdict(), Verdict::failed);
  ASSERT_NE(row.worst(), nullptr);
  EXPECT_EQ(row.worst()->name, "z");
}

TEST(Row, WrongTypesAreAbsentNotFatal) {
  for (const char* text : {"{}", "[]", "null", "3", R"({"scene":3,"metrics":[1],"time":"x","dt":"fast","params":7})",
                           R"({"status":"ok","metrics":{"m":null},"time":{"window":[1],"ms_per_step":4}})"}) {
    const Row row = parse_row(Json::parse(text), 0);
    EXPECT_FALSE(row.dt) << text;
    EXPECT_FALSE(row.ms_per_simulated_second()) << text;
    EXPECT_TRUE(row.params.is_object()) << text;
  }
  EXPECT_EQ(parse_row(Json::parse("{}"), 0).verdict(), Verdict::error);
}

TEST(Row, VerdictsFollowStatusAndMetrics) {
  const auto verdict = [](double error) { return parse_row(testing::sample_row("S", "b", error, 1), 0).verdict(); };
  EXPECT_EQ(verdict(1e-5), Verdict::gold);
  EXPECT_EQ(verdict(1e-3), Verdict::pass);
  EXPECT_EQ(verdict(0.02), Verdict::failed);
  for (const char* status : {"unsupported", "unjudged", "crashed", "timeout", "out_of_memory", "error"}) {
    Json line = testing::sample_row("S", "b", 1e-5, 1);
    line["status"] = status;
    EXPECT_EQ(verdict_word(parse_row(line, 0).verdict()), status);
  }
  Json unscored = testing::sample_row("S", "b", 1e-5, 1);
  unscored["metrics"]["error_of_it"] = {{"value", 1}, {"unit", "m"}, {"error", 5}};
  EXPECT_EQ(parse_row(unscored, 0).verdict(), Verdict::ran);
}

TEST(Row, AnErrorThatIsNotFiniteMissesItsThreshold) {
  Json line = testing::sample_row("S", "b", 1e-5, 1);
  line["metrics"]["error_of_it"]["error"] = nullptr;
  line["metrics"]["error_of_it"].erase("pass");
  const Row row = parse_row(line, 0);
  EXPECT_EQ(row.verdict(), Verdict::failed);
  EXPECT_TRUE(std::isinf(*row.worst()->badness()));
}

}  // namespace
}  // namespace plumb::harness
