// Changes of what lives: a world that was changed into another before its first step goes on with that one's bits.
#include <gtest/gtest.h>

#include <cmath>

#include "plumb/backend/modify.hpp"
#include "tests/hashes/shape_scenes.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kModifyNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                    PLUMB_NEED_JOINTS | PLUMB_NEED_KINEMATIC | PLUMB_NEED_AXIS_LOCKS |
                                    PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_EVENTS;

constexpr std::uint32_t kAllOfABody = (1U << PLUMB_MODIFY_BODY_COUNT) - 1,
                        kAllOfAJoint = (1U << PLUMB_MODIFY_JOINT_COUNT) - 1;

constexpr std::uint32_t kParticle = PLUMB_BODY_NO_ROTATION, kHeld = PLUMB_LOCK_ANGULAR_Z;

struct Heap {
  Heap() : scene(engine(), kModifyNeeds, {0, -9.81, 0}, 1) {
    scene.ground();
    shapes = convex_shapes(scene);
  }
  [[nodiscard]] PlumbVec3 place(int i) const { return {0.5 * (i % 3), 0.5 + 0.55 * i, 0.1 * (i % 2)}; }
  /// The heap that all of these tests compare with: the last hangs on the one before by a hinge with a limit.
  void make() {
    for (int i = 0; i < 20; ++i) {
      scene.body.flags = i % 7 == 3 ? kParticle : 0U;
      scene.body.locks = i % 5 == 2 ? kHeld : 0U;
      bodies.push_back(scene.add(shapes[static_cast<std::size_t>(i) % shapes.size()], place(i)));
    }
    scene.body.flags = scene.body.locks = 0;
  }
  [[nodiscard]] PlumbJointDesc hinge() const {
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
    desc.body_a = bodies[18];
    desc.body_b = bodies[19];
    desc.frame_b.position = {0.1, -0.55, 0};
    desc.limits[3] = {-0.3, 0.4, 1, 0};
    desc.motors[3] = {1, 20, 1, 0};
    return desc;
  }
  std::uint64_t hash_after(int steps) {
    scene.run(steps);
    return scene.hash();
  }

  Scene scene;
  std::vector<PlumbShape> shapes;
  std::vector<PlumbBody> bodies;
};

/// Statics, particles and balls become the heap.
TEST(Modify, BodiesAreAsIfTheyHadBeenMadeSo) {
  Heap made, changed;
  made.make();
  for (int i = 0; i < 20; ++i) {
    const PlumbShape other =
        changed.shapes[static_cast<std::size_t>(i + 2) % 4];  // not the hull: its axes round the pose
    changed.bodies.push_back(i % 3 == 0   ? changed.scene.add_static(other, changed.place(i))
                             : i % 3 == 1 ? changed.scene.add_kinematic(other, changed.place(i))
                                          : changed.scene.add(other, changed.place(i)));
    PlumbBodyChange change = body_change(changed.bodies.back());
    change.what = kAllOfABody;
    change.motion = PLUMB_DYNAMIC;
    change.shape = changed.shapes[static_cast<std::size_t>(i) % changed.shapes.size()];
    change.mass_mode = PLUMB_MASS_FROM_DENSITY;
    change.density = 1000;
    change.flags = i % 7 == 3 ? kParticle : 0U;
    change.locks = i % 5 == 2 ? kHeld : 0U;
    changed.scene.modify(change);
  }
  EXPECT_EQ(changed.hash_after(90), made.hash_after(90));
}

/// A joint of other frames, limits and drives becomes the hinge, as does one that was let go and taken again.
TEST(Modify, JointsAreAsIfTheyHadBeenMadeSo) {
  Heap made, changed, paused;
  for (Heap* heap : {&made, &changed, &paused}) heap->make();
  made.scene.join(made.hinge());
  PlumbJointDesc other = changed.hinge();
  other.frame_a.position = {0, 1, 0};
  other.limits[3] = {};
  other.motors[3] = {};
  other.springs[3] = {0, 2, 0.1, 1, 0};
  other.collide_connected = 1;
  PlumbJointChange change = joint_change(changed.scene.join(other));
  change.what = kAllOfAJoint;
  change.enabled = 1;
  change.frame_b = changed.hinge().frame_b;
  change.limits[3] = changed.hinge().limits[3];
  change.motors[3] = changed.hinge().motors[3];
  changed.scene.modify(change);
  change = joint_change(paused.scene.join(paused.hinge()));
  change.what = PLUMB_MODIFY_ENABLED;
  for (const std::uint32_t enabled : {0U, 1U}) {
    change.enabled = enabled;
    paused.scene.modify(change);
  }
  const std::uint64_t expected = made.hash_after(90);
  EXPECT_EQ(changed.hash_after(90), expected);
  EXPECT_EQ(paused.hash_after(90), expected);
}

