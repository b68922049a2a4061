// What the harness takes to judge is not the engine's time: it has a limit of its own, and a name. So has what cannot
// be judged because too little time was asked for.
#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "program.hpp"
#include "simulation/cell_clock.hpp"

namespace plumb::harness::testing {
namespace {

/// A particle that falls for an hour in a few steps, and a truth that is integrated over all of it, which takes the
/// referee a second or more.
std::string slowly_judged_scene() {
  const std::filesystem::path file = fresh_folder("clock") / "T2-slow-truth.json";
  std::ofstream(file) << R"({
  "id": "T2", "slug": "slow-truth", "title": "A slow truth", "doc": "It takes longer to know than to do.",
  "needs": [], "dt": 40, "seconds": 4000,
  "bodies": [{ "name": "bob", "position": [0.8, -0.6, 0], "linear_velocity": [0, 0, 1], "mass": 1,
               "flags": ["no_rotation"] }],
  "measure": { "kind": "spherical_pendulum", "body": "bob", "length": 1, "tilt": 0.9, "rate": 1.5 },
  "metrics": { "cycle": { "unit": "s", "doc": "of its tilt; what falls has none", "threshold": 1 } }
})";
  return file.string();
}

Json row_with(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"run", slowly_judged_scene(), "--backend", MISBEHAVING_BACKEND, "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished finished = plumb(arguments);
  EXPECT_EQ(finished.status, 0) << finished.err;
  return finished.rows().size() == 1 ? finished.rows().front() : Json::object();
}

TEST(CellClock, a_slow_referee_is_no_timeout_of_the_engine) {
  Json row = row_with({"--timeout", "0.3"});
  EXPECT_EQ(row.value("status", ""), "failed") << row.dump();
  EXPECT_EQ(row.value("reason", ""), "cycle was not measured");
  EXPECT_GT(row["time"]["wall_s"].get<double>(), 0.5) << "too fast to tell: make the truth dearer";
}

TEST(CellClock, a_slow_engine_is_a_timeout_whatever_the_referee_may_take) {
  Json row = row_with({"--timeout", "0.5", "--judge-timeout", "60", "--set", "pause=0.01"});
  EXPECT_EQ(row.value("status", ""), "timeout") << row.dump();
  EXPECT_NE(row.value("reason", "").find("within 0.5 s, in step "), std::string::npos) << row.dump();
}

TEST(CellClock, a_referee_beyond_its_own_limit_leaves_the_cell_unjudged) {
  Json row = row_with({"--judge-timeout", "0.2"});
  EXPECT_EQ(row.value("status", ""), "unjudged") << row.dump();
  EXPECT_NE(row.value("reason", "").find("the referee has no answer within 0.2 s"), std::string::npos) << row.dump();
}

TEST(Unjudged, is_what_less_time_than_the_scene_takes_did_not_measure) {
  Json row = row_with({"--seconds", "40"});
  EXPECT_EQ(row.value("status", ""), "unjudged") << row.dump();
  EXPECT_EQ(row.value("reason", ""), "40 s are too short to measure cycle: the scene takes 4000 s");
  EXPECT_TRUE(row["metrics"]["cycle"]["threshold"].is_null()) << "no report is to take it for a miss";
}

TEST(CellClock, tells_the_two_apart) {
  const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); };
  CellClock clock;
  clock.start();
  pause();
  clock.judge();
  pause();
  pause();
  { const EngineAtWork at_work(&clock); }
  const CellClock::Times times = clock.times();
  EXPECT_GE(times.engine, 20'000'000u);
  EXPECT_GE(times.judge, 40'000'000u);
  EXPECT_LT(times.engine, times.judge);
  EXPECT_TRUE(times.judging);
  clock.start();
  EXPECT_LT(clock.times().engine, 20'000'000u) << "each request starts anew";
}

}  // namespace
}  // namespace plumb::harness::testing
