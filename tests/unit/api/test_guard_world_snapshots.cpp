// The guard of snapshots of a whole world: what the class hears when one is restored, and what is refused before it
// hears of anything.
#include <gtest/gtest.h>

#include "fake_world.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ALL & ~PLUMB_NEED_CCD;

std::unique_ptr<IPhysicsWorld> fake_world(PlumbNeeds needs = kNeeds) {
  return Backend(negotiate(&backend::open<FakeWorld>, "fake")).create_world(world_desc(needs));
}
PlumbShape add_ball(IPhysicsWorld& world, double radius) {
  PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
  desc.radius = radius;
  PlumbShape id = 0;
  EXPECT_EQ(world.create_shapes({&desc, 1}, {&id, 1}), PLUMB_OK) << world.error_text();
  return id;
}
PlumbBody add_body(IPhysicsWorld& world, PlumbShape shape, double mass) {
  PlumbBodyDesc desc = body_desc();
  desc.shape = shape;
  desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
  desc.mass = mass;
  desc.user_data = static_cast<std::uint64_t>(mass) + 100;
  PlumbBody id = 0;
  EXPECT_EQ(world.create_bodies({&desc, 1}, {&id, 1}), PLUMB_OK) << world.error_text();
  return id;
}
PlumbJoint add_hinge(IPhysicsWorld& world, PlumbBody a, PlumbBody b) {
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
  desc.body_a = a;
  desc.body_b = b;
  PlumbJoint id = 0;
  EXPECT_EQ(world.joints()->create_joints({&desc, 1}, {&id, 1}), PLUMB_OK) << world.error_text();
  return id;
}
std::vector<std::byte> save(IPhysicsWorld& world) {
  std::span<const std::byte> bytes;
  EXPECT_EQ(world.snapshot()->save_world(bytes), PLUMB_OK) << world.error_text();
  return {bytes.begin(), bytes.end()};
}
std::vector<PlumbBody> living(IPhysicsWorld& world) {
  const std::span<const PlumbBody> bodies = world.bodies();
  return {bodies.begin(), bodies.end()};
}

struct GuardedWorldSnapshots : ::testing::Test {
  std::unique_ptr<IPhysicsWorld> world = fake_world();
  PlumbShape ball = add_ball(*world, 0.5);
  PlumbBody bodies[3] = {add_body(*world, ball, 1), add_body(*world, ball, 2), add_body(*world, ball, 3)};
  const PlumbBody gone[2] = {add_body(*world, ball, 4), add_body(*world, ball, 5)};
  const PlumbResult slots_are_free = world->destroy_bodies(gone);
  PlumbJoint hinge = add_hinge(*world, bodies[0], bodies[1]);
  std::vector<std::byte> saved = save(*world);

  void refused(const std::string& named, const std::vector<std::byte>& bytes) {
    const std::vector<PlumbBody> before = living(*world);
    FakeWorld::last->made.clear();
    EXPECT_EQ(world->snapshot()->restore(bytes), PLUMB_E_CORRUPT);
    EXPECT_NE(world->error_text().find(named), std::string::npos)
        << "\"" << world->error_text() << "\" does not name " << named;
    EXPECT_EQ(living(*world), before);
    EXPECT_TRUE(FakeWorld::last->made.empty());
  }
};

