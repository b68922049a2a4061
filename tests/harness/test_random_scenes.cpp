// plumb generate writes scenes that run; plumb reduce leaves of a scene what an engine gets wrong.
#include <gtest/gtest.h>

#include <fstream>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

Json read(const std::filesystem::path& file) { return Json::parse(std::ifstream(file)); }

/// Balls that fly, joined in pairs or alone, of which the misbehaving backend refuses one: it is too large.
std::string scene_with_a_culprit(const std::filesystem::path& folder, bool joined = true) {
  Json scene = {{"id", "X7"}, {"slug", "balls"}, {"title", "Balls"}, {"doc", "Eight balls."}};
  scene["needs"] = joined ? Json{"rotation", "joints"} : Json::array();
  scene["seconds"] = 1;
  scene["shapes"]["ball"] = {{"type", "sphere"}, {"radius", 0.1}};
  scene["shapes"]["moon"] = {{"type", "sphere"}, {"radius", 2e6}};
  for (int i = 0; i < 8; ++i)
    scene["bodies"].push_back({{"name", "ball" + std::to_string(i)},
                               {"shape", i == 5 ? "moon" : "ball"},
                               {"position", {i, 10, 0}},
                               {"linear_velocity", {0, 1, 0}},
                               {"flags", {"no_rotation"}},
                               {"mass", 1}});
  for (int i = 0; joined && i < 8; i += 2)
    scene["joints"].push_back({{"name", "joint" + std::to_string(i)},
                               {"type", "ball"},
                               {"body_a", "ball" + std::to_string(i)},
                               {"body_b", "ball" + std::to_string(i + 1)},
                               {"anchor", {i + 0.5, 10, 0}}});
  scene["measure"] = {{"kind", "quantities"}, {"quantities", Json::object()}};
  scene["measure"]["quantities"]["speed"] = {{"quantity", "speed"}, {"truth", 0}};
  scene["metrics"]["speed"] = {{"unit", "m/s"}, {"doc", "of the fastest"}, {"threshold", 100}};
  const std::filesystem::path file = folder / "balls.json";
  std::ofstream(file) << scene;
  return file.string();
}

TEST(Reduce, LeavesTheCulprit) {
  const std::filesystem::path folder = fresh_folder("reduce");
  const std::string whole = scene_with_a_culprit(folder), small = (folder / "small.json").string();
  const Finished run = plumb({"reduce", whole, small, "--backend", MISBEHAVING_BACKEND});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("1 body, 0 joints"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("8 bodies, 4 joints"), std::string::npos) << run.err;
  const Json left = read(small);
  EXPECT_EQ(left.at("id"), "X7r");
  ASSERT_EQ(left.at("bodies").size(), 1u);
  EXPECT_EQ(left.at("bodies")[0].at("name"), "ball5");
  EXPECT_FALSE(left.at("bodies")[0].contains("linear_velocity"));
  EXPECT_EQ(left.at("shapes").size(), 1u);
  EXPECT_LT(left.at("seconds").get<double>(), 0.05);
  const Finished again = plumb({"run", small, "--backend", MISBEHAVING_BACKEND, "--json"});
  EXPECT_EQ(again.rows().at(0).at("status"), "error") << "it is a scene, and as wrong as the whole";
}

