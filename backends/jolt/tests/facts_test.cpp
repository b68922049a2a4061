// What is known of Jolt and of how it is wrapped, and must stay known.
#include <gtest/gtest.h>

#include <numbers>

#include "plumb/backend/small_math.hpp"
#include "plumb_scene.hpp"

namespace {

using namespace scenes;

constexpr PlumbFilter kSeesAll = {1, 0xffffffffu, 0, 0};

PlumbNeeds with(PlumbNeeds more) { return kNeeds | more; }

/// The weight of a tower lies in the normal impulses of its lowest contacts, in one collision step or in three.
TEST(Jolt, ContactImpulsesCarryATower) {
  for (const double parts : {1.0, 3.0}) {
    PlumbScene tower(scenes::tower(5), with(PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES),
                     {number_setting("collision_steps", parts, PLUMB_SETTING_INT)});
    for (int i = 0; i < 240; ++i) advance(*tower.world);
    double pushed = 0;
    int points = 0;
    for (const PlumbContact& contact : tower.world->contacts()) {
      if (contact.body_a != tower.bodies[0] && contact.body_b != tower.bodies[0]) continue;
      pushed += contact.normal_impulse;
      ++points;
    }
    EXPECT_EQ(points, 4) << parts;
    EXPECT_NEAR(pushed, 5 * 1000 * 9.81 / 60, 0.01 * 5 * 1000 * 9.81 / 60) << parts;
  }
}

/// A cube on a slope too flat to slide on is held by friction impulses along the slope.
TEST(Jolt, FrictionImpulsesHoldACubeOnASlope) {
  constexpr double kSlope = 0.1;
  const auto world = make_world(with(PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES));
  plumb::check(*world, world->set_gravity({9.81 * std::sin(kSlope), -9.81 * std::cos(kSlope), 0}));
  PlumbBodyDesc ground = plumb::body_desc(PLUMB_STATIC);
  ground.shape = add_box(*world, {10, 1, 10});
  ground.pose.position = {0, -1, 0};
  add_body(*world, ground);
  PlumbBodyDesc desc = plumb::body_desc();
  desc.shape = add_box(*world, {0.5, 0.5, 0.5});
  desc.pose.position = {0, 0.5, 0};
  const PlumbBody cube = add_body(*world, desc);
  for (int i = 0; i < 60; ++i) advance(*world);
  PlumbVec3 sum{};
  for (const PlumbContact& contact : world->contacts()) {
    const double sign = contact.body_b == cube ? 1 : -1;  // on the cube
    sum.x += sign * (contact.tangent_impulse.x + contact.normal_impulse * contact.normal.x);
    sum.y += sign * (contact.tangent_impulse.y + contact.normal_impulse * contact.normal.y);
  }
  EXPECT_NEAR(sum.x, -1000 * 9.81 * std::sin(kSlope) / 60, 0.02 * 1000 * 9.81 * std::sin(kSlope) / 60);
  EXPECT_NEAR(sum.y, 1000 * 9.81 * std::cos(kSlope) / 60, 0.01 * 1000 * 9.81 / 60);
}

/// What turns on a floor is slowed by friction at its points, and by nothing else, also where it leans on one side.
TEST(Jolt, FrictionImpulsesSlowASpin) {
  const auto world = make_world(with(PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES));
  PlumbBodyDesc desc = plumb::body_desc(PLUMB_STATIC);
  desc.shape = add_box(*world, {10, 1, 10});
  desc.pose.position = {0, -1, 0};
  add_body(*world, desc);
  desc = plumb::body_desc();
  desc.shape = add_box(*world, {0.5, 0.1, 0.5});
  desc.pose.position = {0, 0.1, 0};
  desc.linear_velocity = {1, 0, 0};
  desc.angular_velocity = {0, 10, 0};
  const PlumbBody body = add_body(*world, desc);
  for (int i = 0; i < 10; ++i) {
    const auto before = read_row<6>(*world, PLUMB_FIELD_VELOCITY, body);
    const auto at = read_row<7>(*world, PLUMB_FIELD_POSE, body);
    advance(*world);
    const auto after = read_row<6>(*world, PLUMB_FIELD_VELOCITY, body);
    double moment = 0, push = 0;
    for (const PlumbContact& contact : world->contacts()) {
      const double sign = contact.body_b == body ? 1 : -1, x = contact.position.x - at[0],
                   z = contact.position.z - at[2];
      moment += sign * (z * contact.tangent_impulse.x - x * contact.tangent_impulse.z);
      push += sign * contact.tangent_impulse.x;
    }
    const double mass = 1000 * 0.2, inertia = mass / 6;
    EXPECT_NEAR(push, mass * (after[0] - before[0]), 0.01 * mass * std::abs(after[0] - before[0]) + 0.02) << i;
    EXPECT_NEAR(moment, inertia * (after[4] - before[4]), 0.01 * inertia * std::abs(after[4] - before[4]) + 0.02) << i;
  }
}

/// Jolt gives bodies of small moments those of a ball of a metre; the adapter gives them their own.
TEST(Jolt, SmallMomentsAreKept) {
  const auto world = make_world(with(PLUMB_NEED_FORCES));
  plumb::check(*world, world->set_gravity({0, 0, 0}));
  PlumbBodyDesc desc = plumb::body_desc();
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = 1e-3;
  desc.inertia = {4e-8, 5e-8, 6e-8};
  const PlumbBody body = add_body(*world, desc);
  write_row<3>(*world, PLUMB_FIELD_ANGULAR_IMPULSE, body, {4e-8, 0, 6e-8});
  const auto velocity = read_row<6>(*world, PLUMB_FIELD_VELOCITY, body);
  EXPECT_NEAR(velocity[3], 1, 1e-5);
  EXPECT_NEAR(velocity[5], 1, 1e-5);
}

/// Jolt slows what turns faster than 47 rad/s or flies faster than 500 m/s; here that is a setting.
TEST(Jolt, FastBodiesStayFastUnlessToldOtherwise) {
  const auto after = [](std::vector<PlumbSetting> settings) {
    const auto world = make_world(kNeeds, std::move(settings));
    PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 0, 0});
    desc.linear_velocity = {2000, 0, 0};
    desc.angular_velocity = {0, 300, 0};
    const PlumbBody body = add_body(*world, desc);
    advance(*world);
    const auto velocity = read_row<6>(*world, PLUMB_FIELD_VELOCITY, body);
    return std::array{velocity[0], velocity[4]};
  };
  EXPECT_NEAR(after({})[0], 2000, 0.1);
  EXPECT_NEAR(after({})[1], 300, 0.01);
  const auto slowed = after({number_setting("max_linear_speed", 500), number_setting("max_angular_speed", 47)});
  EXPECT_NEAR(slowed[0], 500, 0.1);
  EXPECT_NEAR(slowed[1], 47, 0.01);
}

