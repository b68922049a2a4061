// plumb convert makes scenes that run of what others wrote, and says what is asked wrongly.
#include <gtest/gtest.h>

#include <fstream>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

constexpr const char* ball = R"(<sdf version="1.7"><model name="m"><pose>0 0 2 0 0 0</pose><link name="ball">
  <inertial><mass>2</mass><inertia><ixx>0.2</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.5</radius></sphere></geometry></collision></link></model></sdf>)";

/// Whether the program was built with libsdformat.
bool reads_sdf(const std::filesystem::path& folder) {
  std::ofstream(folder / "ball.sdf") << ball;
  const Finished run = plumb({"convert", (folder / "ball.sdf").string(), (folder / "ball.json").string()});
  EXPECT_TRUE(run.status == 0 || run.err.find("install libsdformat-dev") != std::string::npos) << run.err;
  return run.status == 0;
}

TEST(Convert, MakesASceneOfWhatOthersWrote) {
  const std::filesystem::path folder = fresh_folder("convert");
  if (!reads_sdf(folder)) GTEST_SKIP() << "built without libsdformat";
  const std::string scene = (folder / "ball.json").string();
  const Finished made =
      plumb({"convert", (folder / "ball.sdf").string(), scene, "--ground", "--seconds", "0.5", "--dt", "0.01"});
  EXPECT_EQ(made.out, scene + ": 2 bodies, 0 joints, 2 shapes\n");
  const Finished sheet = plumb({"scenes", scene});
  EXPECT_EQ(sheet.status, 0) << sheet.err;
  EXPECT_NE(sheet.out.find("overlap"), std::string::npos) << sheet.out;
  EXPECT_NE(sheet.out.find("plumb run " + scene), std::string::npos) << "no id of the catalogue names it";
  const Finished run = plumb({"run", scene, "--backend", SAMPLE_BACKEND, "--json"});
  ASSERT_EQ(run.rows().size(), 1u) << run.err;
  EXPECT_EQ(run.rows()[0].at("status"), "unsupported") << "it has no collision";
}

TEST(Convert, MakesAWorldOfASceneWithItsMeshesBeside) {
  const std::filesystem::path folder = fresh_folder("convert-world");
  const Finished tower = plumb({"convert", "D1", (folder / "tower.sdf").string(), "--param", "H=3"});
  ASSERT_EQ(tower.status, 0) << tower.err;
  EXPECT_NE(tower.out.find("4 bodies"), std::string::npos) << tower.out;
  const Finished hulls = plumb({"convert", "H2", (folder / "hulls.sdf").string()});
  ASSERT_EQ(hulls.status, 0) << hulls.err;
  std::size_t meshes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    meshes += entry.path().extension() == ".obj" ? 1 : 0;
  EXPECT_GT(meshes, 0u);
}

TEST(Convert, MakesRobotsAndNodesOfScenes) {
  const std::filesystem::path folder = fresh_folder("convert-robot");
  const auto text_of = [&](const std::vector<std::string>& arguments, const std::string& name) {
    std::vector<std::string> all{"convert"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    all.push_back((folder / name).string());
    const Finished run = plumb(all);
    EXPECT_EQ(run.status, 0) << run.err;
    std::ifstream file(folder / name);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string robot = text_of({"I23"}, "arm.urdf");
  EXPECT_TRUE(robot.starts_with("<robot name=\"arm\">")) << robot.substr(0, 100);
  const std::string nodes = text_of({"H2"}, "hulls.gltf"), binary = text_of({"H2"}, "hulls.glb");
  EXPECT_NE(nodes.find("\"KHR_physics_rigid_bodies\""), std::string::npos);
  EXPECT_EQ(binary.substr(0, 4), "glTF");
  EXPECT_LT(binary.size(), nodes.size());
}

TEST(Convert, SaysWhatIsAskedWrongly) {
  const std::filesystem::path folder = fresh_folder("convert-wrong");
  const std::string json = (folder / "x.json").string(), sdf = (folder / "x.sdf").string(),
                    urdf = (folder / "x.urdf").string();
  const auto expect = [&](const std::vector<std::string>& arguments, const std::string& words) {
    const Finished run = plumb(arguments);
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
    for (const std::string& file : {json, sdf, urdf})
      EXPECT_FALSE(std::filesystem::exists(file)) << "nothing half done";
  };
  expect({"convert", "gone.urdf", json}, "gone.urdf: there is no such file");
  expect({"convert", "D1", (folder / "x.txt").string()}, "a scene's file ends with .json");
  expect({"convert", "D1", json}, "D1 is a scene already");
  expect({"convert", "stacking", sdf}, "names several scenes");
  expect({"convert", "D1", sdf, "--param", "K=3"}, "K");
  expect({"convert", "E8", sdf}, "which SDF lacks");
  expect({"convert", "H2", urdf}, "URDF describes one robot, and 15 bodies are not joined to");
  expect({"convert", "D1", "/nowhere/x.sdf"}, "cannot write /nowhere/x.sdf");
  std::ofstream(folder / "page.html") << "<!-- <sdf> --><html></html>";
  expect({"convert", (folder / "page.html").string(), json}, "it begins with <html>");
  expect({"convert", (folder / "page.html").string(), json, "--param", "H=3"}, "is no scene and has no parameters");
  expect({"convert", (folder / "page.html").string(), json, "--dt", "-1"}, "must be a number above 0");
  expect({"convert", (folder / "page.html").string(), json, "--id", "robot"}, "must be a letter and digits");
}

}  // namespace
}  // namespace plumb::harness::testing