/// Where another backend has to get right what is left, nobody is asked what it gets wrong itself.
TEST(Reduce, AsksWhoGetsItRight) {
  const std::filesystem::path folder = fresh_folder("reduce-against");
  const std::string whole = scene_with_a_culprit(folder), small = (folder / "small.json").string();
  const Finished alike =
      plumb({"reduce", whole, small, "--backend", MISBEHAVING_BACKEND, "--against", MISBEHAVING_BACKEND});
  EXPECT_EQ(alike.status, 2);
  EXPECT_NE(alike.err.find("it gets the scene wrong, too"), std::string::npos) << alike.err;
  EXPECT_FALSE(std::filesystem::exists(small));
  const std::string loose = scene_with_a_culprit(folder, false);
  const Finished run = plumb({"reduce", loose, small, "--backend", MISBEHAVING_BACKEND, "--against", SAMPLE_BACKEND,
                              "--set", "iterations=20"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read(small).at("bodies").size(), 1u) << "with a setting that the other does not have";
}

/// A worker that dies is an answer like others.
TEST(Reduce, LeavesWhatCrashes) {
  const std::filesystem::path folder = fresh_folder("reduce-crash");
  const std::string small = (folder / "small.json").string();
  const Finished run = plumb(
      {"reduce", particle_scene(folder), small, "--backend", MISBEHAVING_BACKEND, "--set", "misbehaviour=segfault"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("crashed"), std::string::npos) << run.out;
  EXPECT_EQ(read(small).at("bodies").size(), 1u);
}

/// Whatever the metrics say: an engine may put such a body back and go on.
TEST(Reduce, LeavesWhatBecomesNoNumber) {
  const std::filesystem::path folder = fresh_folder("reduce-nan");
  const std::string small = (folder / "small.json").string();
  const Finished run =
      plumb({"reduce", particle_scene(folder), small, "--backend", MISBEHAVING_BACKEND, "--set", "misbehaviour=nan"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("became NaN or infinite"), std::string::npos) << run.out;
  EXPECT_EQ(read(small).at("bodies").size(), 1u);
}

TEST(Reduce, SaysWhatIsAskedWrongly) {
  const std::filesystem::path folder = fresh_folder("reduce-wrong");
  const std::string scene = particle_scene(folder), small = (folder / "small.json").string();
  const auto expect = [&](const std::vector<std::string>& arguments, const std::string& words) {
    const Finished run = plumb(arguments);
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(small)) << "nothing half done";
  };
  expect({"reduce", scene, small, "--backend", MISBEHAVING_BACKEND}, "there is nothing to reduce");
  expect({"reduce", scene, small, "--backend", "nobody"}, "there is no backend \"nobody\"");
  expect({"reduce", scene, (folder / "small.txt").string(), "--backend", MISBEHAVING_BACKEND}, "ends with .json");
  expect({"reduce", scene, "/nowhere/small.json", "--backend", MISBEHAVING_BACKEND}, "cannot write /nowhere");
  expect({"reduce", "stacking", small, "--backend", MISBEHAVING_BACKEND}, "names several scenes");
  expect({"reduce", "D1", small, "--backend", MISBEHAVING_BACKEND}, "lacks what the scene needs");
  expect({"reduce", scene, small, "--backend", MISBEHAVING_BACKEND, "--metric", "sped"}, "--metric sped");
}

TEST(Generate, WritesScenesThatRun) {
  const std::filesystem::path folder = fresh_folder("generate") / "new" / "one";
  const Finished made = plumb({"generate", folder.string(), "--seeds", "3-5", "--seconds", "0.1", "--dt", "1/240"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find("3 scenes in"), std::string::npos) << made.out;
  EXPECT_NEAR(read(folder / "R3-random.json").at("dt").get<double>(), 1.0 / 240, 1e-12);
  for (const char* name : {"R3-random.json", "R4-random.json", "R5-random.json"}) {
    const Finished run = plumb({"run", (folder / name).string(), "--backend", SAMPLE_BACKEND, "--json"});
    ASSERT_EQ(run.rows().size(), 1u) << run.err;
    EXPECT_EQ(run.rows()[0].at("status"), "unsupported") << "it has no collision";
  }
}

TEST(Generate, SaysWhatIsAskedWrongly) {
  const std::filesystem::path folder = fresh_folder("generate-wrong");
  std::ofstream(folder / "file") << "no folder";
  const auto expect = [&](const std::vector<std::string>& arguments, const std::string& words) {
    const Finished run = plumb(arguments);
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "new")) << "nothing half done";
  };
  const std::string to = (folder / "new").string();
  expect({"generate", to, "--seeds", "5-3"}, "the last is before the first");
  expect({"generate", to, "--seeds", "a"}, "--seeds \"a\": name a seed");
  expect({"generate", to, "--seeds", "1-9999999"}, "name a seed from 0 to 999999");
  expect({"generate", to, "--without", "loop"}, "did you mean");
  expect({"generate", to, "--bodies", "1"}, "must be a whole number from 2 to 10000");
  expect({"generate", to, "--ratio", "0.5"}, "must be a number from 1");
  expect({"generate", to, "--dt", "0"}, "must be a number above 0");
  expect({"generate", to, "--dt", "1e-12"}, "a step is from 1e-09 to");
  expect({"generate", to, "--seconds", "1e7"}, "there are 1e+07 at most");
  expect({"generate", (folder / "file" / "below").string()}, "cannot make");
}

}  // namespace
}  // namespace plumb::harness::testing