std::vector<PlumbContact> contacts_of(Scene& scene) {
  const std::span<const PlumbContact> contacts = scene.world().contacts();
  return {contacts.begin(), contacts.end()};
}

/// Three boxes in a row, of one body, on the ground.
struct LyingCompound {
  LyingCompound() : scene(engine(), kModifyNeeds | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES, kDown, 1) {
    const PlumbShape box = scene.box({0.5, 0.5, 0.5});
    PlumbCompoundChild children[3];
    for (int i = 0; i < 3; ++i) children[i] = {box, {{1.5 * i, 0, 0}, {0, 0, 0, 1}}, 0, 0, {}};
    PlumbShapeDesc desc = shape_desc(PLUMB_COMPOUND);
    desc.children = children;
    desc.child_count = 3;
    bodies = {scene.add_static(scene.box({50, 0.5, 50}), {0, -0.5, 0}), scene.add(scene.make(desc), {0, 0.5, 0})};
    scene.run(10);
  }
  Scene scene;
  std::vector<PlumbBody> bodies;
};

TEST(Modify, ContactsAreStillThoseOfTheStep) {
  LyingCompound same, changed;
  const PlumbShape ball = changed.scene.sphere(0.5);
  for (const PlumbBody body : changed.bodies) {
    PlumbBodyChange change = body_change(body);
    change.what = PLUMB_MODIFY_SHAPE;
    change.shape = ball;
    changed.scene.modify(change);
  }
  const std::vector<PlumbContact> before = contacts_of(same.scene), after = contacts_of(changed.scene);
  ASSERT_EQ(before.size(), 12U);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].child_a, before[i].child_a) << i;
    EXPECT_EQ(after[i].child_b, before[i].child_b) << i;
    EXPECT_EQ(after[i].normal_impulse, before[i].normal_impulse) << i;
  }
}

/// A joint that was let go and taken again has borne nothing yet.
TEST(Modify, ReactionsAreNotThoseOfBefore) {
  Scene scene(engine(), kModifyNeeds | PLUMB_NEED_JOINT_REACTIONS, {0, -9.81, 0}, 1);
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_FIXED);
  desc.body_b = scene.add(scene.sphere(0.5), {0, 0, 0});
  const PlumbJoint joint = scene.join(desc);
  const auto borne = [&] {
    std::array<double, 6> row{};
    check(scene.world(), scene.world().joints()->read_joints(PLUMB_JOINT_REACTION, {&joint, 1},
                                                             rows_over(std::span<std::array<double, 6>>(&row, 1))));
    return row[1];
  };
  scene.run(10);
  EXPECT_GT(borne(), 1000);
  PlumbJointChange change = joint_change(joint);
  change.what = PLUMB_MODIFY_ENABLED;
  scene.modify(change);
  EXPECT_EQ(borne(), 0);
  change.enabled = 1;
  scene.modify(change);
  EXPECT_EQ(borne(), 0);
  scene.run(1);
  EXPECT_GT(borne(), 1000);
}

