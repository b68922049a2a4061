// The adapter runs MuJoCo's phases by itself: what comes out is what mj_step gives. Both work in double; the rounding
// of sub-steps that are put together in another order grows slowly where contacts are many.
#include <gtest/gtest.h>

#include "native_scene.hpp"
#include "plumb_scene.hpp"

namespace {

class NativeEquality : public testing::TestWithParam<scenes::Scene> {};

TEST_P(NativeEquality, HoldsForTwoSeconds) {
  const scenes::Scene& scene = GetParam();
  scenes::PlumbScene ours(scene);
  scenes::NativeScene native(scene);
  double way = 0;
  for (int step = 0; step < 120; ++step) {
    scenes::advance(*ours.world);
    native.step();
    for (std::size_t i = 0; i < scene.items.size(); ++i) {
      const auto pose = scenes::read_row<7>(*ours.world, PLUMB_FIELD_POSE, ours.bodies[i]);
      const PlumbVec3 expected = native.position(i), start = scene.items[i].pose.position;
      ASSERT_NEAR(pose[0], expected.x, 1e-6) << "body " << i << " in step " << step;
      ASSERT_NEAR(pose[1], expected.y, 1e-6) << "body " << i << " in step " << step;
      ASSERT_NEAR(pose[2], expected.z, 1e-6) << "body " << i << " in step " << step;
      way += std::abs(pose[0] - start.x) + std::abs(pose[1] - start.y);
    }
  }
  EXPECT_GT(way, 1e-3) << "a scene that does not move would be equal without being tested";
}

INSTANTIATE_TEST_SUITE_P(Scenes, NativeEquality,
                         testing::Values(scenes::tower(5), scenes::pyramid(4), scenes::pile(8), scenes::chain(10),
                                         scenes::pendulum()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
