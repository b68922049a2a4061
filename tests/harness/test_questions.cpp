// Wrong questions: one clear line with the nearest right word, and status 2.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

void expect_refusal(const std::vector<std::string>& arguments, const std::string& in_text) {
  const Finished finished = plumb(arguments);
  EXPECT_EQ(finished.status, 2) << finished.out;
  EXPECT_NE(finished.err.find(in_text), std::string::npos) << finished.err;
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  EXPECT_EQ(finished.out, "");
}

const std::vector<std::string> a1{"run", "A1", "--backend", MISBEHAVING_BACKEND};

std::vector<std::string> a1_with(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = a1;
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Questions, misspelt_verb) { expect_refusal({"comapre", "A1"}, "\"compare\""); }
TEST(Questions, misspelt_scene) { expect_refusal({"run", "free-fal", "--backend", MISBEHAVING_BACKEND}, "free-fall"); }
TEST(Questions, misspelt_backend) {
  expect_refusal({"run", "A1", "--backend", "no_such_backend_at_all"}, "no_such_backend_at_all");
}
TEST(Questions, backend_file_that_is_not_there) {
  expect_refusal({"run", "A1", "--backend", "./nowhere.so"}, "no such file");
}
TEST(Questions, misspelt_parameter) { expect_refusal(a1_with({"--param", "heigth=50"}), "\"height\""); }
TEST(Questions, parameter_out_of_range) { expect_refusal(a1_with({"--param", "height=-3"}), "height"); }
TEST(Questions, misspelt_unit) { expect_refusal(a1_with({"--param", "height=50 centimetre"}), "centimetre"); }
TEST(Questions, misspelt_setting) { expect_refusal(a1_with({"--set", "iteratons=20"}), "\"iterations\""); }
TEST(Questions, setting_of_a_backend_that_is_not_there) {
  expect_refusal(a1_with({"--set", "misbehavin:iterations=20"}), "\"misbehaving\"");
}
TEST(Questions, setting_out_of_range) { expect_refusal(a1_with({"--set", "iterations=1000"}), "from 1 to 100"); }
TEST(Questions, setting_that_is_not_whole) { expect_refusal(a1_with({"--set", "iterations=1.5"}), "whole"); }
TEST(Questions, misspelt_choice) { expect_refusal(a1_with({"--set", "misbehaviour=segfalt"}), "\"segfault\""); }
TEST(Questions, misspelt_profile) { expect_refusal(a1_with({"--profile", "matchd"}), "\"matched\""); }
TEST(Questions, misspelt_flag) { expect_refusal(a1_with({"--repeats", "3"}), "\"--repeat\""); }
TEST(Questions, flag_value_of_the_wrong_type) { expect_refusal(a1_with({"--repeat", "often"}), "--repeat"); }
TEST(Questions, step_that_is_no_number) { expect_refusal(a1_with({"--dt", "1/x"}), "1/x"); }
TEST(Questions, step_as_a_fraction_is_one) {
  const Finished finished = plumb(a1_with({"--dt", "1/240", "--json"}));
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(Json::parse(finished.out)["dt"], 1.0 / 240);
}
TEST(Questions, negative_step) { expect_refusal(a1_with({"--dt", "-1"}), "--dt"); }
TEST(Questions, tuned_profile_without_a_file) { expect_refusal(a1_with({"--profile", "tuned"}), "tuned.json"); }
TEST(Questions, record_without_a_folder) { expect_refusal(a1_with({"--record"}), "--out"); }

std::vector<std::string> curves_with(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = a1_with(more);
  arguments.front() = "curves";
  return arguments;
}

