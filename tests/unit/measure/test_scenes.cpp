// All scene files against the measures: every cell can be made, and its measure knows its arguments. The start of
// scenes whose bodies should just touch is checked by the referee.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/registry/registry.hpp"
#include "measure/stacking/stacking.hpp"
#include "truth/limit_analysis.hpp"

namespace plumb::harness {
namespace {

std::vector<SceneFile> scenes_of(const std::string& group) {
  std::vector<SceneFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(PLUMB_SCENES_FOLDER) / group))
    files.push_back(SceneFile::load(entry.path()));
  return files;
}

std::vector<PoseRow> start_of(const Scene& scene) {
  std::vector<PoseRow> poses;
  for (const SceneBody& body : scene.bodies) poses.push_back({body.desc.pose.position, body.desc.pose.orientation});
  return poses;
}

class SceneGroup : public testing::TestWithParam<const char*> {};

TEST_P(SceneGroup, EveryCellHasItsMeasure) {
  for (const SceneFile& file : scenes_of(GetParam())) {
    EXPECT_NO_THROW(static_cast<void>(find_measure(file))) << file.path;
    EXPECT_EQ(file.group, GetParam());
    for (const Parameters& variant : file.variants) {
      const Scene scene = file.instantiate(variant);
      EXPECT_FALSE(scene.bodies.empty()) << file.path;
      EXPECT_FALSE(scene.metrics.empty()) << file.path;
    }
  }
}