/// A pinned body stands where it is, whatever pushes, and others rest on it.
TEST(Jolt, ABodyWithAllAxesLockedStands) {
  const auto world = make_world(with(PLUMB_NEED_AXIS_LOCKS | PLUMB_NEED_FORCES));
  PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_box(*world, {0.5, 0.5, 0.5}), {0, 0.5, 0});
  desc.locks = 63;
  const PlumbBody pinned = add_body(*world, desc);
  desc.locks = 0;
  desc.pose.position.y = 1.5;
  const PlumbBody above = add_body(*world, desc);
  write_row<3>(*world, PLUMB_FIELD_IMPULSE, pinned, {1e4, 0, 0});
  write_row<6>(*world, PLUMB_FIELD_VELOCITY, pinned, {1, 2, 3, 4, 5, 6});
  for (int i = 0; i < 60; ++i) advance(*world);
  EXPECT_EQ(read_row<7>(*world, PLUMB_FIELD_POSE, pinned)[1], 0.5);
  EXPECT_EQ(read_row<6>(*world, PLUMB_FIELD_VELOCITY, pinned)[3], 0);
  EXPECT_NEAR(read_row<7>(*world, PLUMB_FIELD_POSE, above)[1], 1.5, 0.03);
}

/// A ray tells a body in which it starts at fraction 0, as the capability's note says.
TEST(Jolt, RaysFromWithinHitAtTheStart) {
  const auto world = make_world(with(PLUMB_NEED_QUERIES));
  for (const PlumbShape shape : {add_sphere(*world, 1), add_box(*world, {1, 1, 1})}) {
    const PlumbBody body = add_body(*world, frictionless(PLUMB_STATIC, shape, {0, 0, 0}));
    const PlumbRay ray = {{0.1, 0.2, 0.3}, {0, 5, 0}, kSeesAll};
    const plumb::Hits hits = world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
    ASSERT_EQ(hits.hits.size(), 1u);
    EXPECT_EQ(hits.hits[0].body, body);
    EXPECT_EQ(hits.hits[0].fraction, 0);
    plumb::check(*world, world->destroy_bodies({&body, 1}));
  }
}

