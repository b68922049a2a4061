// What scene files may observe by themselves: read, refused with file and line, and listed in the schema.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "measure/quantities/quantities.hpp"
#include "measure/registry/registry.hpp"

namespace plumb::harness {
namespace {

namespace fs = std::filesystem;

const char* const good = R"json({
  "id": "T1", "slug": "test", "title": "t", "doc": "d",
  "parameters": {
    "h": { "default": 5, "unit": "m", "doc": "height" },
    "n": { "default": 2, "doc": "bodies", "integer": true }
  },
  "let": [{ "name": "v", "value": "sqrt(2 * 9.81 * h)" }],
  "needs": ["rotation", "collision", "joints"],
  "seconds": 2,
  "shapes": { "ball": { "type": "sphere", "radius": 0.5 } },
  "bodies": [
    { "name": "ball{i}", "repeat": { "i": "n" }, "shape": "ball", "position": ["2 * i", "h", 0] },
    { "name": "point", "mass": 1, "flags": ["no_rotation"] }
  ],
  "joints": [{ "name": "rod", "type": "hinge", "body_a": "ball0", "body_b": "ball1", "anchor": [1, 0, 0] }],
  "measure": {
    "kind": "quantities",
    "quantities": {
      "speed": { "body": "ball{n-1}", "quantity": "velocity", "at": "=1 / 2", "truth": "=v * t", "scale": "=v" },
      "turn": { "joint": "rod", "quantity": "angle", "take": "max", "over": [0.5, "=seconds"], "truth": "=deg(90)" },
      "way": { "body": "ball0", "quantity": "position", "along": [0, -3, "=-4"], "take": "rms", "truth": "=h * t" },
      "near": { "pair": ["ball0", "ball1"], "quantity": "distance", "truth": 0 },
      "all": { "quantity": "energy", "truth": 0 }
    }
  },
  "metrics": {
    "speed": { "unit": "cm/s", "doc": "d" },
    "turn": { "unit": "deg", "doc": "d" },
    "way": { "unit": "m", "doc": "d" },
    "near": { "unit": "m", "doc": "d" },
    "all": { "unit": "J", "doc": "d", "when": "n > 1" }
  }
})json";

class QuantityFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("plumb-quantities-" + std::to_string(::getpid())) / "group";
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_.parent_path()); }

  SceneFile load(const std::string& text) {
    const fs::path path = folder_ / "T1-test.json";
    std::ofstream(path) << text;
    return SceneFile::load(path);
  }
  /// The good file after replacements; without the path before the file's name.
  std::string refusal(const std::string& from, const std::string& to) {
    std::string text = good;
    const auto at = text.find(from);
    if (at == std::string::npos) return "the good file has no " + from;
    text.replace(at, from.size(), to);
    try {
      const SceneFile file = load(text);
      check_measure(file, file.instantiate({}));
    } catch (const UsageError& error) {
      const std::string what = error.what();
      return what.substr(what.find("T1-test"));
    }
    return "nothing was thrown";
  }

  fs::path folder_;
};

TEST_F(QuantityFiles, AreReadAsTheyStand) {
  const SceneFile file = load(good);
  const Scene scene = file.instantiate({});
  check_measure(file, scene);
  const auto requests = read_quantities(scene, &file);
  ASSERT_EQ(requests.size(), 5u);
  const auto named = [&](const std::string& name) {
    return *std::find_if(requests.begin(), requests.end(), [&](const auto& r) { return r.name == name; });
  };
  const double v = std::sqrt(2 * 9.81 * 5);
  const QuantityRequest speed = named("speed");
  EXPECT_EQ(speed.target.first, scene.body("ball1"));
  EXPECT_EQ(speed.in_unit, 100);
  EXPECT_EQ(speed.reduction.begin, 0.5);
  EXPECT_DOUBLE_EQ(speed.truth, v / 2);
  EXPECT_DOUBLE_EQ(speed.scale, v);
  EXPECT_TRUE(speed.truth_of_time.is_null());
  const QuantityRequest turn = named("turn");
  EXPECT_DOUBLE_EQ(turn.in_unit, 180 / std::acos(-1.0));
  EXPECT_EQ(turn.reduction.begin, 0.5);
  EXPECT_EQ(turn.reduction.end, 2);
  EXPECT_DOUBLE_EQ(turn.scale, std::acos(-1.0) / 2) << "relative to the truth";
  const QuantityRequest way = named("way");
  EXPECT_EQ(way.truth_of_time["expression"], "h * t");
  EXPECT_EQ(way.truth, 0);
  EXPECT_EQ(way.scale, 1);
  EXPECT_DOUBLE_EQ(way.target.along->y(), -0.6);
  EXPECT_DOUBLE_EQ(way.target.along->z(), -0.8);
  EXPECT_EQ(named("near").scale, 1) << "a truth of 0 has an absolute error";
  EXPECT_EQ(named("near").reduction.end, 2) << "the end";
  EXPECT_EQ(read_quantities(file.instantiate({{"n", 2.0}}), &file).size(), 5u);
}

TEST_F(QuantityFiles, LeaveOutWhatTheSceneDoesNotScore) {
  std::string text = good;
  text.replace(text.find("n > 1"), 5, "n > 2");
  const SceneFile file = load(text);
  check_measure(file, file.instantiate({}));
  EXPECT_EQ(read_quantities(file.instantiate({}), &file).size(), 4u);
}

