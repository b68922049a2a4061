// Snapshots: the same steps from a restored state give the same bits, whatever was under way when it was saved.
#include <gtest/gtest.h>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

std::vector<std::byte> save(Scene& scene) {
  std::span<const std::byte> bytes;
  check(scene.world(), scene.world().snapshot()->save(bytes));
  return {bytes.begin(), bytes.end()};
}
void restore(Scene& scene, const std::vector<std::byte>& bytes) {
  check(scene.world(), scene.world().snapshot()->restore(bytes));
}

NamedScene savable(NamedScene scene) {
  scene.needs |= PLUMB_NEED_SNAPSHOT;
  return scene;
}

struct Snapshots : ::testing::TestWithParam<NamedScene> {};

/// Saved at a step at which bodies are under way, restored 40 steps later into the same world and into another.
TEST_P(Snapshots, TheSameBitsAgain) {
  for (const int at : {0, 1, 30, 61}) {
    const auto one = build(engine(), savable(GetParam()), 1), other = build(engine(), savable(GetParam()), 3);
    one->before_step = other->before_step = nullptr;
    one->run(at);
    const std::vector<std::byte> saved = save(*one);
    const std::uint64_t then = one->hash();
    one->run(40);
    const std::uint64_t end = one->hash();
    restore(*one, saved);
    EXPECT_EQ(one->hash(), then) << "after " << at;
    one->run(40);
    EXPECT_EQ(one->hash(), end) << "after " << at;
    restore(*other, saved);
    other->run(40);
    EXPECT_EQ(other->hash(), end) << "after " << at << ", in another world";
  }
}

std::vector<NamedScene> scenes() {
  std::vector<NamedScene> all;
  for (const NamedScene& scene : named_scenes())
    if (const std::string_view name = scene.name; name != "pile-1000" && name != "puppets" && name != "clockwork")
      all.push_back(scene);
  return all;  // without what takes long, and those whose joints break: a snapshot is of the joints that there are
}
INSTANTIATE_TEST_SUITE_P(Of, Snapshots, ::testing::ValuesIn(scenes()), [](const auto& scene) {
  std::string name = scene.param.name;
  std::erase(name, '-');
  return name;
});

constexpr PlumbNeeds kSnapshotNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_SNAPSHOT;

struct Heap {
  explicit Heap(PlumbNeeds more = 0) : scene(engine(), kSnapshotNeeds | more, kDown, 1) {
    scene.ground();
    const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
    for (int i = 0; i < 12; ++i) bodies.push_back(scene.add(cube, {0.3 * (i % 3), 0.6 + 1.1 * i, 0.1 * (i % 2)}));
  }
  Scene scene;
  std::vector<PlumbBody> bodies;
};

/// Forces and targets that wait for the next step belong to the state.
TEST(Snapshot, HoldsWhatWaitsForTheNextStep) {
  Heap heap(PLUMB_NEED_FORCES | PLUMB_NEED_KINEMATIC);
  const PlumbBody sled = heap.scene.add_kinematic(heap.scene.box({1, 0.2, 1}), {4, 0.3, 0});
  heap.scene.run(20);
  heap.scene.target(sled, {3.8, 0.3, 0});
  heap.scene.write(PLUMB_FIELD_FORCE, heap.bodies[3], {1e4, 2e4, 0});
  const std::vector<std::byte> saved = save(heap.scene);
  heap.scene.run(30);
  const std::uint64_t end = heap.scene.hash();
  heap.scene.write(PLUMB_FIELD_FORCE, heap.bodies[5], {-1e4, 2e4, 0});
  restore(heap.scene, saved);
  heap.scene.run(30);
  EXPECT_EQ(heap.scene.hash(), end);
}

/// Steps of other lengths bound the statics otherwise: that comes back too.
TEST(Snapshot, HoldsUnderStepsOfAnyLength) {
  Heap heap;
  PlumbStepReport report{};
  const auto step = [&](double dt) {
    check(heap.scene.world(), heap.scene.world().step(dt));
    check(heap.scene.world(), heap.scene.world().wait(report));
  };
  const auto go = [&] {
    for (int i = 0; i < 40; ++i) step(i % 3 == 0 ? 0.01 : 0.02);
    return heap.scene.hash();
  };
  step(0.002);
  const std::vector<std::byte> saved = save(heap.scene);
  const std::uint64_t end = go();
  restore(heap.scene, saved);
  EXPECT_EQ(go(), end);
}

