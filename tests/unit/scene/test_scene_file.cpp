// Scene files: what they become, and how broken ones are refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "scene/build.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness {
namespace {

namespace fs = std::filesystem;

const char* const good = R"({
  "id": "T1", "slug": "test", "title": "t", "doc": "d",
  "parameters": {
    "n": { "default": 2, "unit": "1", "doc": "count", "integer": true, "minimum": 0 },
    "kind": { "default": "ball", "doc": "what", "choices": ["ball", "box"] }
  },
  "variants": [{ "sweep": { "n": [1, 2], "kind": ["ball", "box"] } }, { "n": 5 }],
  "let": [{ "name": "half", "value": "n / 2" }, { "name": "quarter", "value": "half / 2" }],
  "needs": ["rotation", "collision", "friction", "joints"],
  "seconds": "n + 1",
  "shapes": {
    "all": { "type": "compound", "children": [{ "shape": "ball", "position": [0, 1, 0] }, { "shape": "box", "friction": 1 }] },
    "ball": { "type": "sphere", "radius": 0.5 },
    "box": { "type": "box", "half_extents": ["quarter", 1, 1] }
  },
  "bodies": [
    { "name": "{kind}{i}_{j}", "repeat": { "i": "n", "j": "i + 1" }, "shape": "{kind}", "position": ["i", "j", 0] },
    { "name": "extra", "when": "kind == box", "shape": "all", "mass": 3, "flags": ["ccd"], "locks": ["angular_z"],
      "orientation": { "axis": [0, 0, 2], "degrees": 90 }, "filter": { "group": -1 } }
  ],
  "joints": [
    { "name": "pin", "type": "hinge", "body_b": "{kind}0_0", "anchor": [0, 1, 0], "anchor_orientation": { "x_axis": [0, 0, 1] },
      "motors": { "rx": { "target_velocity": 1, "max_force": "n" } } }
  ],
  "measure": { "kind": "m", "body": "{kind}0_0", "value": "=2 * n", "list": ["=n", "n"] },
  "metrics": { "m": { "unit": "m", "doc": "d", "threshold": "dt * n", "gold": 0 },
    "box_only": { "unit": "1", "doc": "d", "when": "kind == box" } }
})";

class SceneFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("plumb-scenes-" + std::to_string(::getpid())) / "group";
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_.parent_path()); }

  SceneFile load(const std::string& text) {
    const fs::path path = folder_ / "T1-test.json";
    std::ofstream(path) << text;
    return SceneFile::load(path);
  }
  /// The refusal of the good file after a replacement, without the path before the file's name.
  std::string refusal(const std::string& from, const std::string& to) {
    std::string text = good;
    const auto at = text.find(from);
    if (at == std::string::npos) return "the good file has no " + from;
    text.replace(at, from.size(), to);
    try {
      load(text);
    } catch (const UsageError& error) {
      const std::string what = error.what();
      return what.substr(what.find("T1-test"));
    }
    return "nothing was thrown";
  }

  fs::path folder_;
};

TEST_F(SceneFiles, ChildrenOfACompoundRepeat) {
  std::string text = good;
  const std::string from = R"({ "shape": "ball", "position": [0, 1, 0] })";
  text.replace(
      text.find(from), from.size(),
      R"({ "shape": "ball", "repeat": { "i": 3, "j": "i + 1" }, "when": "i != 1", "position": ["i", "j", 0] })");
  const Scene scene = load(text).instantiate({{"kind", std::string("box")}});
  const SceneShape& compound = scene.shapes[*scene.bodies[scene.body("extra")].shape];
  ASSERT_EQ(compound.children.size(), 1u + 3 + 1);
  EXPECT_EQ(compound.children[3].pose.position.x, 2);
  EXPECT_EQ(compound.children[3].pose.position.y, 2);
  EXPECT_NE(refusal(from, R"({ "shape": "ball", "repeat": { "n": 2 } })").find("something else"), std::string::npos);
}

