#include <cmath>

#include "backend_under_test.hpp"
#include "plumb/helpers/debug_lines.hpp"

namespace plumb::helpers::test {
namespace {

TEST(DebugLines, ShowFramesContactsBoxesAndJoints) {
  TestWorld t;
  t.box(PLUMB_STATIC, {5, 1, 5}, {0, -1, 0});
  const PlumbBody box = t.box(PLUMB_DYNAMIC, {0.5, 0.5, 0.5}, {0, 0.5, 0});
  for (int i = 0; i < 30; ++i) t.step(1.0 / 60);
  DebugLines lines(*t.world);
  lines.add_frames(0.5);
  ASSERT_EQ(lines.lines().size(), 6u);
  EXPECT_NEAR(lines.lines()[3].to.x - lines.lines()[3].from.x, 0.5, 1e-4);
  lines.clear();
  lines.add_contacts();
  EXPECT_GE(lines.lines().size(), 4u);
  EXPECT_NEAR(std::abs(lines.lines()[0].to.y - lines.lines()[0].from.y), 0.05, 0.02);
  lines.clear();
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_BALL);
  desc.body_b = box;
  desc.frame_a.position = {0, 2, 0};
  lines.add_joints(std::span(&desc, 1), 0.1);
  ASSERT_EQ(lines.lines().size(), 7u);
  EXPECT_NEAR(lines.lines()[6].to.y - lines.lines()[6].from.y, -1.5, 0.01);
  lines.clear();
  try {
    lines.add_boxes();
    EXPECT_GE(lines.lines().size(), 24u);
    EXPECT_EQ(lines.lines().size() % 12, 0u);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), PLUMB_E_UNSUPPORTED) << error.what();
  }
}

TEST(DebugLines, IslandsHaveColoursOfTheirOwn) {
  EXPECT_EQ(island_colour(3, false), island_colour(3, false));
  EXPECT_NE(island_colour(3, false), island_colour(4, false));
  EXPECT_NE(island_colour(3, false), island_colour(3, true));
}

}  // namespace
}  // namespace plumb::helpers::test
