// Save, go on, restore, go on again: the same bits.
#include <gtest/gtest.h>

#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

constexpr PlumbNeeds needs = usual_needs | PLUMB_NEED_SNAPSHOT | PLUMB_NEED_KINEMATIC | PLUMB_NEED_EVENTS;

/// Everything that moves: boxes that fall on each other, a chain, a kinematic sweeper, a static that is moved.
struct Scene {
  explicit Scene(PlumbNeeds more, std::vector<PlumbSetting> settings = {}) : world(needs | more, std::move(settings)) {
    ground = world.fixed(world.box(20, 1, 20), {0, -1, 0});
    const PlumbShape box = world.box(.5, .5, .5);
    for (int i = 0; i < 20; ++i) bodies.push_back(world.dynamic(box, {.3 * (i % 3), .6 + 1.1 * i, .2 * (i % 4)}));
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_BALL);
    desc.body_a = bodies[0];
    desc.body_b = bodies[1];
    desc.frame_a.position = {0, .55, 0};
    desc.frame_b.position = {0, -.55, 0};
    world.joint(desc);
    PlumbBodyDesc sweeper = body_desc(PLUMB_KINEMATIC);
    sweeper.shape = box;
    sweeper.pose.position = {-4, .5, 0};
    sweeper.linear_velocity = {1, 0, 0};
    bodies.push_back(world.body(sweeper));
    bodies.push_back(ground);
  }
  [[nodiscard]] std::vector<double> rows() const {
    std::vector<double> all;
    for (const PlumbBody body : bodies)
      for (const PlumbField field : {PLUMB_FIELD_POSE, PLUMB_FIELD_VELOCITY, PLUMB_FIELD_AWAKE})
        for (const double value : world.row(body, field)) all.push_back(value);
    return all;
  }
  [[nodiscard]] std::vector<std::byte> save() const {
    std::span<const std::byte> data;
    check(*world, world->snapshot()->save(data));
    return {data.begin(), data.end()};
  }
  void restore(const std::vector<std::byte>& data) const { check(*world, world->snapshot()->restore(data)); }

  TestWorld world;
  PlumbBody ground;
  std::vector<PlumbBody> bodies;
};

void expect_the_same_again(const Scene& scene, int before, int after) {
  scene.world.step(before);
  const auto saved = scene.save();
  scene.world.step(after);
  const auto first = scene.rows();
  const std::vector<PlumbEvent> events(scene.world->events().begin(), scene.world->events().end());
  scene.restore(saved);
  scene.world.step(after);
  EXPECT_EQ(scene.rows(), first);
  EXPECT_EQ(scene.world->events().size(), events.size());
}

TEST(Snapshot, GivesTheSameBits) {
  for (const int before : {1, 40, 200}) expect_the_same_again(Scene(0), before, 100);
}

TEST(Snapshot, GivesTheSameBitsWhileBodiesFallAsleep) {
  for (const int before : {100, 250, 400})
    expect_the_same_again(Scene(PLUMB_NEED_SLEEPING, {setting("auto_disable_linear_threshold", .2),
                                                      setting("auto_disable_angular_threshold", .2)}),
                          before, 150);
}

TEST(Snapshot, GivesTheSameBitsAfterATeleport) {
  const Scene scene(0, {setting("space", "simple")});
  scene.world.step(20);
  scene.world.write(scene.ground, PLUMB_FIELD_POSE, {0, -1.5, 0, 0, 0, 0, 1});
  scene.world.write(scene.bodies[3], PLUMB_FIELD_POSE, {0, 30, 0, 0, 0, 0, 1});
  expect_the_same_again(scene, 0, 150);
}

// The test above would mean little if the order of the space's list did not matter.
TEST(Snapshot, OfAnotherStateDiffers) {
  const Scene scene(0);
  scene.world.step(60);
  const auto saved = scene.save();
  scene.world.step(60);
  const auto later = scene.rows();
  scene.restore(saved);
  EXPECT_NE(scene.rows(), later);
}

TEST(Snapshot, OfOtherShapesIsRefused) {
  const TestWorld round(needs), bare(needs);
  round.dynamic(round.sphere(.5), {0, 1, 0});
  PlumbBodyDesc desc = body_desc();
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = 1;
  desc.inertia = {1, 1, 1};
  bare.body(desc);
  std::span<const std::byte> data;
  check(*round, round->snapshot()->save(data));
  EXPECT_EQ(bare->snapshot()->restore(data), PLUMB_E_CORRUPT);
}

TEST(Snapshot, IsRefusedWhereOdeKeepsItsOrderToItself) {
  const Scene scene(0, {setting("space", "sap")});
  std::span<const std::byte> data;
  EXPECT_EQ(scene.world->snapshot()->save(data), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(scene.world->error_text().find("space=hash"), std::string::npos);
}

}  // namespace
}  // namespace plumb::ode_test