TEST_F(SceneFiles, BecomeScenes) {
  const SceneFile file = load(good);
  EXPECT_EQ(file.group, "group");
  EXPECT_EQ(file.variants.size(), 5u);
  EXPECT_EQ(file.needs, PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_JOINTS);
  const Scene scene = file.instantiate({{"n", 3.0}, {"kind", std::string("box")}});
  EXPECT_EQ(scene.seconds, 4);
  ASSERT_EQ(scene.bodies.size(), 1u + 2 + 3 + 1);
  EXPECT_EQ(scene.bodies[4].name, "box2_1");
  EXPECT_EQ(scene.bodies[4].desc.pose.position.x, 2);
  EXPECT_EQ(scene.bodies[4].desc.pose.position.y, 1);
  EXPECT_EQ(scene.shapes[scene.bodies[0].shape.value()].desc.half_extents.x, 0.75);
  const SceneBody& extra = scene.bodies[scene.body("extra")];
  EXPECT_EQ(extra.desc.mass_mode, PLUMB_MASS_FROM_TOTAL);
  EXPECT_EQ(extra.desc.flags, PLUMB_BODY_CCD);
  EXPECT_EQ(extra.desc.locks, PLUMB_LOCK_ANGULAR_Z);
  EXPECT_EQ(extra.desc.filter.group, -1);
  EXPECT_NEAR(extra.desc.pose.orientation.z, std::sqrt(0.5), 1e-15);
  const SceneShape& compound = scene.shapes[*extra.shape];
  ASSERT_EQ(compound.children.size(), 2u);
  EXPECT_LT(compound.children[1].shape, *extra.shape);
  EXPECT_FALSE(compound.children[0].material.has_value());
  EXPECT_EQ(compound.children[1].material->friction, 1);
  const PlumbJointDesc& pin = scene.joints[scene.joint("pin")].desc;
  EXPECT_EQ(pin.frame_a.position.y, 1);
  EXPECT_EQ(pin.frame_b.position.y, 1);
  EXPECT_EQ(pin.motors[3].max_force, 3);
  EXPECT_EQ(pin.motors[3].enabled, 1u);
  EXPECT_EQ(scene.measure_args.at("body"), "box0_0");
  EXPECT_EQ(scene.measure_args.at("value"), 6.0);
  EXPECT_EQ(scene.measure_args.at("list").at(0), 3.0);
  EXPECT_EQ(scene.measure_args.at("list").at(1), "n");
  ASSERT_EQ(scene.metrics.size(), 2u);
  EXPECT_EQ(file.instantiate({}).metrics.size(), 1u);
  EXPECT_DOUBLE_EQ(*scene.metrics.at(1).threshold, 3.0 / 60);
  EXPECT_EQ(scene.number("n"), 3);
  EXPECT_EQ(scene.word("kind"), "box");
  EXPECT_EQ(file.instantiate({}).bodies.size(), 3u);
}

TEST_F(SceneFiles, GiveAGridTheHeightOfAnExpression) {
  std::string text = good;
  const std::string shapes = "\"shapes\": {";
  text.replace(text.find(shapes), shapes.size(),
               shapes + R"("hills": { "type": "triangle_mesh", "grid": [2, 3], "height": "n + x / 3 + 10 * z" },)");
  const Scene scene = load(text).instantiate({{"n", 2.0}});
  const auto hills = std::find_if(scene.shapes.begin(), scene.shapes.end(),
                                  [](const SceneShape& shape) { return shape.name == "hills"; });
  ASSERT_NE(hills, scene.shapes.end());
  ASSERT_EQ(hills->vertices.size(), 27u);
  for (std::size_t i = 0; i < 27; i += 3)
    EXPECT_DOUBLE_EQ(hills->vertices[i + 1], 2 + hills->vertices[i] / 3 + 10 * hills->vertices[i + 2]);
  EXPECT_EQ(hills->vertices[0], -3);
  EXPECT_EQ(hills->vertices[1], 2 - 1 - 30);
}