/// Motors, limits and springs go on from the impulses that they had.
TEST(Snapshot, HoldsWhatJointsBear) {
  Heap heap(PLUMB_NEED_JOINTS);
  PlumbJointDesc hinge = joint_desc(PLUMB_JOINT_HINGE);
  hinge.limits[3] = {-0.5, 0.7, 1, 0};
  hinge.motors[3] = {3, 400, 1, 0};
  hinge.springs[3] = {0.2, 2, 0.4, 1, 0};
  for (std::size_t i = 1; i < heap.bodies.size(); ++i) {
    hinge.body_a = heap.bodies[i - 1];
    hinge.body_b = heap.bodies[i];
    hinge.frame_a.position = {0, 0.55, 0};
    hinge.frame_b.position = {0, -0.55, 0};
    PlumbJoint id = 0;
    check(heap.scene.world(), heap.scene.world().joints()->create_joints({&hinge, 1}, {&id, 1}));
  }
  heap.scene.run(25);
  const std::vector<std::byte> saved = save(heap.scene);
  heap.scene.run(40);
  const std::uint64_t end = heap.scene.hash();
  restore(heap.scene, saved);
  heap.scene.run(40);
  EXPECT_EQ(heap.scene.hash(), end);
}

/// Bodies and joints that came after it and are gone again leave no trace.
TEST(Snapshot, IsOfTheBodiesThatLive) {
  Heap heap(PLUMB_NEED_JOINTS | PLUMB_NEED_SLEEPING);
  heap.scene.run(20);
  const std::vector<std::byte> saved = save(heap.scene);
  heap.scene.run(40);
  const std::uint64_t end = heap.scene.hash();
  std::vector<PlumbBody> passing;
  PlumbShapeDesc plane = shape_desc(PLUMB_PLANE);
  PlumbShape below = 0;
  check(heap.scene.world(), heap.scene.world().create_shapes({&plane, 1}, {&below, 1}));
  passing.push_back(heap.scene.add_static(below, {0, -3, 0}));
  for (int i = 0; i < 3; ++i)
    passing.push_back(heap.scene.add(heap.scene.box({0.5, 0.5, 0.5}), {0.1 * i, 20.0 + i, 0}));
  heap.scene.run(30);
  for (const PlumbBody body : passing) heap.scene.remove(body);
  restore(heap.scene, saved);
  heap.scene.run(40);
  EXPECT_EQ(heap.scene.hash(), end);
}

/// Another world with the same bodies that declared less is told apart.
TEST(Snapshot, OfOtherNeedsIsRefused) {
  Heap one(PLUMB_NEED_SLEEPING), other;
  one.scene.run(10);
  const std::uint64_t before = other.scene.hash();
  EXPECT_EQ(other.scene.world().snapshot()->restore(save(one.scene)), PLUMB_E_CORRUPT);
  EXPECT_EQ(other.scene.hash(), before);
}

/// Contact events tell of what begins and ends since the state that was restored.
TEST(Snapshot, HoldsWhoTouchesWhom) {
  Heap heap(PLUMB_NEED_EVENTS);
  heap.scene.run(60);
  const std::vector<std::byte> saved = save(heap.scene);
  const auto events = [&] {
    std::vector<std::pair<PlumbEventType, PlumbBody>> told;
    for (int i = 0; i < 30; ++i) {
      heap.scene.run(1);
      for (const PlumbEvent& event : heap.scene.world().events()) told.emplace_back(event.type, event.body_a);
    }
    return told;
  };
  const auto first = events();
  ASSERT_FALSE(first.empty());
  restore(heap.scene, saved);
  EXPECT_EQ(events(), first);
}

/// What is foreign or torn is refused in words, and nothing has changed.
TEST(Snapshot, WhatIsNotOneIsRefused) {
  Heap heap;
  heap.scene.run(10);
  const std::vector<std::byte> saved = save(heap.scene);
  heap.scene.run(10);
  const std::uint64_t before = heap.scene.hash();
  const auto refused = [&](std::vector<std::byte> bytes) {
    const PlumbResult result = heap.scene.world().snapshot()->restore(bytes);
    EXPECT_EQ(heap.scene.hash(), before);
    return result;
  };
  std::vector<std::byte> torn = saved, changed = saved;
  torn.pop_back();
  changed[changed.size() / 2] ^= std::byte{1};
  EXPECT_EQ(refused({}), PLUMB_E_CORRUPT);
  EXPECT_EQ(refused(torn), PLUMB_E_CORRUPT);
  EXPECT_EQ(refused(changed), PLUMB_E_CORRUPT);
  heap.scene.add(heap.scene.box({1, 1, 1}), {9, 9, 9});
  const PlumbResult other_bodies = heap.scene.world().snapshot()->restore(saved);
  EXPECT_EQ(other_bodies, PLUMB_E_CORRUPT);
  EXPECT_NE(heap.scene.world().error_text().find("bodies"), std::string::npos) << heap.scene.world().error_text();
}

}  // namespace
}  // namespace plumb::impulse::test
