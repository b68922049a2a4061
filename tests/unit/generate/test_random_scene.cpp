// Random scenes are scenes: whatever the seed, files load, nothing overlaps and no joint is open at the start.
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "convert/scene_text.hpp"
#include "generate/random_scene.hpp"
#include "measure/instruments/referee_view.hpp"
#include "referee/mass.hpp"

namespace plumb::harness {
namespace {

Scene scene_of(const Json& json) {
  const std::string file = ::testing::TempDir() + "random-scene.json";
  std::ofstream(file) << scene_text(json);
  return SceneFile::load(file).instantiate({});
}

std::vector<PoseRow> start_of(const Scene& scene) {
  std::vector<PoseRow> rows;
  for (const SceneBody& body : scene.bodies) {
    const PlumbPose& p = body.desc.pose;
    rows.push_back(
        {p.position.x, p.position.y, p.position.z, p.orientation.x, p.orientation.y, p.orientation.z, p.orientation.w});
  }
  return rows;
}

std::string features_in(const Json& json) {
  const std::string doc = json.at("doc");
  return doc.substr(doc.find("It has: "));
}

TEST(RandomScenes, BeginInOrder) {
  RandomSceneRequest request;
  for (request.seed = 0; request.seed < 300; ++request.seed) {
    SCOPED_TRACE("seed " + std::to_string(request.seed));
    request.most_bodies = request.seed % 7 == 0 ? 2 : 30;
    const Scene scene = scene_of(random_scene(request));
    EXPECT_EQ(scene.id, "R" + std::to_string(request.seed));
    const RefereeView view(scene);
    const std::vector<PoseRow> start = start_of(scene);
    const referee::JointError error = view.joint_error(start);
    EXPECT_LT(error.position, 1e-9);
    EXPECT_LT(error.angle, 1e-7);
    EXPECT_LT(error.limit_position, 1e-9);
    EXPECT_LT(error.limit_angle, 1e-9);
    EXPECT_EQ(view.penetration(start).overlaps.size(), 0u);
    const auto moving = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                      [](const SceneBody& body) { return body.desc.motion == PLUMB_DYNAMIC; });
    EXPECT_GE(moving, 2);
    EXPECT_LE(moving, static_cast<std::ptrdiff_t>(request.most_bodies) + 1) << "and a load";
  }
}

TEST(RandomScenes, HaveMassesWithinTheRatio) {
  RandomSceneRequest request;
  request.mass_ratio = 9;
  request.without = {Feature::load};
  for (request.seed = 0; request.seed < 100; ++request.seed) {
    const Scene scene = scene_of(random_scene(request));
    const RefereeView view(scene);
    for (const referee::Mass& mass : view.masses()) {
      if (mass.mass > 0) {
        EXPECT_TRUE(mass.mass >= 5.0 / 3 && mass.mass <= 15) << mass.mass;
      }
    }
  }
}

TEST(RandomScenes, AreTheSameOfTheSameSeed) {
  RandomSceneRequest request;
  request.seed = 17;
  const Json once = random_scene(request);
  EXPECT_EQ(once, random_scene(request));
  request.seed = 18;
  EXPECT_NE(once.at("bodies"), random_scene(request).at("bodies"));
}

TEST(RandomScenes, LeaveOutWhatTheyAreTold) {
  std::set<std::string> seen;
  RandomSceneRequest request;
  for (request.seed = 0; request.seed < 60; ++request.seed) {
    request.without = {};
    const std::string all = features_in(random_scene(request));
    for (const std::string& word : feature_words())
      if (all.find(word) != std::string::npos) seen.insert(word);
    request.without = {Feature::joints, Feature::terrain};
    const Json less = random_scene(request);
    EXPECT_FALSE(less.contains("joints"));
    EXPECT_EQ(features_in(less).find("terrain"), std::string::npos);
  }
  EXPECT_EQ(seen.size(), feature_count) << "each is in some scene";
  EXPECT_EQ(feature_words().size(), feature_count);
  EXPECT_THROW(static_cast<void>(feature_of("terain")), UsageError);
}

TEST(RandomScenes, HaveSocketsAndLedSpringsWhereTheySaySo) {
  RandomSceneRequest request;
  int sockets = 0, led = 0;
  for (request.seed = 0; request.seed < 200; ++request.seed) {
    const Json json = random_scene(request);
    const std::string features = features_in(json);
    const auto says = [&](const char* word) { return features.find(word) != std::string::npos; };
    for (const Json& joint : json.value("joints", Json::array())) {
      if (joint.at("type") != "swing_twist") continue;
      EXPECT_TRUE(says("sockets")) << request.seed;
      ++sockets;
    }
    for (const Json& action : json.value("host", Json::array())) {
      if (!action.contains("targets")) continue;
      EXPECT_TRUE(says("targets") && says("springs")) << request.seed;
      ++led;
    }
  }
  EXPECT_GT(sockets, 20);
  EXPECT_GT(led, 20);
}

/// What nobody drives makes no energy, and only that is judged by it.
TEST(RandomScenes, JudgeEnergyWhereNobodyDrives) {
  RandomSceneRequest request;
  int driven = 0, alone = 0;
  for (request.seed = 0; request.seed < 100; ++request.seed) {
    const Json json = random_scene(request);
    bool drives = json.contains("host");
    for (const Json& body : json.at("bodies")) drives = drives || body.contains("surface_velocity");
    if (json.contains("joints"))
      for (const Json& joint : json.at("joints"))
        if (joint.contains("motors"))
          for (const Json& motor : joint.at("motors")) drives = drives || motor.at("target_velocity") != 0;
    EXPECT_EQ(json.at("metrics").contains("energy_made"), !drives) << request.seed;
    ++(drives ? driven : alone);
  }
  EXPECT_GT(driven, 10);
  EXPECT_GT(alone, 10);
}

}  // namespace
}  // namespace plumb::harness