TEST_F(SceneFiles, GiveTrianglesTheirMaterials) {
  const auto surface = [&](const std::string& member) {
    std::string text = good;
    const std::string shapes = "\"shapes\": {";
    text.replace(text.find(shapes), shapes.size(), shapes + "\"land\": { " + member + " },");
    try {
      const Scene scene = load(text).instantiate({{"n", 2.0}});
      for (const SceneShape& shape : scene.shapes)
        if (shape.name == "land") return std::pair(shape, std::string());
    } catch (const UsageError& error) {
      return std::pair(SceneShape{}, std::string(error.what()));
    }
    return std::pair(SceneShape{}, std::string("it is not there"));
  };
  const std::string mesh = R"("type": "triangle_mesh", "grid": [2, 3])";
  const std::string field = R"("type": "height_field", "heights": [[0, 0, 0], [0, 0, 0]], "spacing": [1, 1, 1])";
  const std::string rows = R"(, "materials": [{ "friction": 0.1 }, { "restitution": "n / 4" }])";
  const auto [land, nothing] = surface(mesh + rows + R"(, "triangle_materials": "x < 0 ? (z < 0 ? 0 : 1) : -1")");
  EXPECT_EQ(nothing, "");
  EXPECT_EQ(land.triangle_materials, (std::vector<std::uint32_t>{0, 0, ~0U, ~0U, 1, 1, ~0U, ~0U}));
  ASSERT_EQ(land.materials.size(), 2U);
  EXPECT_EQ(land.materials[0].friction, 0.1);
  EXPECT_EQ(land.materials[1].friction, 0.5);
  EXPECT_EQ(land.materials[1].restitution, 0.5);
  EXPECT_EQ(land.descriptor().material_count, 2U);
  const auto by_place = surface(field + rows + R"(, "triangle_materials": "x + z < -0.5 ? 0 : 1")").first;
  EXPECT_EQ(by_place.triangle_materials, (std::vector<std::uint32_t>{0, 1, 1, 1}));
  const auto by_list = surface(field + rows + R"(, "triangle_materials": [1, 0, -1, "n - 2"])").first;
  EXPECT_EQ(by_list.triangle_materials, (std::vector<std::uint32_t>{1, 0, ~0U, 0}));

  const auto refused = [&](const std::string& member, const std::string& words) {
    const std::string said = surface(member).second;
    EXPECT_NE(said.find(words), std::string::npos) << member << "\n  " << said;
  };
  refused(mesh + rows, "\"materials\" and \"triangle_materials\" go together");
  refused(mesh + R"(, "triangle_materials": 0)", "go together");
  refused(mesh + rows + R"(, "triangle_materials": [0, 1])", "the shape has 8 triangles, not 2");
  refused(mesh + rows + R"(, "triangle_materials": 2)", "expected a whole number from -1 to 1, found 2");
  refused(mesh + R"(, "materials": [], "triangle_materials": 0)", "one or more");
  refused(mesh + R"(, "materials": [{ "friction": -1 }], "triangle_materials": 0)", "friction");
  refused(R"("type": "sphere", "radius": 1)" + rows + R"(, "triangle_materials": 0)", "a sphere has no");
}

TEST_F(SceneFiles, SayWhatTheHostDoes) {
  std::string text = good;
  const std::string measure = "\"measure\":", needs = "\"needs\": [", pin = "\"name\": \"pin\",";
  text.replace(text.find(measure), measure.size(),
               R"("host": [
    { "body": "{kind}{i}_0", "repeat": { "i": "n" }, "when": "i > 0", "force": ["i * t", 1, 0], "over": [1, "n"] },
    { "joint": "pin", "motors": { "rx": { "target_velocity": "half - t" } } },
    { "joint": "pin", "targets": { "rx": "half * t" }, "over": [0, 1] }
  ], "measure":)");
  text.replace(text.find(needs), needs.size(), "\"needs\": [\"forces\", ");
  text.replace(text.find(pin), pin.size(),
               "\"name\": \"pin\", \"cut\": \"half\", \"springs\": { \"rx\": { \"rest\": 0.5, \"frequency\": 2, "
               "\"damping_ratio\": 1 } },");
  const Scene scene = load(text).instantiate({{"n", 3.0}});
  ASSERT_EQ(scene.host.size(), 4u);
  const SceneAction& push = scene.host[1];
  EXPECT_EQ(push.kind, SceneAction::force);
  EXPECT_EQ(push.target, scene.body("ball2_0"));
  EXPECT_EQ(push.begin, 1);
  EXPECT_EQ(push.end, 3);
  ASSERT_EQ(push.numbers.size(), 6u);
  EXPECT_EQ(push.numbers[0].text, "i * t");
  EXPECT_EQ(push.names.at("i"), 2);
  EXPECT_FALSE(push.names.contains("t"));
  EXPECT_EQ(push.numbers[1].text, "");
  EXPECT_EQ(push.numbers[1].constant, 1);
  const SceneAction& motor = scene.host[2];
  EXPECT_EQ(motor.kind, SceneAction::motors);
  ASSERT_EQ(motor.numbers.size(), 12u);
  EXPECT_EQ(motor.numbers[6].text, "half - t");
  EXPECT_EQ(motor.numbers[7].constant, 3) << "as the joint has it";
  EXPECT_EQ(motor.begin, 0);
  EXPECT_EQ(motor.end, scene.seconds);
  const SceneAction& target = scene.host[3];
  EXPECT_EQ(target.kind, SceneAction::targets);
  ASSERT_EQ(target.numbers.size(), 6u);
  EXPECT_EQ(target.numbers[3].text, "half * t");
  EXPECT_EQ(target.end, 1);
  EXPECT_EQ(scene.joints[0].cut, 1.5);
}