TEST(Questions, pairs_of_a_backend_that_is_not_there) {
  expect_refusal({"pairs", "--backend", "nope"}, "there is no backend \"nope\"");
  expect_refusal({"pairs", "nope"}, "there is no backend \"nope\"");
}
TEST(Questions, number_of_a_step_below_0) {
  expect_refusal({"problem", "D7", "--step", "-1", "--out", "never.hdf5"}, "--step: must be a whole number from 0");
  expect_refusal({"problem", "D7", "--step", "1.5", "--out", "never.hdf5"}, "not \"1.5\"");
}
TEST(Questions, long_ones_are_cut_short_in_the_answer) {
  const std::string chatter(40000, 'x');
  std::string prose;
  for (int i = 0; i < 8000; ++i) prose += "word ";
  for (const std::string& text : {chatter, "--" + chatter, prose}) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{text},
                                                      {"run", text},
                                                      a1_with({"--param", text + "=1"}),
                                                      a1_with({text}),
                                                      a1_with({"--set", text}),
                                                      a1_with({"--dt", text}),
                                                      a1_with({"--profile", text}),
                                                      {"report", text},
                                                      {"study", text},
                                                      {"measures", text}}) {
      const Finished finished = plumb(arguments);
      EXPECT_EQ(finished.status, 2) << arguments.front().substr(0, 20);
      EXPECT_LT(finished.err.size(), 2000u) << arguments.front().substr(0, 20);
      EXPECT_FALSE(finished.err.empty());
    }
  }
}
TEST(Questions, degrees_are_called_deg) { expect_refusal(a1_with({"--dt", "degrees(1)"}), "deg(x)"); }
TEST(Questions, judge_timeout_of_nothing) { expect_refusal(a1_with({"--judge-timeout", "0"}), "--judge-timeout"); }

TEST(Questions, misspelt_setting_of_a_sweep) {
  expect_refusal(curves_with({"--over", "misbehavior"}), "\"misbehaviour\"");
  expect_refusal(curves_with({"--along", "substep"}), "\"substeps\"");
  expect_refusal(curves_with({"--over", "misbehavin:misbehaviour"}), "\"misbehaving\"");
}
TEST(Questions, misspelt_value_of_a_sweep) {
  expect_refusal(curves_with({"--over", "misbehaviour=none,segfalt"}), "\"segfault\"");
  expect_refusal(curves_with({"--along", "substeps=1,1000"}), "from 1 to 64");
}
TEST(Questions, sweep_over_numbers_that_nobody_named) {
  expect_refusal(curves_with({"--over", "pause"}), "--over pause=");
}
TEST(Questions, sweep_along_what_is_no_knob) {
  expect_refusal(curves_with({"--along", "pause"}), "role speed");
  expect_refusal(curves_with({"--along", "misbehaviour"}), "--over misbehaviour");
}
TEST(Questions, sweep_of_what_is_held_or_turned_already) {
  expect_refusal(curves_with({"--along", "substeps", "--set", "substeps=2"}), "--set substeps");
  expect_refusal(curves_with({"--over", "substeps=1,2", "--along", "substeps"}), "--over turns it already");
}
TEST(Questions, malformed_sweep) {
  for (const char* word : {"=1", "substeps=", "substeps=1,,2", ":substeps"})
    expect_refusal(curves_with({"--along", word}), "name=value,value");
}

TEST(Questions, broken_scene_file_names_file_and_key) {
  const std::filesystem::path folder = fresh_folder("broken_scene");
  std::ofstream(folder / "X1-broken.json")
      << "{\n  \"id\": \"X1\",\n  \"slug\": \"broken\",\n  \"titel\": \"Broken\"\n}\n";
  expect_refusal({"run", (folder / "X1-broken.json").string(), "--backend", MISBEHAVING_BACKEND}, "X1-broken.json");
}

TEST(Questions, strict_makes_a_missed_threshold_status_1) {
  EXPECT_EQ(plumb(a1_with({"--set", "misbehaviour=nan"})).status, 0);
  EXPECT_EQ(plumb(a1_with({"--set", "misbehaviour=nan", "--strict"})).status, 1);
  EXPECT_EQ(plumb(a1_with({"--strict"})).status, 0);
}

}  // namespace
}  // namespace plumb::harness::testing
