// plumb run --timeline writes what trace viewers open: calls, steps and phases, also of a run that came to a bad end.
#include <gtest/gtest.h>

#include <fstream>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

Finished run_with_timeline(const std::filesystem::path& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{
      "run",   particle_scene(folder),   "--backend", MISBEHAVING_BACKEND, "--timeline", "--json",
      "--out", (folder / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return plumb(arguments);
}

/// The events of each file; throws for what is no JSON.
std::vector<Json> timelines(const std::filesystem::path& folder) {
  std::vector<Json> all;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out" / "timelines")) {
    EXPECT_EQ(entry.path().extension(), ".json");
    all.push_back(Json::parse(std::ifstream(entry.path())).at("traceEvents"));
  }
  return all;
}

std::size_t zones(const Json& events, const std::string& name) {
  std::size_t count = 0;
  for (const Json& event : events) count += event.at("ph") == "X" && event.at("name") == name;
  return count;
}

TEST(Timeline, of_a_run_has_its_calls_steps_and_phases) {
  const std::filesystem::path folder = fresh_folder("timeline");
  const Finished run = run_with_timeline(folder, {});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::vector<Json> cells = timelines(folder);
  ASSERT_EQ(cells.size(), 3u) << "one a cell";
  for (const Json& events : cells) {
    const std::size_t waits = zones(events, "wait");
    EXPECT_GE(waits, 50u) << "0.5 s by 0.01";
    EXPECT_EQ(zones(events, "step"), 2 * waits) << "the call, and the step until its wait is over";
    EXPECT_EQ(zones(events, "integrate"), waits);
    EXPECT_EQ(zones(events, "create_world"), zones(events, "destroy_world"));
  }
}

TEST(Timeline, goes_with_a_trace) {
  const std::filesystem::path folder = fresh_folder("timeline_and_trace");
  const Finished run = run_with_timeline(folder, {"--trace", "--param", "height=10"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err.find("could not be written"), std::string::npos) << run.err;
  EXPECT_EQ(timelines(folder).size(), 1u);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out" / "traces")) {
    const Finished replay = plumb({"replay", entry.path().string(), "--backend", MISBEHAVING_BACKEND, "--json"});
    EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
  }
}

TEST(Timeline, of_a_worker_that_died_is_whole) {
  for (const char* end : {"segfault", "hang"}) {
    const std::filesystem::path folder = fresh_folder(std::string("timeline_") + end);
    const Finished run = run_with_timeline(folder, {"--param", "height=10", "--timeout", "1", "--set", "pause=0.02",
                                                    "--set", std::string("misbehaviour=") + end});
    ASSERT_EQ(run.rows().size(), 1u) << run.err;
    EXPECT_NE(run.rows()[0]["status"], "ok") << end;
    const std::vector<Json> cells = timelines(folder);
    ASSERT_EQ(cells.size(), 1u) << end;
    EXPECT_GE(zones(cells[0], "wait"), 3u) << end << ": it had 9 steps of 20 ms, of which the last 50 ms may be lost";
  }
}

TEST(Timeline, needs_a_folder) {
  const Finished run = plumb({"run", "A1", "--timeline"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--timeline"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("--out"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace plumb::harness::testing
