// What is left of a scene is a scene, and everything that is not to blame is gone.
#include "reduce/reduction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "convert/scene_text.hpp"
#include "reduce/plain_scene.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness {
namespace {

Scene load(const Json& json) {
  const std::string file = ::testing::TempDir() + "reduced-scene.json";
  std::ofstream(file) << scene_text(json);
  return SceneFile::load(file).instantiate({});
}

Json plain(const std::string& name) {
  const SceneFile file = find_scenes(name).front();
  return plain_scene(file.instantiate(file.variants.front()), file);
}

bool has(const Json& scene, const char* list, const std::string& name) {
  return scene.contains(list) && std::any_of(scene[list].begin(), scene[list].end(),
                                             [&](const Json& thing) { return thing.at("name") == name; });
}

/// Repeats, parameters, expressions and what the host does become numbers, and mean the same.
TEST(PlainScene, IsTheSceneOfTheCatalogue) {
  for (const char* name : {"D1", "E1", "F13", "I9", "I20", "I30", "I36", "I37"}) {
    SCOPED_TRACE(name);
    const SceneFile file = find_scenes(name).front();
    const Scene scene = file.instantiate(file.variants.front());
    const Scene again = load(plain_scene(scene, file));
    EXPECT_EQ(again.id, file.id + "r");
    EXPECT_EQ(again.needs, scene.needs);
    EXPECT_EQ(again.seconds, scene.seconds);
    EXPECT_EQ(again.measure, scene.measure);
    EXPECT_EQ(again.metrics.size(), scene.metrics.size());
    ASSERT_EQ(again.bodies.size(), scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      EXPECT_EQ(again.bodies[i].name, scene.bodies[i].name);
      EXPECT_EQ(again.bodies[i].desc.pose.position.x, scene.bodies[i].desc.pose.position.x);
      EXPECT_EQ(again.bodies[i].desc.mass, scene.bodies[i].desc.mass);
      EXPECT_EQ(again.bodies[i].shape.has_value(), scene.bodies[i].shape.has_value());
    }
    ASSERT_EQ(again.joints.size(), scene.joints.size());
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
      EXPECT_EQ(again.joints[i].desc.type, scene.joints[i].desc.type);
      EXPECT_EQ(again.joints[i].desc.frame_b.position.y, scene.joints[i].desc.frame_b.position.y);
    }
    ASSERT_EQ(again.host.size(), scene.host.size());
    for (std::size_t i = 0; i < scene.host.size(); ++i) {
      EXPECT_EQ(again.host[i].kind, scene.host[i].kind);
      EXPECT_EQ(again.host[i].target, scene.host[i].target);
      EXPECT_EQ(again.host[i].end, scene.host[i].end);
      ASSERT_EQ(again.host[i].numbers.size(), scene.host[i].numbers.size());
      for (std::size_t k = 0; k < scene.host[i].numbers.size(); ++k)
        EXPECT_NEAR(again.host[i].numbers[k].constant, scene.host[i].numbers[k].constant, 1e-12);
    }
  }
}

TEST(Reduction, LeavesWhatIsToBlame) {
  const Json whole = plain("E1");
  ASSERT_GE(whole.at("bodies").size(), 5u);
  const std::string body = whole.at("bodies")[3].at("name"), joint = whole.at("joints")[2].at("name");
  std::size_t asked = 0, told = 0;
  const Json left = reduced(
      whole,
      [&](const Json& scene) {
        ++asked;
        return has(scene, "bodies", body) && has(scene, "joints", joint);
      },
      [&](const Json& scene) {
        ++told;
        EXPECT_LE(scene.at("bodies").size(), whole.at("bodies").size());
      });
  EXPECT_TRUE(has(left, "bodies", body));
  ASSERT_EQ(left.at("joints").size(), 1u);
  EXPECT_EQ(left.at("joints")[0].at("name"), joint);
  EXPECT_LE(left.at("bodies").size(), 3u) << "the body, and those that the joint joins";
  EXPECT_LT(left.at("seconds").get<double>(), 0.1);
  EXPECT_GT(asked, told);
  EXPECT_EQ(load(left).joints.size(), 1u);
}

/// Whoever is gone takes along what speaks of it.
TEST(Reduction, LeavesNothingThatNamesTheGone) {
  const Json whole = plain("I36");
  for (std::size_t i = 0; i < whole.at("bodies").size(); ++i) {
    const Json less = without(whole, {Json::json_pointer("/bodies") / i});
    const std::string gone = whole.at("bodies")[i].at("name");
    EXPECT_FALSE(has(less, "bodies", gone));
    if (less.contains("joints"))
      for (const Json& joint : less.at("joints")) {
        EXPECT_NE(joint.value("body_a", ""), gone);
        EXPECT_NE(joint.at("body_b"), gone);
      }
    for (const auto& [name, quantity] : less.at("measure").at("quantities").items()) {
      EXPECT_NE(quantity.value("body", ""), gone);
      EXPECT_TRUE(less.at("metrics").contains(name));
    }
    EXPECT_EQ(less.at("measure").at("quantities").size(), less.at("metrics").size());
  }
}

}  // namespace
}  // namespace plumb::harness