/// A spring that comes to a joint in a taut chain is as stiff as the links' own inertia and its frequency say: tension
/// is no mass. When the load is gone it bends the chain no faster than that.
TEST(Modify, ASpringIsNoStifferUnderTension) {
  Scene scene(engine(), kModifyNeeds, {0, -9.81, 0}, 1);
  const PlumbShape link = scene.capsule(0.05, 0.2);
  std::vector<PlumbBody> links;
  PlumbJoint hinge = 0, last = 0;
  for (int i = 0; i < 6; ++i) {
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = i < 5 ? 4 : 1e6;
    PlumbJointDesc desc = joint_desc(i == 3 ? PLUMB_JOINT_HINGE : PLUMB_JOINT_BALL);
    desc.body_a = i == 0 ? 0 : links.back();
    links.push_back(desc.body_b = scene.add(link, {0, -0.5 * i, 0}));
    desc.frame_a.position = {0, i == 0 ? 0.25 : -0.25, 0};
    desc.frame_b.position = {0, 0.25, 0};
    last = scene.join(desc);
    if (i == 3) hinge = last;
  }
  scene.run(30);
  PlumbJointChange change = joint_change(hinge);
  change.what = PLUMB_MODIFY_SPRINGS;
  change.springs[3] = {0.5, 3, 0.1, 1, 0};
  scene.modify(change);
  scene.run(1);
  check(scene.world(), scene.world().joints()->destroy_joints({&last, 1}));
  scene.remove(links.back());
  links.pop_back();
  for (int step = 0; step < 60; ++step) {
    scene.run(1);
    for (const PlumbBody body : links) {
      const std::vector<double> v = scene.velocity(body);
      ASSERT_LT(std::hypot(v[0], v[1], v[2]), 0.2) << step;
    }
  }
}

/// A motor's numbers by rows and by a change are the same numbers.
TEST(Modify, MotorsAreThoseOfRows) {
  Heap by_rows, by_change;
  std::uint64_t hashes[2];
  for (Heap* heap : {&by_rows, &by_change}) {
    heap->make();
    const PlumbJoint joint = heap->scene.join(heap->hinge());
    heap->scene.run(20);
    if (heap == &by_rows) {
      std::array<double, 12> row{};
      row[6] = -2;
      row[7] = 30;
      check(heap->scene.world(),
            heap->scene.world().joints()->write_joints(
                PLUMB_JOINT_MOTOR, {&joint, 1}, const_rows_over(std::span<const std::array<double, 12>>(&row, 1))));
    } else {
      PlumbJointChange change = joint_change(joint);
      change.what = PLUMB_MODIFY_MOTORS;
      change.motors[3] = {-2, 30, 1, 0};
      heap->scene.modify(change);
    }
    hashes[heap == &by_rows ? 0 : 1] = heap->hash_after(40);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

/// What is not named stays: velocities to the bit, poses to their rounding.
TEST(Modify, WhatIsNotNamedStays) {
  Heap heap;
  heap.make();
  heap.scene.run(10);
  const std::vector<PlumbPose> poses = heap.scene.poses();
  std::vector<std::vector<double>> velocities;
  for (const PlumbBody body : heap.bodies) velocities.push_back(heap.scene.velocity(body));
  for (const PlumbBody body : heap.bodies) {
    PlumbBodyChange change = body_change(body);
    change.what = PLUMB_MODIFY_SHAPE;
    change.shape = heap.shapes[0];
    heap.scene.modify(change);
  }
  const std::vector<PlumbPose> now = heap.scene.poses();
  ASSERT_EQ(now.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    EXPECT_LT(backend::length(backend::sub(now[i].position, poses[i].position)), 1e-6) << "body " << i;
  for (std::size_t i = 0; i < velocities.size(); ++i)
    EXPECT_EQ(heap.scene.velocity(heap.bodies[i]), velocities[i]) << "body " << i;
}

/// A frame of a joint lies where it did, though the body's principal axes and centre of mass are others.
TEST(Modify, JointsHoldWhereTheyDidWhenMassesChange) {
  Scene scene(engine(), kModifyNeeds, {0, -9.81, 0}, 1);
  const PlumbBody bob = scene.add(scene.box({0.3, 0.2, 0.1}), {1, 0, 0});
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_BALL);
  desc.body_b = bob;
  desc.frame_b.position = {-1, 0, 0};
  scene.join(desc);
  scene.run(30);
  PlumbBodyChange change = body_change(bob);
  change.what = PLUMB_MODIFY_MASS;
  change.mass_mode = PLUMB_MASS_EXPLICIT;
  change.mass = 3;
  change.inertia = {0.3, 0.2, 0.4};
  change.inertia_orientation = {0.5, 0.5, 0.5, 0.5};
  change.centre_of_mass = {0.2, 0.1, -0.1};
  scene.modify(change);
  for (int step = 0; step < 120; ++step) {
    scene.run(1);
    const PlumbPose pose = scene.poses().front();
    const PlumbVec3 end = backend::add(pose.position, backend::rotate(pose.orientation, {-1, 0, 0}));
    ASSERT_LT(backend::length(end), 1e-3) << "step " << step;
  }
}

}  // namespace
}  // namespace plumb::impulse::test
