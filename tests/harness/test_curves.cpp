// Sweeps: which cells they have, and which of them need not run.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cell/sweep.hpp"
#include "program.hpp"

namespace plumb::harness::testing {
namespace {

SettingDescription number(const char* name, const char* type, double least, double most, const Json& standard) {
  SettingDescription setting;
  setting.name = name;
  setting.type = type;
  setting.role = "quality";
  setting.minimum = least;
  setting.maximum = most;
  setting.default_value = standard;
  return setting;
}

BackendDescription backend_with(const std::vector<SettingDescription>& settings) {
  BackendDescription backend;
  backend.name = "engine";
  backend.settings = settings;
  return backend;
}

/// Values that the only knob of a backend takes.
std::vector<double> rungs(const SettingDescription& knob, const std::vector<std::string>& along = {},
                          const Json& asked = Json::object()) {
  Sweep sweep;
  for (const std::string& argument : along) sweep.along.push_back(parse_sweep_axis("--along", argument));
  std::vector<double> values;
  for (const Json& settings : swept_settings(backend_with({knob}), asked, sweep, {}).settings)
    values.push_back(settings.value(knob.name, knob.default_value.get<double>()));
  std::sort(values.begin(), values.end());
  return values;
}

using Values = std::vector<double>;

TEST(Sweeps, ladders_halve_and_double_about_the_value_in_force) {
  EXPECT_EQ(rungs(number("k", "int", 1, 1000, 10)), (Values{2, 5, 10, 20, 40}));
  EXPECT_EQ(rungs(number("k", "int", 1, 1000, 10), {}, {{"k", 24}}), (Values{6, 12, 24, 48, 96}));
  EXPECT_EQ(rungs(number("k", "float", 0, 10, 0.5), {"k"}), (Values{0.125, 0.25, 0.5, 1, 2}));
}
TEST(Sweeps, ladders_stay_in_range_and_grow_on_the_other_side) {
  EXPECT_EQ(rungs(number("k", "int", 1, 1000, 1)), (Values{1, 2, 4, 8, 16}));
  EXPECT_EQ(rungs(number("k", "int", 0, 1000, 2)), (Values{1, 2, 4, 8, 16}));
  EXPECT_EQ(rungs(number("k", "int", 1, 100, 100)), (Values{6, 12, 25, 50, 100}));
  EXPECT_EQ(rungs(number("k", "int", 1, 2, 1)), (Values{1, 2}));
}
TEST(Sweeps, named_values_join_the_one_in_force) {
  EXPECT_EQ(rungs(number("k", "int", 1, 1000, 10), {"k=40,3"}), (Values{3, 10, 40}));
  EXPECT_EQ(rungs(number("k", "int", 1, 1000, 10), {"k=10,40"}), (Values{10, 40}));
}
TEST(Sweeps, knobs_that_nobody_named_are_whole_numbers_above_zero) {
  EXPECT_EQ(rungs(number("k", "float", 0, 10, 0.5)), (Values{0.5}));
  EXPECT_EQ(rungs(number("k", "int", 0, 10, 0)), (Values{0}));
  EXPECT_THROW((void)rungs(number("k", "int", 0, 10, 0), {"k"}), std::runtime_error);
}

TEST(Sweeps, methods_are_crossed_and_have_a_ladder_each) {
  SettingDescription colour = number("colour", "choice", 0, 0, "red");
  colour.role = "behaviour";
  colour.choices = {"red", "green"};
  SettingDescription fast = number("fast", "bool", 0, 0, false);
  fast.role = "behaviour";
  Sweep sweep;
  sweep.over = {parse_sweep_axis("--over", "colour"), parse_sweep_axis("--over", "engine:fast")};
  const SweptSettings swept =
      swept_settings(backend_with({colour, fast, number("k", "int", 1, 9, 4)}), Json::object(), sweep, {});
  ASSERT_EQ(swept.ladders.size(), 4u);
  EXPECT_EQ(swept.settings.size(), 4 * 4u) << "1, 2, 4, 8";
  EXPECT_EQ(swept.settings.front(), Json::object()) << "what is in force anyway is not asked for";
  for (const Ladder& ladder : swept.ladders) {
    EXPECT_FALSE(swept.settings[ladder.base].contains("k"));
    EXPECT_EQ(swept.settings[ladder.probe]["k"], 1) << "farthest below the base";
    EXPECT_EQ(ladder.others.size(), 2u);
  }
  EXPECT_EQ(swept_settings(backend_with({number("k", "int", 1, 9, 1)}), Json::object(), {}, {}).ladders.front().probe,
            3u)
      << "above it where there is no below: 1, 2, 4, 8";
  EXPECT_EQ(swept.settings[swept.ladders.back().probe], (Json{{"colour", "green"}, {"fast", true}, {"k", 1}}));
}

std::vector<std::string> curves(const std::vector<std::string>& more, const std::string& out = "") {
  std::vector<std::string> arguments{"curves", "A1", "--backend", MISBEHAVING_BACKEND, "--repeat", "2", "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::vector<double> values_of(const std::vector<Json>& rows, const char* setting) {
  std::vector<double> values;
  for (const Json& row : rows) values.push_back(row["settings"][setting]);
  std::sort(values.begin(), values.end());
  return values;
}

TEST(Curves, leave_out_the_ladder_of_a_knob_that_does_nothing) {
  const Finished finished = plumb(curves({"--json"}));
  ASSERT_EQ(finished.status, 0) << finished.err;
  const std::vector<Json> rows = finished.rows();
  EXPECT_EQ(values_of(rows, "substeps"), (Values{1, 1, 2, 4, 8, 16}));
  EXPECT_EQ(values_of(rows, "iterations"), (Values{2, 10, 10, 10, 10, 10})) << "the probe stays";
  for (const Json& row : rows) EXPECT_EQ(row["repeats"], 2);
}

TEST(Curves, have_error_and_time_of_the_same_cell_and_say_what_is_a_knob) {
  const std::vector<Json> rows = plumb(curves({"--along", "substeps=4", "--json"})).rows();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["defaults"], Json::object());
  EXPECT_EQ(rows[1]["defaults"], (Json{{"substeps", 1}}));
  EXPECT_EQ(rows[1]["knobs"], (Json{"iterations", "substeps"}));
  EXPECT_NEAR(rows[0]["metrics"]["drop"]["error"].get<double>(), 4 * rows[1]["metrics"]["drop"]["error"].get<double>(),
              1e-6);
  EXPECT_GT(rows[1]["time"]["ms_per_step"]["median"].get<double>(), 0);
}

TEST(Curves, have_a_method_for_each_value_of_the_setting_they_are_over) {
  const std::vector<Json> rows = plumb(curves({"--over", "misbehaviour=none,throw", "--json"})).rows();
  const auto thrown = std::count_if(rows.begin(), rows.end(), [](const Json& row) { return row["status"] == "error"; });
  EXPECT_EQ(rows.size() - static_cast<std::size_t>(thrown), 6u);
  EXPECT_EQ(thrown, 6);
}

TEST(Curves, leave_a_knob_alone_that_was_set) {
  const std::vector<Json> rows = plumb(curves({"--set", "substeps=2", "--json"})).rows();
  EXPECT_EQ(values_of(rows, "substeps"), (Values{2, 2}));
}

TEST(Curves, stop_at_the_base_of_what_is_unsupported) {
  std::vector<std::string> arguments = curves({"--param", "H=10", "--json"});
  arguments[1] = "D1";
  const std::vector<Json> rows = plumb(arguments).rows();
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["status"], "unsupported");
  EXPECT_EQ(rows[0]["settings"]["substeps"], 1) << "what a world would have started with";
}

TEST(Curves, share_cells_with_other_runs_and_go_on_where_they_were) {
  const std::string out = (fresh_folder("curves") / "out").string();
  ASSERT_EQ(plumb({"run", "A1", "--backend", MISBEHAVING_BACKEND, "--out", out}).status, 0);
  const Finished first = plumb(curves({}, out));
  EXPECT_NE(first.err.find("1 cells were finished already"), std::string::npos) << first.err;
  const Finished again = plumb(curves({}, out));
  EXPECT_NE(again.err.find("6 cells were finished already"), std::string::npos) << again.err;
}

}  // namespace
}  // namespace plumb::harness::testing
