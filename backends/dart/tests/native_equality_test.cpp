// The adapter runs DART's phases by itself: what comes out is what the step of DART's own world gives.
#include <gtest/gtest.h>

#include "native_scene.hpp"
#include "plumb_scene.hpp"

namespace {

using namespace scenes;

/// A slab thrown so that it turns about all of its axes.
Scene slab() {
  Item item = box({0, 5, 0}, {0.5, 0.1, 0.3}, 3);
  item.velocity = {1, 2, -3};
  item.spin = {0.5, 4, -2};
  return {"slab", {item}, {}};
}

class NativeEquality : public testing::TestWithParam<Scene> {};

TEST_P(NativeEquality, HoldsForTwoSeconds) {
  const Scene& scene = GetParam();
  PlumbScene ours(scene);
  NativeScene native(scene);
  double way = 0;
  for (int step = 0; step < 120; ++step) {
    advance(*ours.world);
    native.step();
    for (std::size_t i = 0; i < scene.items.size(); ++i) {
      const auto pose = read_row<7>(*ours.world, PLUMB_FIELD_POSE, ours.bodies[i]);
      const Eigen::Vector3d expected = native.position(i);
      for (int k = 0; k < 3; ++k)
        ASSERT_NEAR(pose[static_cast<std::size_t>(k)], expected[k], 1e-9) << "body " << i << " in step " << step;
      way += std::abs(pose[1] - scene.items[i].pose.position.y);
    }
  }
  EXPECT_GT(way, 1) << "a scene that does not move would be equal without being tested";
}

INSTANTIATE_TEST_SUITE_P(Scenes, NativeEquality, testing::Values(chain(10), pendulum(), slab()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