TEST_F(SceneFiles, TakeWhatTheyDoNotNeedFromTheirBodies) {
  std::string text = good;
  text.replace(text.find(R"("rotation", "collision", "friction", )"), 37, R"("collision", )");
  const Scene scene = load(text).instantiate({});
  EXPECT_EQ(scene.bodies[0].desc.flags, PLUMB_BODY_NO_ROTATION);
  EXPECT_EQ(scene.bodies[0].desc.material.friction, 0);
}

TEST_F(SceneFiles, AreRefusedWithLineAndNearestWord) {
  EXPECT_EQ(refusal("\"radius\"", "\"radios\""),
            "T1-test.json:13: shapes.ball: unknown key \"radios\"; did you mean \"radius\"?");
  EXPECT_EQ(refusal("\"friction\", \"joints\"", "\"fricton\""),
            "T1-test.json:9: needs[2]: unknown need \"fricton\"; did you mean \"friction\"?");
  EXPECT_EQ(refusal("\"unit\": \"1\"", "\"unit\": \"kgg\""),
            "T1-test.json:4: parameters.n.unit: unknown unit \"kgg\"; did you mean \"kg\"?");
  EXPECT_EQ(refusal("\"half / 2\"", "\"hlaf / 2\""),
            "T1-test.json:8: let[1].value: \"hlaf / 2\": unknown name \"hlaf\"; did you mean \"half\"?");
  EXPECT_EQ(refusal("\"body_b\": \"{kind}0_0\"", "\"body_b\": \"{kind}0_9\""),
            "T1-test.json:22: joints[0].body_b: unknown body \"ball0_9\"; did you mean \"ball0_0\"?");
  EXPECT_EQ(refusal("\"shape\": \"{kind}\"", "\"shape\": \"bal\""),
            "T1-test.json:17: bodies[0].shape: unknown shape \"bal\"; did you mean \"ball\"?");
  EXPECT_EQ(refusal("\"radius\": 0.5", "\"radius\": true"),
            "T1-test.json:13: shapes.ball.radius: expected a number or an expression, found boolean");
  EXPECT_EQ(refusal("\"seconds\": \"n + 1\"", "\"seconds\": -1"), "T1-test.json:10: seconds: must be above 0, not -1");
  EXPECT_EQ(refusal("\"rx\"", "\"rw\""),
            "T1-test.json:23: joints[0].motors.rw: unknown axis \"rw\"; did you mean \"rx\"?");
  EXPECT_EQ(refusal("\"slug\": \"test\", ", ""), "T1-test.json:1: the key \"slug\" is missing here");
  EXPECT_EQ(refusal("[1, 2]", "[1, -2]"),
            "T1-test.json:7: variants[0].sweep.n[1]: parameter n = -2 is below its minimum 0");
  EXPECT_EQ(refusal("{ \"n\": 5 }", "{ \"m\": 5 }").substr(0, 62),
            "T1-test.json:7: variants[1].m: scene T1: unknown parameter \"m\"");
  EXPECT_EQ(refusal("\"name\": \"extra\", \"when\": \"kind == box\"", "\"name\": \"ball0_0\""),
            "T1-test.json:18: bodies[1].name: a second body is named \"ball0_0\"");
  EXPECT_EQ(refusal("\"name\": \"quarter\"", "\"name\": \"n\""),
            "T1-test.json:8: let[1].name: \"n\" is the name of something else already");
  EXPECT_EQ(refusal("\"type\": \"sphere\",", "\"type\": \"sphere\", \"half_height\": 1,"),
            "T1-test.json:13: shapes.ball.half_height: a sphere has no half_height");
  EXPECT_EQ(refusal("\"repeat\": { \"i\": \"n\"", "\"repeat\": { \"i\": 1e9"),
            "T1-test.json:17: bodies[0].repeat.i: expected a whole number from 0 to 2000000, found 1e+09");
}

