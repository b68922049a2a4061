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

/// A scene of three particles, one of them still, with the shapes or joints of line 5.
std::string scene_with_parts(const std::string& name, const std::string& parts) {
  const std::filesystem::path file = fresh_folder(name) / "X1-wrong.json";
  std::ofstream(file) << R"({
  "id": "X1", "slug": "wrong", "title": "Wrong", "doc": "Something is wrong with its parts.",
  "parameters": { "size": { "default": 1, "unit": "m", "doc": "of a part" } },
  "needs": ["joints"], "dt": 0.01, "seconds": 0.1,
)" << parts << R"(,
  "bodies": [{ "name": "p", "mass": 1, "flags": ["no_rotation"] }, { "name": "q", "mass": 1, "flags": ["no_rotation"] },
    { "name": "still", "motion": "static" }],
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

TEST(WrongScenes, shapes_and_joints_that_a_parameter_makes_wrong_are_refused_by_line_and_key) {
  const std::string shapes = scene_with_parts("shapes", R"("shapes": { "a": { "type": "sphere", "radius": 1 },
    "b": { "type": "sphere", "radius": "size / 2" } })");
  const std::string limits = scene_with_parts("limits", R"("joints": [{ "name": "a", "type": "ball", "body_b": "p" },
    { "name": "b", "type": "hinge", "body_b": "q", "limits": { "rx": { "lower": "1 - size", "upper": 0 } } }])");
  EXPECT_EQ(run(shapes).status, 0);
  EXPECT_EQ(run(limits).status, 0);
  Finished finished = run(shapes, {"--param", "size=-1"});
  EXPECT_EQ(finished.status, 2) << finished.out;
  EXPECT_EQ(finished.err, "plumb: " + shapes + ":6: shapes.b.radius: radius is -0.5; it must be finite and above 0\n");
  finished = run(limits, {"--param", "size=-1"});
  EXPECT_EQ(finished.status, 2) << finished.out;
  EXPECT_EQ(finished.err,
            "plumb: " + limits + ":6: joints[1].limits.rx: lower is 2; it must be not above the upper limit\n");
}

/// Whether an engine or the guard before it refuses a part, its row is an error that begins with these words.
void expect_told(const std::string& scene, const std::vector<std::string>& more, const std::string& words) {
  const Finished finished = run(scene, more);
  EXPECT_EQ(finished.status, 0) << finished.err;
  ASSERT_EQ(finished.rows().size(), 1u);
  EXPECT_EQ(finished.rows()[0]["status"], "error");
  EXPECT_EQ(finished.rows()[0]["reason"].get<std::string>().find("invalid argument: " + scene + words), 0u)
      << finished.rows()[0]["reason"];
}

TEST(WrongScenes, shapes_that_an_engine_refuses_are_told_by_the_scenes_name_and_line) {
  const std::string scene = scene_with_parts("engine_shapes", R"("shapes": { "a": { "type": "sphere", "radius": 1 },
    "b": { "type": "sphere", "radius": "size" },
    "c": { "type": "convex_hull", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, "min(size, 3) - 2"]] } })");
  expect_told(scene, {"--param", "size=1e7"}, ":6: shape \"b\": radius is beyond this engine");
  expect_told(scene, {"--param", "size=2"}, ":7: shape \"c\": vertices: convex hull: all 4 points lie in one plane");
}

TEST(WrongScenes, joints_that_an_engine_refuses_are_told_by_the_scenes_name_and_line) {
  const std::string limits =
      scene_with_parts("engine_limits", R"("joints": [{ "name": "a", "type": "ball", "body_b": "p" },
    { "name": "b{i}", "repeat": { "i": 2 }, "type": "hinge", "body_b": "q",
      "limits": { "rx": { "lower": 0, "upper": "size + size * i" } } }])");
  expect_told(limits, {"--param", "size=8e6"}, ":6: joint \"b1\": limits[3] are beyond this engine");
  const std::string still =
      scene_with_parts("still_joint", R"("joints": [{ "name": "a", "type": "ball", "body_b": "p" },
    { "name": "b", "type": "ball", "body_b": "still" }])");
  expect_told(still, {}, ":6: joint \"b\": joins two bodies that nothing can move");
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