/// Jolt's collision rounds a box of a metre by 5 cm: its corner is 4 cm further away than it is. Queries are not.
TEST(Jolt, DistancesAreThoseOfSharpCorners) {
  const auto world = make_world(with(PLUMB_NEED_QUERIES));
  add_body(*world, frictionless(PLUMB_STATIC, add_box(*world, {0.5, 0.5, 0.5}), {0, 0, 0}));
  const PlumbProbe probe = {add_sphere(*world, 0.25), {{1.5, 1.5, 1.5}, {0, 0, 0, 1}}, 10, kSeesAll};
  const plumb::ClosestBodies found = world->closest()->closest_bodies(PLUMB_HIT_CLOSEST, {&probe, 1});
  ASSERT_EQ(found.rows.size(), 1u);
  EXPECT_NEAR(found.rows[0].distance, std::sqrt(3.0) - 0.25, 1e-5);
  EXPECT_NEAR(found.rows[0].on_body.x, 0.5, 1e-5);
}

/// Jolt holds 256 corners of a hull: of more it takes those that stand out most.
TEST(Jolt, HullsOfManyCornersAreThinnedOut) {
  const auto world = make_world(with(PLUMB_NEED_QUERIES));
  std::vector<double> vertices;
  for (int i = 0; i < 2000; ++i) {  // Fibonacci's sphere
    const double y = 1 - (i + 0.5) / 1000, ring = std::sqrt(1 - y * y),
                 turn = i * std::numbers::pi * (3 - std::sqrt(5));
    vertices.insert(vertices.end(), {ring * std::cos(turn), y, ring * std::sin(turn)});
  }
  PlumbShapeDesc desc = plumb::shape_desc(PLUMB_CONVEX_HULL);
  desc.vertices = vertices.data();
  desc.vertex_count = 2000;
  add_body(*world, frictionless(PLUMB_STATIC, add_shape(*world, desc), {0, 0, 0}));
  const PlumbRay ray = {{0.3, 2, 0.2}, {0, -2, 0}, kSeesAll};
  const plumb::Hits hits = world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
  EXPECT_NEAR(hits.hits[0].position.y, std::sqrt(1 - 0.09 - 0.04), 0.02);
}

/// The points of two posed shapes tell the depth that their distance does, also where an edge is in an edge.
TEST(Jolt, PointsOfAPairHoldTheDeepest) {
  const auto world = make_world(kNeeds);
  const PlumbShape beam = add_box(*world, {0.2, 1, 0.4}), plate = add_box(*world, {1, 0.2, 0.8});
  Random random(7);
  const auto signed_unit = [&] { return 2 * random.next() - 1; };
  int overlapping = 0;
  for (int i = 0; i < 2000; ++i) {
    const PlumbQuat turn{signed_unit(), signed_unit(), signed_unit(), 1 + random.next()};
    const PlumbPose at{{signed_unit(), signed_unit(), signed_unit()}, plumb::backend::normalized(turn)};
    const PlumbPosedPair pair = {beam, plate, plumb::identity_pose(), at};
    PlumbPairResult result{};
    std::span<const PlumbPairPoint> points;
    plumb::check(*world, world->collide()->collide_pairs({&pair, 1}, {&result, 1}, points));
    if (result.distance > 0) continue;
    ++overlapping;
    double deepest = -1;
    for (const PlumbPairPoint& point : points) deepest = std::max(deepest, point.depth);
    ASSERT_NEAR(deepest, -result.distance, 2e-5) << i;
  }
  EXPECT_GT(overlapping, 500);
}

