// The adapter adds nothing and loses nothing: its trajectories are those of a program written straight against the
// engine, bit for bit. native_scene.hpp is each engine's.
#include <gtest/gtest.h>

#include <cstring>

#include "native_scene.hpp"
#include "plumb_scene.hpp"

namespace {

class NativeEquality : public testing::TestWithParam<scenes::Scene> {};

TEST_P(NativeEquality, HoldsBitForBit) {
  const scenes::Scene& scene = GetParam();
  scenes::PlumbScene ours(scene);
  scenes::NativeScene native(scene);
  double way = 0;  // a scene that does not move would be equal without being tested
  for (int step = 0; step < 300; ++step) {
    scenes::advance(*ours.world);
    native.step(1.0 / 60);
    for (std::size_t i = 0; i < scene.items.size(); ++i) {
      const auto pose = scenes::read_row<7>(*ours.world, PLUMB_FIELD_POSE, ours.bodies[i]);
      const auto velocity = scenes::read_row<6>(*ours.world, PLUMB_FIELD_VELOCITY, ours.bodies[i]);
      const auto expected = native.state(i);
      ASSERT_EQ(0, std::memcmp(pose.data(), expected.data(), sizeof pose)) << "pose of " << i << " in step " << step;
      ASSERT_EQ(0, std::memcmp(velocity.data(), expected.data() + 7, sizeof velocity))
          << "velocity of " << i << " in step " << step;
      way += std::abs(velocity[0]) + std::abs(velocity[1]);
    }
  }
  EXPECT_GT(way, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Scenes, NativeEquality,
                         testing::Values(scenes::tower(10), scenes::pyramid(10), scenes::pile(64), scenes::chain(10),
                                         scenes::pendulum()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