TEST_P(SceneGroup, JointsFitAtTheStart) {
  for (const SceneFile& file : scenes_of(GetParam())) {
    if (file.id == "E3" || file.id == "P7") continue;  // a measure places the planks; published hips start apart
    for (const Parameters& variant : file.variants) {
      if (variant.contains("case") && variant.at("case") == ParameterValue("stretched")) continue;
      const Scene scene = file.instantiate(variant);
      const double digits = file.group == "published" ? 1e-9 : 1e-12;  // those of the numbers in the file
      EXPECT_LT(RefereeView(scene).joint_gap(start_of(scene)), digits) << file.path;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Groups, SceneGroup,
                         testing::Values("stacking", "joints", "machines", "robustness", "scale", "published"),
                         [](const auto& group) { return std::string(group.param); });

TEST(StackingScenes, NothingOverlapsAtTheStart) {
  for (const SceneFile& file : scenes_of("stacking")) {
    for (const Parameters& variant : file.variants) {
      const Scene scene = file.instantiate(variant);
      EXPECT_LT(RefereeView(scene).penetration(start_of(scene)).max, 1e-12) << file.path;
    }
  }
}

TEST(MachineScenes, NothingOverlapsAtTheStart) {
  for (const SceneFile& file : scenes_of("machines")) {
    for (const Parameters& variant : file.variants) {
      const Scene scene = file.instantiate(variant);
      if ((scene.needs & PLUMB_NEED_COLLISION) == 0) continue;
      EXPECT_LT(RefereeView(scene).penetration(start_of(scene)).max, 1e-9) << file.path;
    }
  }
}

/// The wall of D11 in its plane, as the scene has it: faces where bricks lie on each other.
TEST(StackingScenes, TheWallCanStand) {
  const Scene scene = SceneFile::load(std::filesystem::path(PLUMB_SCENES_FOLDER) / "stacking" / "D11-masonry.json")
                          .instantiate({{"structure", std::string("wall")}});
  truth::PlaneStructure wall;
  for (const std::size_t brick : arg_bodies(scene, "blocks")) {
    const PlumbVec3 at = scene.bodies[brick].desc.pose.position;
    const auto index = static_cast<int>(wall.blocks.size());
    if (at.y < 0.5) wall.add_face(truth::PlaneContact::ground, index, {at.x - 0.5, 0}, {at.x + 0.5, 0}, {0, 1}, 0.5);
    for (int below = 0; below < index; ++below) {
      const Eigen::Vector2d under = wall.blocks[static_cast<std::size_t>(below)].centre;
      const double left = std::max(at.x, under.x()) - 0.5, right = std::min(at.x, under.x()) + 0.5;
      if (std::abs(at.y - under.y() - 0.5) > 1e-9 || right - left < 1e-9) continue;
      wall.add_face(below, index, {left, at.y - 0.25}, {right, at.y - 0.25}, {0, 1}, 0.5);
    }
    wall.blocks.push_back({{at.x, at.y}, 1});
  }
  EXPECT_EQ(wall.contacts.size(), 2u * (8 + 7 * 15));
  EXPECT_TRUE(truth::can_stand(wall));
}

TEST(RefereeView, WeighsATowerAndSeesAnOverlap) {
  const Scene scene = SceneFile::load(std::filesystem::path(PLUMB_SCENES_FOLDER) / "stacking" / "D1-tower.json")
                          .instantiate({{"H", 3.0}});
  const RefereeView view(scene);
  EXPECT_DOUBLE_EQ(view.total_mass(), 3000);
  std::vector<PoseRow> poses = start_of(scene);
  poses[3].position.y -= 0.25;
  const DepthSummary depth = depth_summary(view.penetration(poses));
  EXPECT_NEAR(depth.max, 0.25, 1e-12);
  poses[1].position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(depth_summary(view.penetration(poses)).max));
}

TEST(Towers, StandWhileTheTopIsUp) {
  const Scene scene = SceneFile::load(std::filesystem::path(PLUMB_SCENES_FOLDER) / "stacking" / "D1-tower.json")
                          .instantiate({{"H", 10.0}});
  const std::vector<std::size_t> boxes = arg_bodies(scene, "boxes");
  ASSERT_EQ(boxes.size(), 10u);
  const auto with = [&](const std::function<void(std::vector<PoseRow>&)>& change) {
    std::vector<PoseRow> poses = start_of(scene);
    change(poses);
    return std::pair(tower_stands(scene, poses, boxes), tower_is_intact(scene, poses, boxes));
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(with([](auto&) {}), std::pair(true, true));
  EXPECT_EQ(with([&](auto& poses) {  // each 9 cm into the one below: the top is .9 m down
              for (std::size_t i = 0; i < 10; ++i) poses[boxes[i]].position.y -= 0.09 * static_cast<double>(i + 1);
            }),
            std::pair(true, true));
  EXPECT_EQ(with([&](auto& poses) {  // the top is 1.1 m down
              for (std::size_t i = 0; i < 10; ++i) poses[boxes[i]].position.y -= 0.11 * static_cast<double>(i + 1);
            }),
            std::pair(false, true));
  EXPECT_EQ(with([&](auto& poses) { poses[boxes[4]].position.x += 0.51; }), std::pair(true, false));
  EXPECT_EQ(with([&](auto& poses) { poses[boxes[9]].position.y = 0.5; }), std::pair(false, false));
  EXPECT_EQ(with([&](auto& poses) { poses[boxes[0]].position.x += 0.51; }), std::pair(true, false));
  EXPECT_EQ(with([&](auto& poses) { poses[boxes[9]].position.y = nan; }), std::pair(false, false));
}

TEST(RefereeView, LeavesOutBodiesThatAJointKeepsApart) {
  const auto folder = std::filesystem::path(PLUMB_SCENES_FOLDER) / "joints";
  const Scene scene = SceneFile::load(folder / "E1-chain.json").instantiate({{"L", 4.0}});
  std::vector<PoseRow> poses = start_of(scene);
  poses[1].position.x -= 0.25;  // into its neighbour, to which it is joined
  EXPECT_LT(RefereeView(scene).penetration(poses).max, 1e-12);
  EXPECT_NEAR(RefereeView(scene).joint_gap(poses), 0.25, 1e-12);
  poses[3].position.x -= 1.75;  // into the same one, to which it is not
  EXPECT_GT(RefereeView(scene).penetration(poses).max, 0.1);
}

}  // namespace
}  // namespace plumb::harness
