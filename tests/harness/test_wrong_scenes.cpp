// A scene that is wrong is a wrong question, whoever finds it; what an engine refuses is told in the scene's own words.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

/// A scene of particles whose body, on line 4, is the given one.
std::string scene_with(const std::string& name, const std::string& body) {
  const std::filesystem::path file = fresh_folder(name) / "X1-wrong.json";
  std::ofstream(file) << R"({
  "id": "X1", "slug": "wrong", "title": "Wrong", "doc": "Something is wrong with its body.",
  "needs": [], "dt": 0.01, "seconds": 0.1, "bodies": [{ "name": "p", "mass": 1, "flags": ["no_rotation"] },
)" << body << R"(],
  "measure": { "kind": "free_fall", "body": "p" },
  "metrics": {}
})";
  return file.string();
}

Finished run(const std::string& scene, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"run", scene, "--backend", MISBEHAVING_BACKEND, "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return plumb(arguments);
}

TEST(WrongScenes, a_value_that_no_engine_takes_is_refused_by_line_and_key) {
  const std::string scene = scene_with("density", R"({ "name": "q", "density": -1, "flags": ["no_rotation"] })");
  const Finished finished = run(scene);
  EXPECT_EQ(finished.status, 2) << finished.out;
  EXPECT_EQ(finished.err.find("plumb: " + scene + ":4: bodies[1]"), 0u) << finished.err;
  EXPECT_EQ(finished.out, "");
}

TEST(WrongScenes, what_only_the_worker_finds_is_no_row) {
  // Of so many bodies the program makes none by itself.
  const std::string scene = scene_with("worker", R"({ "name": "q{i}", "repeat": { "i": 120000 }, "mass": "119000 - i",
    "flags": ["no_rotation"] })");
  const Finished finished = run(scene);
  EXPECT_EQ(finished.status, 2) << finished.out;
  EXPECT_EQ(finished.err.find("plumb: " + scene + ":4: bodies[1].mass: "), 0u) << finished.err;
  EXPECT_EQ(finished.out, "");
}

TEST(WrongScenes, what_an_engine_refuses_is_told_by_the_scenes_name_and_line) {
  const std::string scene = scene_with("engine", R"({ "name": "q{i}", "repeat": { "i": 3 }, "mass": "1 + i * 8e11",
    "flags": ["no_rotation"] })");
  const Finished finished = run(scene);
  EXPECT_EQ(finished.status, 0) << finished.err;
  ASSERT_EQ(finished.rows().size(), 1u);
  EXPECT_EQ(finished.rows()[0]["status"], "error");
  EXPECT_EQ(finished.rows()[0]["reason"], "invalid argument: " + scene + ":4: body \"q2\": mass is beyond this engine");
}

TEST(WrongScenes, two_million_bodies_are_cut_by_the_time_that_was_given) {
  const std::string scene = scene_with("many", R"({ "name": "q{i}", "repeat": { "i": 1900000 }, "mass": 1,
    "flags": ["no_rotation"] })");
  const auto start = std::chrono::steady_clock::now();
  const Finished finished = run(scene, {"--timeout", "1"});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(finished.rows().size(), 1u) << finished.err;
  EXPECT_EQ(finished.rows()[0]["status"], "timeout") << finished.rows()[0]["reason"];
  EXPECT_LT(took.count(), 8) << "nothing may be made of them before the clock runs";
}

}  // namespace
}  // namespace plumb::harness::testing
