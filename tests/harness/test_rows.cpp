// Rows have every key of the contract, with the right types and the settings in force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cell/metric_rows.hpp"
#include "program.hpp"
#include "schedule/row_of_cell.hpp"

namespace plumb::harness::testing {
namespace {

TEST(Rows, have_every_key_of_the_contract) {
  const Finished finished = plumb({"run", "A1", "--backend", SAMPLE_BACKEND, "--json", "--repeat", "3"});
  ASSERT_EQ(finished.status, 0) << finished.err;
  ASSERT_EQ(finished.rows().size(), 1u);
  const Json row = finished.rows().front();
  for (const char* key :
       {"scene", "group", "params", "backend", "backend_version", "settings", "profile", "dt", "seconds", "threads",
        "status", "reason", "metrics", "time", "counts", "hash", "peak_mb", "machine"})
    EXPECT_TRUE(row.contains(key)) << key;
  EXPECT_EQ(row["scene"], "A1");
  EXPECT_EQ(row["group"], "integrator");
  EXPECT_EQ(row["status"], "ok") << row["reason"];
  for (const auto& [name, metric] : row["metrics"].items()) {
    for (const char* key : {"value", "unit", "truth", "error", "threshold", "gold", "pass"})
      EXPECT_TRUE(metric.contains(key)) << name << " " << key;
  }
  for (const char* key : {"median", "min", "max", "p99"})
    EXPECT_TRUE(row["time"]["ms_per_step"][key].is_number()) << key;
  EXPECT_EQ(row["time"]["steps"], 120);
  EXPECT_EQ(row["time"]["window"], (Json{61, 120}));
  EXPECT_TRUE(row["time"]["setup_ms"].is_number());
  EXPECT_EQ(row["counts"]["bodies"], 1);
  EXPECT_EQ(row["hash"].get<std::string>().size(), 16u);
  EXPECT_GT(row["peak_mb"].get<double>(), 1);
  EXPECT_TRUE(row["machine"].contains("cpu"));
  EXPECT_EQ(row["metrics"]["determinism"]["value"], 1);
  EXPECT_LT(row["metrics"]["energy_injected"]["value"].get<double>(), 0.1);
}

TEST(Rows, say_the_settings_in_force) {
  const Finished finished = plumb({"run", "A1", "--backend", MISBEHAVING_BACKEND, "--json", "--set", "iterations=20"});
  ASSERT_EQ(finished.rows().size(), 1u) << finished.err;
  const Json row = finished.rows().front();
  EXPECT_EQ(row["settings"]["iterations"], 20);
  EXPECT_EQ(row["settings"]["misbehaviour"], "none");
}

TEST(Rows, times_and_parameters_are_taken_from_the_command_line) {
  const Finished finished = plumb(
      {"run", "A1", "--backend", SAMPLE_BACKEND, "--json", "--param", "height=50", "--dt", "0.01", "--seconds", "1"});
  ASSERT_EQ(finished.rows().size(), 1u) << finished.err;
  const Json row = finished.rows().front();
  EXPECT_EQ(row["params"]["height"], 50);
  EXPECT_EQ(row["dt"], 0.01);
  EXPECT_EQ(row["time"]["steps"], 100);
  EXPECT_DOUBLE_EQ(row["metrics"]["drop"]["threshold"].get<double>(), 1.01 * 0.01);
}

TEST(Rows, given_parameter_merges_variants) {
  const Finished finished = plumb(
      {"run", particle_scene(fresh_folder("merge")), "--backend", SAMPLE_BACKEND, "--json", "--param", "height=50"});
  EXPECT_EQ(finished.rows().size(), 1u) << finished.err;
}

TEST(Rows, csv_has_a_header_and_a_line_a_metric) {
  const Finished finished = plumb({"run", "A1", "--backend", SAMPLE_BACKEND, "--csv"});
  EXPECT_EQ(finished.status, 0);
  EXPECT_GT(std::count(finished.out.begin(), finished.out.end(), '\n'), 2);
}

TEST(Rows, of_repetitions_take_the_worst_and_note_other_hashes) {
  Cell cell;
  cell.scene = std::make_shared<SceneFile>();
  cell.backend = std::make_shared<BackendDescription>();
  Answer first, second;
  first.json = {{"status", "ok"}, {"step_ms", {1, 2, 3}}, {"setup_ms", 1}, {"hash", "a"}};
  second.json = {{"status", "failed"}, {"reason", "x"}, {"step_ms", {4, 5}}, {"setup_ms", 2}, {"hash", "b"}};
  const Json row = to_json(make_row(cell, {first, second}, Json::object()));
  EXPECT_EQ(row["status"], "failed");
  EXPECT_EQ(row["time"]["ms_per_step"]["median"], 3);
  EXPECT_EQ(row["time"]["ms_per_step"]["max"], 5);
  EXPECT_EQ(row["metrics"]["determinism"]["value"], 0);
}

TEST(Judgement, thresholds_are_missed_by_more_by_nan_and_by_silence) {
  const auto spec = [](const char* name, bool optional = false) {
    return MetricSpec{name, "m", "", 0.1, 0.01, optional};
  };
  const auto metric = [](const char* name, double error) { return Metric{name, error, 0.0, error, std::nullopt, ""}; };
  const Judgement judgement =
      judge({metric("just", 0.1), metric("more", 0.11), metric("nan", NAN), metric("unlisted", 9)},
            {spec("just"), spec("more"), spec("nan"), spec("silent"), spec("may_be_silent", true)}, {});
  const Json rows = to_json(judgement.metrics);
  EXPECT_EQ(rows["just"]["pass"], true);
  EXPECT_EQ(rows["more"]["pass"], false);
  EXPECT_EQ(rows["nan"]["pass"], false);
  EXPECT_EQ(rows["silent"]["pass"], false);
  EXPECT_TRUE(rows["may_be_silent"]["pass"].is_null());
  EXPECT_TRUE(rows["may_be_silent"]["threshold"].is_null()) << "not scored, so that no report takes it for a miss";
  EXPECT_TRUE(rows["unlisted"]["pass"].is_null());
  ASSERT_EQ(judgement.missed.size(), 3u);
  EXPECT_EQ(judgement.missed[0], "more 0.11 > 0.1");
  EXPECT_EQ(judgement.missed[2], "silent was not measured");
}

TEST(Listings, are_one_object_a_line) {
  const Finished scenes = plumb({"scenes", "--json"});
  EXPECT_EQ(scenes.status, 0) << scenes.err;
  EXPECT_GT(scenes.rows().size(), 5u);
  for (const Json& scene : scenes.rows()) {
    for (const char* key : {"name", "needs", "parameters", "truths"}) EXPECT_TRUE(scene.contains(key)) << key;
  }
  const Finished backends = plumb({"backends", "--json", SAMPLE_BACKEND});
  ASSERT_EQ(backends.rows().size(), 1u) << backends.err;
  for (const char* key : {"name", "capabilities", "settings"}) EXPECT_TRUE(backends.rows()[0].contains(key)) << key;
}

}  // namespace
}  // namespace plumb::harness::testing