TEST(Jolt, NumbersBeyondFloatAreRefused) {
  const auto world = make_world(kNeeds);
  PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 1e300, 0});
  PlumbBody body = 0;
  EXPECT_EQ(world->create_bodies({&desc, 1}, {&body, 1}), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_NE(world->error_text().find("pose.position"), std::string::npos) << world->error_text();
}

/// Jolt says nothing of those that sleep; their contact does not end for that.
TEST(Jolt, SleepersTouchOn) {
  const auto world = make_world(with(PLUMB_NEED_EVENTS | PLUMB_NEED_SLEEPING));
  add_body(*world, frictionless(PLUMB_STATIC, add_box(*world, {5, 1, 5}), {0, -1, 0}));
  const PlumbBody cube = add_body(*world, frictionless(PLUMB_DYNAMIC, add_box(*world, {0.5, 0.5, 0.5}), {0, 0.5, 0}));
  int begun = 0, ended = 0, slept = 0;
  for (int i = 0; i < 240; ++i) {
    advance(*world);
    for (const PlumbEvent& event : world->events()) {
      begun += event.type == PLUMB_EVENT_CONTACT_BEGIN ? 1 : 0;
      ended += event.type == PLUMB_EVENT_CONTACT_END ? 1 : 0;
      slept += event.type == PLUMB_EVENT_SLEEP ? 1 : 0;
    }
  }
  EXPECT_EQ(read_row<1>(*world, PLUMB_FIELD_AWAKE, cube)[0], 0);
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(ended, 0);
  EXPECT_EQ(slept, 1);
}

/// The same bits for any number of threads, in a scene of several islands.
TEST(Jolt, ThreadsChangeNothing) {
  const auto after = [](std::uint32_t threads) {
    PlumbWorldDesc desc = plumb::world_desc(kNeeds);
    desc.threads = threads;
    const auto world = backend().create_world(desc);
    add_body(*world, frictionless(PLUMB_STATIC, add_box(*world, {50, 1, 50}), {0, -1, 0}));
    const PlumbShape box = add_box(*world, {0.5, 0.5, 0.5});
    for (int i = 0; i < 200; ++i) {
      PlumbBodyDesc cube = plumb::body_desc();
      cube.shape = box;
      cube.pose.position = {(i % 7) * 0.9 - 3, 1 + (i / 49) * 1.3, (i / 7 % 7) * 0.9 - 3};
      add_body(*world, cube);
    }
    for (int i = 0; i < 120; ++i) advance(*world);
    std::uint64_t hash = 0;
    plumb::check(*world, world->hash(hash));
    return hash;
  };
  const std::uint64_t one = after(1);
  EXPECT_EQ(after(2), one);
  EXPECT_EQ(after(4), one);
}

/// A body that gets another shape has none of the contacts that Jolt keeps of the one before under the same number.
TEST(Jolt, AnotherShapeHasItsOwnContacts) {
  const auto world = make_world(kNeeds);
  add_body(*world, frictionless(PLUMB_STATIC, add_box(*world, {5, 1, 5}), {0, -1, 0}));
  const PlumbShape small = add_box(*world, {0.2, 0.2, 0.2});
  const PlumbBody cube = add_body(*world, frictionless(PLUMB_DYNAMIC, add_box(*world, {0.5, 0.5, 0.5}), {0, 0.5, 0}));
  for (int i = 0; i < 60; ++i) advance(*world);
  PlumbBodyChange change = plumb::body_change(cube);
  change.what = PLUMB_MODIFY_SHAPE;
  change.shape = small;
  plumb::check(*world, world->modify()->modify_bodies({&change, 1}));
  for (int i = 0; i < 60; ++i) advance(*world);
  EXPECT_NEAR(read_row<7>(*world, PLUMB_FIELD_POSE, cube)[1], 0.2, 0.02);
}

