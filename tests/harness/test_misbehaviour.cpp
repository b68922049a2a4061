// What a backend does on a bad day is one row, and the program goes on.
#include <gtest/gtest.h>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

Json row_of_misbehaviour(const std::string& misbehaviour, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run",
                                     particle_scene(fresh_folder("misbehaviour")),
                                     "--backend",
                                     MISBEHAVING_BACKEND,
                                     "--param",
                                     "height=50",
                                     "--json",
                                     "--set",
                                     "misbehaviour=" + misbehaviour};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished finished = plumb(arguments);
  EXPECT_EQ(finished.status, 0) << finished.err;
  const std::vector<Json> rows = finished.rows();
  EXPECT_EQ(rows.size(), 1u) << finished.out << finished.err;
  return rows.empty() ? Json::object() : rows.front();
}

void expect_row(const Json& row, const std::string& status, const std::string& in_reason) {
  EXPECT_EQ(row.value("status", ""), status) << row.dump();
  EXPECT_NE(row.value("reason", "").find(in_reason), std::string::npos) << row.value("reason", "");
}

TEST(Misbehaviour, none_is_ok) { expect_row(row_of_misbehaviour("none"), "ok", ""); }
TEST(Misbehaviour, segmentation_fault_names_signal_and_step) {
  const Json row = row_of_misbehaviour("segfault");
  expect_row(row, "crashed", "SIGSEGV");
  expect_row(row, "crashed", "step 10 of 50");
}
TEST(Misbehaviour, abort_names_its_signal) { expect_row(row_of_misbehaviour("abort"), "crashed", "SIGABRT"); }
TEST(Misbehaviour, exit_is_a_crash_with_its_status) { expect_row(row_of_misbehaviour("exit"), "crashed", "status 3"); }
TEST(Misbehaviour, hang_is_a_timeout) {
  expect_row(row_of_misbehaviour("hang", {"--timeout", "2"}), "timeout", "step 10");
}
TEST(Misbehaviour, eaten_memory_is_out_of_memory) {
  expect_row(row_of_misbehaviour("eat_memory", {"--memory-limit", "400"}), "out_of_memory", "limit");
}
TEST(Misbehaviour, memory_is_told_in_units_that_say_something) {
  const Json row = row_of_misbehaviour("none", {"--memory-limit", "1", "--set", "pause=0.01"});
  expect_row(row, "out_of_memory", " is above the limit of 1 MB");
  EXPECT_EQ(row.value("reason", "").find("0.00"), std::string::npos) << row["reason"];
}
TEST(Misbehaviour, exception_is_an_error_with_its_text) {
  expect_row(row_of_misbehaviour("throw"), "error", "the engine threw");
}
TEST(Misbehaviour, refusal_for_memory_is_out_of_memory) {
  expect_row(row_of_misbehaviour("refuse"), "out_of_memory", "no room for contacts");
}
TEST(Misbehaviour, garbage_on_standard_output_harms_nothing) { expect_row(row_of_misbehaviour("print"), "ok", ""); }
TEST(Misbehaviour, garbage_among_the_answers_is_an_error) {
  expect_row(row_of_misbehaviour("garble"), "error", "not JSON");
}
TEST(Misbehaviour, nan_is_counted_and_written_as_null) {
  const Json row = row_of_misbehaviour("nan");
  EXPECT_GE(row["counts"]["nonfinite"].get<int>(), 1) << row.dump();
  EXPECT_NE(row.value("status", ""), "ok") << row.dump();
}

TEST(Misbehaviour, remarks_of_steps_are_counted) {
  const Json row = row_of_misbehaviour("remark"), quiet = row_of_misbehaviour("none");
  for (const char* metric : {"solver_fallbacks", "energy_bounded", "steps_repeated"}) {
    EXPECT_EQ(row["metrics"][metric].value("value", 0.0), 1) << metric << row.dump();
    EXPECT_FALSE(quiet["metrics"].contains(metric)) << metric;
  }
}

TEST(Misbehaviour, study_goes_on_with_a_fresh_worker) {
  const Finished finished = plumb({"run", particle_scene(fresh_folder("fresh_worker")), "--backend",
                                   MISBEHAVING_BACKEND, "--json", "--set", "misbehaviour=segfault"});
  ASSERT_EQ(finished.rows().size(), 3u);
  for (const Json& row : finished.rows()) expect_row(row, "crashed", "SIGSEGV");
}

TEST(Misbehaviour, broken_library_is_one_line_of_backends) {
  for (const auto& [word, said] :
       {std::pair{"segfault_on_open", "SIGSEGV"}, {"lie_about_version", ""}, {"lie_about_size", ""}}) {
    const Finished finished =
        plumb({"backends", "--json", MISBEHAVING_BACKEND, SAMPLE_BACKEND}, {{"PLUMB_MISBEHAVE", word}});
    EXPECT_EQ(finished.status, 0) << finished.err;
    const std::vector<Json> rows = finished.rows();
    ASSERT_EQ(rows.size(), 2u) << word;
    EXPECT_NE(rows[0]["status"], "ok") << word;
    EXPECT_NE(rows[0]["reason"].get<std::string>().find(said), std::string::npos) << rows[0]["reason"];
    EXPECT_FALSE(rows[0]["reason"].get<std::string>().empty()) << word;
    EXPECT_EQ(rows[1]["status"], "ok");
  }
}

TEST(Misbehaviour, what_a_scene_needs_and_a_backend_lacks_is_unsupported) {
  const Finished finished = plumb({"run", "B1", "--backend", MISBEHAVING_BACKEND, "--json"});
  ASSERT_FALSE(finished.rows().empty()) << finished.err;
  for (const Json& row : finished.rows()) expect_row(row, "unsupported", "collision");
}

}  // namespace
}  // namespace plumb::harness::testing