/// The parser's side of the list that check_schema.py holds against the schema.
TEST_F(SceneFiles, OfTheListOfWrongOnesAreRefused) {
  std::ifstream file(WRONG_SCENES);
  const auto list = nlohmann::json::parse(file);
  EXPECT_NO_THROW(load(list.at("good").dump(1)));
  for (const auto& wrong : list.at("wrong")) {
    nlohmann::json scene = list.at("good");
    scene[nlohmann::json::json_pointer(wrong.at("at"))] = wrong.at("value");
    const std::string what = wrong.at("at").get<std::string>() + " = " + wrong.at("value").dump();
    try {
      load(scene.dump(1));
      ADD_FAILURE() << what << " is taken";
    } catch (const UsageError& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find(wrong.at("says").get<std::string>()), std::string::npos) << what << "\n  " << said;
      EXPECT_NE(said.find("T1-test.json:"), std::string::npos) << "no line: " << said;
      EXPECT_LT(said.size(), 500u) << what;
      EXPECT_EQ(said.find_first_of("\n\x1b\x07"), std::string::npos) << what;
    }
  }
}

TEST_F(SceneFiles, TimesInPlaceOfTheFilesAreJudgedAsTheirs) {
  const SceneFile file = load(good);
  const auto said = [&](const Times& times) -> std::string {
    try {
      static_cast<void>(file.outline({}, times));
      return "";
    } catch (const UsageError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(said({0.01, 2}), "");
  EXPECT_EQ(
      said({{}, 1e300}),
      "scene T1: seconds: 1e+300 s in steps of 0.0166667 s are 6e+301 steps, and 1e+07 are the most; ask for fewer "
      "seconds or a longer dt");
  EXPECT_EQ(said({1e6, {}}), "scene T1: dt: 3 s are less than one step of 1e+06 s; nothing would run");
  EXPECT_EQ(said({1e-300, 1e-299}), "scene T1: dt: must be from 1e-09 to 1e+06 s, not 1e-300");
  EXPECT_NE(said({1e-9, {}}).find("are 3e+09 steps"), std::string::npos);
  EXPECT_NE(said({NAN, {}}), "");
  EXPECT_NE(said({{}, NAN}), "");
  EXPECT_NE(said({{}, INFINITY}), "");
}

TEST_F(SceneFiles, OfCrowdsHaveAnOutlineWithoutBeingMade) {
  std::string text = good;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace(R"("i": "n", "j": "i + 1")", R"("i": 400, "j": 300)");
  // The density of the last body alone is wrong: what is not made is not looked at.
  replace(R"("position": ["i", "j", 0])", R"*("density": "119999 - (300 * i + j)")*");
  const SceneFile file = load(text);
  EXPECT_EQ(file.outline({}).bodies.size(), 0u);
  try {
    static_cast<void>(file.instantiate({}));
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("bodies[0].density: density is 0"), std::string::npos) << error.what();
  }
}

TEST_F(SceneFiles, ThatAreNotJsonAreRefusedWithTheLine) {
  EXPECT_EQ(refusal("\"seconds\": \"n + 1\",", "\"seconds\" \"n + 1\",").substr(0, 31),
            "T1-test.json:10: not valid JSON");
  EXPECT_EQ(refusal("\"seconds\": \"n + 1\",", "\"seconds\": 1, \"seconds\": 2,"),
            "T1-test.json:10: the key \"seconds\" stands twice in one object; take one out");
  EXPECT_NE(refusal("0.5", "1e999").find("JSON"), std::string::npos);
  EXPECT_NE(refusal("[1, 2]", std::string(100, '[') + std::string(100, ']')).find("nested deeper"), std::string::npos);
  EXPECT_THROW(SceneFile::load(folder_ / "none.json"), UsageError);
  EXPECT_THROW(SceneFile::load(folder_), UsageError);
}

TEST_F(SceneFiles, RefuseWrongParameters) {
  const SceneFile file = load(good);
  EXPECT_THROW(static_cast<void>(file.instantiate({{"N", 3.0}})), UsageError);
  EXPECT_THROW(static_cast<void>(file.instantiate({{"n", 2.5}})), UsageError);
  EXPECT_THROW(static_cast<void>(file.instantiate({{"kind", std::string("cone")}})), UsageError);
  EXPECT_THROW(static_cast<void>(file.instantiate({}).body("nobody")), UsageError);
  EXPECT_THROW(static_cast<void>(file.instantiate({}).number("kind")), std::logic_error);
}

// --- the scenes of the repository ---

TEST(Catalogue, EveryCellOfEverySceneCanBeMade) {
  std::set<std::string> ids;
  for (const SceneFile& file : all_scenes()) {
    EXPECT_TRUE(ids.insert(file.id).second) << file.id;
    EXPECT_EQ(file.path.filename().string(), file.id + "-" + file.slug + ".json");
    EXPECT_FALSE(file.doc.empty() || file.title.empty()) << file.id;
    EXPECT_FALSE(file.metrics.empty()) << file.id;
    for (const Parameters& variant : file.variants)
      EXPECT_NO_THROW(EXPECT_GT(file.instantiate(variant).bodies.size(), 0u)) << file.id;
  }
  EXPECT_GE(ids.size(), 22u);
}

TEST(Catalogue, FindsScenesByWhatAUserTypes) {
  EXPECT_EQ(find_scenes("A1").at(0).slug, "free-fall");
  EXPECT_EQ(find_scenes("a1").at(0).slug, "free-fall");
  EXPECT_EQ(find_scenes("free-fall").at(0).id, "A1");
  EXPECT_EQ(find_scenes("integrator/free-fall").at(0).id, "A1");
  EXPECT_EQ(find_scenes(std::string(PLUMB_SCENES_FOLDER) + "/integrator/A1-free-fall.json").at(0).id, "A1");
  EXPECT_GE(find_scenes("friction").size(), 8u);
  EXPECT_GT(find_scenes("all").size(), find_scenes("core").size());
  const auto integrator = find_scenes("integrator");
  EXPECT_GE(integrator.size(), 9U);
  EXPECT_EQ(integrator.front().id, "A1");
  for (const auto& scene : integrator) EXPECT_EQ(scene.id.front(), 'A') << scene.id;
  try {
    static_cast<void>(find_scenes("twoer"));
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "unknown scene \"twoer\"; did you mean \"tower\"?");
  }
}

TEST(Catalogue, SchemaAndReaderKnowTheSameKeys) {
  std::ifstream file(std::string(PLUMB_SCENES_FOLDER) + "/scene.schema.json");
  const auto schema = nlohmann::json::parse(file);
  for (const auto& [name, keys] : scene_keys()) {
    const auto& properties =
        name.empty() ? schema.at("properties") : schema.at("definitions").at(name).at("properties");
    std::set<std::string> in_schema;
    for (const auto& [key, ignored] : properties.items()) in_schema.insert(key);
    EXPECT_EQ(in_schema, std::set<std::string>(keys.begin(), keys.end())) << "definition " << name;
  }
  EXPECT_EQ(schema.at("properties").at("needs").at("items").at("enum"), nlohmann::json(need_words()));
  EXPECT_EQ(schema.at("definitions").at("shape").at("properties").at("type").at("enum"), nlohmann::json(shape_words()));
  EXPECT_EQ(schema.at("definitions").at("joint").at("properties").at("type").at("enum"), nlohmann::json(joint_words()));
}

}  // namespace
}  // namespace plumb::harness