TEST_F(QuantityFiles, AreRefusedWithFileLineAndRemedy) {
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& sentence) {
    const std::string said = refusal(from, to);
    EXPECT_NE(said.find(sentence), std::string::npos) << said;
  };
  expect("\"at\": \"=1 / 2\"", "\"at\": 2.5",
         "T1-test.json:19: quantity \"speed\": 2.5 s is beyond the scene's end at 2 s");
  expect("\"at\": \"=1 / 2\"", "\"at\": -1", "-1 s is before the start");
  expect("\"at\": \"=1 / 2\"", "\"at\": \"1 / 2\"", "at must be a number, or an expression that starts with =");
  expect("\"at\": \"=1 / 2\"", "\"at\": \"=t\"", "at may not use the time t; truth alone may");
  expect("\"at\": \"=1 / 2\"", "\"over\": [0, 1]", "over needs a take");
  expect("[0.5, \"=seconds\"]", "[1.001, 1.002]",
         "T1-test.json:20: quantity \"turn\": the window from 1.001 to 1.002 s is empty");
  expect("[0.5, \"=seconds\"]", "[1, 0.5]", "is empty");
  expect("[0.5, \"=seconds\"]", "[1, 3]", "3 s is beyond the scene's end");
  expect("[0.5, \"=seconds\"]", "1", "over must be a window of two times");
  expect("ball{n-1}", "bal", "unknown body \"bal\"; did you mean \"ball");
  expect("\"joint\": \"rod\"", "\"joint\": \"rot\"", "unknown joint \"rot\"; did you mean \"rod\"?");
  expect("[\"ball0\", \"ball1\"]", "[\"ball0\", \"point\"]", "body point has no shape");
  expect("[\"ball0\", \"ball1\"]", "[\"ball0\", \"ball0\"]", "names the same body twice");
  expect("[\"ball0\", \"ball1\"]", "[\"ball0\"]", "pair must name two bodies");
  expect("\"quantity\": \"velocity\"", "\"quantity\": \"velocty\"",
         "there is no \"velocty\" of body; did you mean \"velocity\"?");
  expect("\"quantity\": \"energy\"", "\"quantity\": \"velocity\"",
         "of all bodies together (name a body, joint or pair");
  expect("\"quantity\": \"angle\"", "\"quantity\": \"torque\"",
         "for scenes that need \"joint_reactions\": add it to needs, or make the metric optional");
  expect("\"quantity\": \"angle\"", "\"quantity\": \"gap\", \"along\": \"x\"", "gap has no direction");
  expect("\"take\": \"max\"", "\"take\": \"maximum\"", "there is no take \"maximum\"");
  expect("\"take\": \"max\"", "\"take\": \"period\"", "crossing_time and period need a level");
  expect("\"take\": \"max\"", "\"take\": \"max\", \"level\": 1", "level is for take crossing_time and period");
  expect("\"take\": \"max\"", "\"take\": \"time_of_max\"", "it is in s, and its metric is in \"deg\"");
  expect("[0, -3, \"=-4\"]", "[0, 0, 0]", "a direction must not be 0 0 0");
  expect("[0, -3, \"=-4\"]", "\"w\"", "along must be x, y, z or an array of three numbers");
  expect("\"scale\": \"=v\"", "\"scale\": 0", "scale must be above 0, not 0");
  expect("\"scale\": \"=v\"", "\"scal\": 1", "unknown key \"scal\"; did you mean \"scale\"?");
  expect("\"truth\": \"=h * t\"", "\"truth\": \"=h / (t - 2)\"", "gives inf");
  expect("\"truth\": \"=h * t\"", "\"truth\": \"=hh * t\"", "unknown name \"hh\"");
  expect(", \"truth\": \"=deg(90)\"", "", "the key \"truth\" is missing here");
  expect("\"unit\": \"cm/s\"", "\"unit\": \"kg\"", "it is in m/s, and its metric is in \"kg\"");
  expect("\"near\": { \"pair\"", "\"nearer\": { \"pair\"",
         "T1-test.json:22: quantity \"nearer\" is no metric of the scene; did you mean \"near\"?");
  expect("\"all\": { \"quantity\": \"energy\", \"truth\": 0 }", "\"all\": 3", "quantity \"all\": must be an object");
  expect(",\n      \"all\": { \"quantity\": \"energy\", \"truth\": 0 }", "",
         "metric \"all\" has no entry in the quantities of the measure");
  expect("\"let\": [", "\"let\": [{ \"name\": \"t\", \"value\": 1 }, ", "t is the time in truths of quantities");
  expect("\"near\": { \"pair\"", "\"way\": { \"pair\"", "stands twice");
}

TEST(Quantities, AreThoseOfTheSchema) {
  std::ifstream file(std::string(PLUMB_SCENES_FOLDER) + "/scene.schema.json");
  const auto schema = nlohmann::json::parse(file);
  const auto& properties = schema.at("definitions").at("quantity").at("properties");
  std::set<std::string> keys, names;
  for (const auto& [key, ignored] : properties.items()) keys.insert(key);
  EXPECT_EQ(keys, std::set<std::string>(quantity_keys().begin(), quantity_keys().end()));
  for (const QuantitySpec& spec : quantity_specs()) names.insert(spec.name);
  EXPECT_EQ(properties.at("quantity").at("enum").get<std::set<std::string>>(), names);
  EXPECT_EQ(properties.at("take").at("enum").get<std::vector<std::string>>(), take_words());
  EXPECT_EQ(take_docs().size(), take_words().size());
}

}  // namespace
}  // namespace plumb::harness