TEST_F(GuardedWorldSnapshots, WhoIsGoneLivesAgainUnderItsHandle) {
  const std::vector<PlumbBody> before = living(*world);
  ASSERT_EQ(world->joints()->destroy_joints({&hinge, 1}), PLUMB_OK);
  ASSERT_EQ(world->destroy_bodies({&bodies[1], 1}), PLUMB_OK);
  const PlumbBody comer = add_body(*world, ball, 9);
  (void)add_body(*world, ball, 10);
  FakeWorld::last->made.clear();
  FakeWorld::last->handles.clear();
  ASSERT_EQ(world->snapshot()->restore(saved), PLUMB_OK) << world->error_text();
  EXPECT_EQ(living(*world), before) << "in the order in which they were created";
  EXPECT_EQ(FakeWorld::last->handles, std::vector{bodies[1]}) << "the others lived";
  ASSERT_EQ(FakeWorld::last->made.size(), 1U);
  EXPECT_EQ(FakeWorld::last->made[0].mass, 2);
  EXPECT_EQ(FakeWorld::last->made[0].shape, ball);
  EXPECT_EQ(FakeWorld::last->made[0].user_data, 102U);
  EXPECT_EQ(FakeWorld::last->made[0].spinning_friction, slot_of(bodies[1])) << "what the fake reads of all";
  EXPECT_EQ(world->destroy_bodies({&comer, 1}), PLUMB_E_STALE_HANDLE);
  EXPECT_EQ(world->destroy_bodies({&bodies[1], 1}), PLUMB_E_IN_USE) << "its joint lives again";
  EXPECT_EQ(world->joints()->destroy_joints({&hinge, 1}), PLUMB_OK) << world->error_text();
  EXPECT_EQ(world->destroy_bodies(bodies), PLUMB_OK) << world->error_text();
  EXPECT_EQ(world->destroy_shapes({&ball, 1}), PLUMB_OK) << "its uses were counted: " << world->error_text();
}

/// Whatever comes after it gets the handles that it got the first time.
TEST_F(GuardedWorldSnapshots, HandlesComeAgain) {
  ASSERT_EQ(slots_are_free, PLUMB_OK);
  const auto come_and_go = [&] {
    std::vector<PlumbBody> given;
    for (int i = 0; i < 5; ++i) {
      given.push_back(add_body(*world, ball, 4));
      if (i % 2 != 0) continue;
      EXPECT_EQ(world->destroy_bodies({&given.back(), 1}), PLUMB_OK);
    }
    given.push_back(add_hinge(*world, bodies[1], bodies[2]));
    return given;
  };
  const std::vector<PlumbBody> first = come_and_go();
  ASSERT_EQ(world->snapshot()->restore(saved), PLUMB_OK) << world->error_text();
  EXPECT_EQ(come_and_go(), first);
}

/// A body that was made another is made as it was, and with it what joins it.
TEST_F(GuardedWorldSnapshots, WhoHasBecomeAnotherIsMadeAnew) {
  PlumbBodyChange change{};
  change.body = bodies[0];
  change.what = PLUMB_MODIFY_MOTION;
  change.motion = PLUMB_KINEMATIC;
  ASSERT_EQ(world->modify()->modify_bodies({&change, 1}), PLUMB_OK) << world->error_text();
  FakeWorld::last->made.clear();
  ASSERT_EQ(world->snapshot()->restore(saved), PLUMB_OK) << world->error_text();
  ASSERT_EQ(FakeWorld::last->made.size(), 1U);
  EXPECT_EQ(FakeWorld::last->made[0].motion, PLUMB_DYNAMIC);
  FakeWorld::last->made.clear();
  ASSERT_EQ(world->snapshot()->restore(saved), PLUMB_OK) << world->error_text();
  EXPECT_TRUE(FakeWorld::last->made.empty()) << "all is as it was";
}

TEST_F(GuardedWorldSnapshots, JointsAreEnabledAsTheyWere) {
  PlumbJointChange change{};
  change.joint = hinge;
  change.what = PLUMB_MODIFY_ENABLED;
  ASSERT_EQ(world->modify()->modify_joints({&change, 1}), PLUMB_OK) << world->error_text();
  const std::vector<std::byte> disabled = save(*world);
  ASSERT_EQ(world->snapshot()->restore(saved), PLUMB_OK) << world->error_text();
  FakeWorld::last->joint_changes.clear();
  ASSERT_EQ(world->snapshot()->restore(disabled), PLUMB_OK) << world->error_text();
  ASSERT_EQ(FakeWorld::last->joint_changes.size(), 1U);
  EXPECT_EQ(FakeWorld::last->joint_changes[0].enabled, 0U);
  EXPECT_EQ(FakeWorld::last->joint_changes[0].joint, hinge);
}