/// A pile with a swinging chain in it, which others come into and go out of.
struct Pile {
  static constexpr PlumbNeeds kPileNeeds = kNeeds | PLUMB_NEED_SNAPSHOT | PLUMB_NEED_EVENTS | PLUMB_NEED_SLEEPING;

  explicit Pile(std::uint32_t threads) {
    PlumbWorldDesc desc = plumb::world_desc(kPileNeeds);
    desc.threads = threads;
    world = backend().create_world(desc);
    box = add_box(*world, {0.5, 0.5, 0.5});
    ground = add_box(*world, {50, 1, 50});
  }
  void fill() {
    PlumbBodyDesc floor = plumb::body_desc(PLUMB_STATIC);
    floor.shape = ground;
    floor.pose.position = {0, -1, 0};
    add_body(*world, floor);
    for (int i = 0; i < 40; ++i) bodies.push_back(cube({(i % 4) * 0.8, 1 + (i / 16) * 1.3, (i / 4 % 4) * 0.8}));
    for (int i = 0; i < 4; ++i) {
      bodies.push_back(cube({1.5, 8.0 - 1.1 * i, 6}));
      join(i == 0 ? 0 : bodies[bodies.size() - 2], bodies.back(),
           i == 0 ? PlumbVec3{0, 8.55, 6} : PlumbVec3{0, -0.55, 0});
    }
  }
  PlumbBody cube(PlumbVec3 at) {
    PlumbBodyDesc desc = plumb::body_desc();
    desc.shape = box;
    desc.pose.position = at;
    return add_body(*world, desc);
  }
  void join(PlumbBody a, PlumbBody b, PlumbVec3 in_a) {
    PlumbJointDesc desc = plumb::joint_desc(PLUMB_JOINT_BALL);
    desc.body_a = a;
    desc.body_b = b;
    desc.frame_a.position = in_a;
    desc.frame_b.position = {0, 0.55, 0};
    joints.push_back(0);
    plumb::check(*world, world->joints()->create_joints({&desc, 1}, {&joints.back(), 1}));
  }
  std::uint64_t after(int steps) {
    for (int i = 0; i < steps; ++i) advance(*world);
    std::uint64_t hash = 0;
    plumb::check(*world, world->hash(hash));
    return hash;
  }

  std::unique_ptr<plumb::IPhysicsWorld> world;
  PlumbShape box = 0, ground = 0;
  std::vector<PlumbBody> bodies;
  std::vector<PlumbJoint> joints;
};

/// Bodies have Jolt's numbers by their slots, and joints are solved in the order of theirs: so a world that is put back
/// goes on to the bit, after others came and went, and in another world with another number of threads.
TEST(Jolt, WholeWorldsGoOnToTheBit) {
  Pile pile(1);
  pile.fill();
  (void)pile.after(40);
  std::span<const std::byte> lent;
  plumb::check(*pile.world, pile.world->snapshot()->save_world(lent));
  const std::vector<std::byte> saved(lent.begin(), lent.end());
  const std::uint64_t expected = pile.after(90);

  plumb::check(*pile.world, pile.world->joints()->destroy_joints({pile.joints.data(), 1}));
  for (const std::size_t gone : {5u, 20u, 7u})
    plumb::check(*pile.world, pile.world->destroy_bodies({&pile.bodies[gone], 1}));
  for (int i = 0; i < 6; ++i) (void)pile.cube({0.3 * i, 12 + 1.2 * i, 0});
  (void)pile.after(20);
  plumb::check(*pile.world, pile.world->snapshot()->restore(saved));
  EXPECT_EQ(pile.after(90), expected);

  Pile other(3);
  plumb::check(*other.world, other.world->snapshot()->restore(saved));
  EXPECT_EQ(other.after(90), expected);
}

}  // namespace
