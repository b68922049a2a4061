// A scene as a page builds it: the words of api/web, and numbers with all their bits.
#include <gtest/gtest.h>

#include <fstream>

#include "replay/live_world.hpp"

namespace plumb::harness {
namespace {

Scene scene_of(const char* text) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "L1-live.json";
  std::ofstream(file) << text;
  return SceneFile::load(file).instantiate({});
}

const char* const machine = R"({
  "id": "L1", "slug": "live", "title": "Live", "doc": "for this test",
  "parameters": { "m": { "default": 0.1, "unit": "kg", "doc": "mass" } },
  "needs": ["rotation", "collision", "friction", "joints", "contact_impulses", "kinematic"],
  "seconds": 2,
  "shapes": {
    "box": { "type": "box", "half_extents": [0.5, 0.25, 0.1] },
    "rock": { "type": "convex_hull", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] },
    "both": { "type": "compound", "children": [{ "shape": "box" }, { "shape": "rock", "position": [1, 0, 0] }] }
  },
  "bodies": [
    { "name": "arm", "shape": "box", "mass": "m / 3", "restitution": 0.5, "position": [0, 2, 0] },
    { "name": "stone", "shape": "both", "motion": "kinematic" }
  ],
  "joints": [
    { "name": "elbow", "type": "hinge", "body_b": "arm", "limits": { "rx": { "lower": -1, "upper": 1 } }, "cut": 1.5 }
  ],
  "host": [{ "body": "stone", "position": ["0.1 * t", 0, 0] }],
  "measure": { "kind": "quantities", "quantities": { "fell": { "body": "arm", "quantity": "position", "along": "y" } } },
  "metrics": { "fell": { "unit": "m", "doc": "height" } }
})";

TEST(LiveWorld, SaysWhatTheSceneSaysInTheWordsOfTheWeb) {
  const Json world = live_world(scene_of(machine));
  EXPECT_EQ(world["needs"],
            Json({"rotation", "collision", "friction", "restitution", "joints", "contactImpulses", "kinematic"}))
      << "restitution is what a body has";
  EXPECT_EQ(world["shapes"][1]["type"], "hull");
  EXPECT_EQ(world["shapes"][1]["vertices"].size(), 12u);
  EXPECT_EQ(world["shapes"][2]["children"][1]["shape"], 1);
  EXPECT_EQ(world["bodies"][1]["motion"], "kinematic");
  const Json joint = world["joints"][0];
  EXPECT_EQ(joint["type"], "hinge");
  EXPECT_FALSE(joint.contains("a")) << "the world";
  EXPECT_EQ(joint["limits"], Json({{"angularX", {-1.0, 1.0}}}));
  EXPECT_EQ(world["cuts"], Json::array({Json::array({0, 1.5})}));
  EXPECT_EQ(world["host"][0]["kind"], "path");
  EXPECT_EQ(world["host"][0]["numbers"][0], "0.1 * t");
  EXPECT_EQ(world["host"][0]["numbers"][1], 0.0);
  EXPECT_EQ(world["header"]["bodies"][0]["name"], "arm");
}

TEST(LiveWorld, NumbersKeepAllTheirBits) {
  const Json world = Json::parse(line_of(live_world(scene_of(machine))));
  EXPECT_EQ(world["bodies"][0]["mass"].get<double>(), 0.1 / 3);
  const Json mass = world["masses"][0];
  EXPECT_EQ(mass.size(), 10u);
  EXPECT_EQ(mass[0].get<double>(), 0.1 / 3);
  EXPECT_NEAR(mass[4].get<double>(), 0.1 / 3 * (0.25 * 0.25 + 0.1 * 0.1) / 3, 1e-15);
  EXPECT_EQ(world["masses"][1][0], 0.0) << "what is not dynamic has none";
}

}  // namespace
}  // namespace plumb::harness