TEST_F(GuardedWorldSnapshots, PairsAreKeptApartAsTheyWere) {
  const PlumbBodyPair apart{bodies[0], bodies[2]}, other{bodies[1], bodies[2]};
  ASSERT_EQ(world->exceptions()->set_exceptions({&apart, 1}, false), PLUMB_OK);
  saved = save(*world);
  ASSERT_EQ(world->exceptions()->set_exceptions({&other, 1}, false), PLUMB_OK);
  ASSERT_EQ(world->destroy_bodies({&bodies[2], 1}), PLUMB_OK) << world->error_text();
  FakeWorld::last->exception_calls.clear();
  ASSERT_EQ(world->snapshot()->restore(saved), PLUMB_OK) << world->error_text();
  EXPECT_EQ(FakeWorld::last->exception_calls, (std::vector<FakeWorld::ExceptionCall>{{bodies[0], bodies[2], false}}));
}

TEST_F(GuardedWorldSnapshots, OfOtherShapesOrNeedsOrTornAreRefused) {
  std::vector<std::byte> torn = saved;
  torn.pop_back();
  refused("torn", torn);
  for (std::size_t i = 0; i < saved.size(); ++i) {
    torn = saved;
    torn[i] ^= std::byte{1};
    EXPECT_EQ(world->snapshot()->restore(torn), PLUMB_E_CORRUPT) << "byte " << i;
  }
  world = fake_world(kNeeds & ~PLUMB_NEED_DAMPING);
  (void)add_ball(*world, 0.5);
  refused("needs", saved);
  world = fake_world();
  refused("shape", saved);
  (void)add_ball(*world, 0.6);
  refused("geometry", saved);
  world = fake_world();
  (void)add_ball(*world, 0.5);
  EXPECT_EQ(world->snapshot()->restore(saved), PLUMB_OK) << "another world of the same shapes: " << world->error_text();
}

TEST_F(GuardedWorldSnapshots, OfOtherMaterialsByTriangleAreRefused) {
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1};
  const std::uint32_t triangles[] = {0, 2, 1, 1, 2, 3};
  const auto world_with = [&](double friction, std::uint32_t second) {
    const PlumbMaterial material{friction, 0, {}};
    const std::uint32_t of[] = {0, second};
    PlumbShapeDesc desc = shape_desc(PLUMB_TRIANGLE_MESH);
    desc.vertices = corners;
    desc.vertex_count = 4;
    desc.indices = triangles;
    desc.triangle_count = 2;
    desc.materials = &material;
    desc.material_count = 1;
    desc.triangle_materials = of;
    auto made = fake_world();
    PlumbShape mesh = 0;
    EXPECT_EQ(made->create_shapes({&desc, 1}, {&mesh, 1}), PLUMB_OK) << made->error_text();
    PlumbBodyDesc ground = body_desc(PLUMB_STATIC);
    ground.shape = mesh;
    PlumbBody id = 0;
    EXPECT_EQ(made->create_bodies({&ground, 1}, {&id, 1}), PLUMB_OK) << made->error_text();
    return made;
  };
  const std::vector<std::byte> of_ice = save(*world_with(0.1, PLUMB_BODY_MATERIAL));
  world = world_with(0.2, PLUMB_BODY_MATERIAL);
  refused("geometry", of_ice);
  world = world_with(0.1, 0);
  refused("geometry", of_ice);
  world = world_with(0.1, PLUMB_BODY_MATERIAL);
  EXPECT_EQ(world->snapshot()->restore(of_ice), PLUMB_OK) << world->error_text();
}

TEST_F(GuardedWorldSnapshots, AWorldThatIsHalfRestoredIsLost) {
  (void)add_body(*world, ball, 5);
  FakeWorld::last->fails_to_destroy = true;
  EXPECT_EQ(world->snapshot()->restore(saved), PLUMB_E_WORLD_LOST);
  EXPECT_NE(world->error_text().find("half restored"), std::string::npos) << world->error_text();
}

}  // namespace
}  // namespace plumb::test
