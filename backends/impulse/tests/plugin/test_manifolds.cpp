// Contact modification: what the engine shows, and that a step in halves is the step that it is otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/hashes/shape_scenes.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kManifoldNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;
constexpr auto kModified = static_cast<std::uint32_t>(PLUMB_BODY_MODIFY_CONTACTS);
using ShownRows = std::span<const PlumbManifold>;
using ChangedRows = std::vector<PlumbManifoldChange>;

void change_nothing(ShownRows /*rows*/, ChangedRows& /*changes*/) {}
void disable_all(ShownRows rows, ChangedRows& changes) {
  for (std::uint32_t row = 0; row < rows.size(); ++row) {
    changes.push_back(manifold_change(row));
    changes.back().what = PLUMB_MANIFOLD_DISABLED;
  }
}

/// Of a heap after a second; flags: of its bodies.
std::uint64_t hash_of_heap(PlumbNeeds needs, std::uint32_t flags, bool reads) {
  Scene scene(engine(), kManifoldNeeds | needs, kDown, 1);
  scene.container(2, 10);
  scene.body.flags = flags;
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  for (int i = 0; i < 40; ++i)
    scene.add(shapes[static_cast<std::size_t>(i) % shapes.size()],
              {0.9 * (i % 4) - 1.3, 0.6 + 0.9 * (i / 16), 0.9 * (i / 4 % 4) - 1.3});
  if (reads) scene.modify_contacts = &change_nothing;
  scene.run(60);
  return scene.hash();
}

TEST(ModifiedContacts, AStepInHalvesHasTheBitsOfAWholeOne) {
  const std::uint64_t whole = hash_of_heap(0, 0, false);
  EXPECT_EQ(hash_of_heap(PLUMB_NEED_CONTACT_MODIFICATION, kModified, true), whole);
  EXPECT_EQ(hash_of_heap(PLUMB_NEED_CONTACT_MODIFICATION, kModified, false), whole) << "nobody reads";
  EXPECT_EQ(hash_of_heap(PLUMB_NEED_CONTACT_MODIFICATION, 0, true), whole) << "nobody asks";
  const PlumbNeeds more = PLUMB_NEED_SLEEPING | PLUMB_NEED_CCD | PLUMB_NEED_RESTITUTION | PLUMB_NEED_SURFACE_VELOCITY;
  EXPECT_EQ(hash_of_heap(more | PLUMB_NEED_CONTACT_MODIFICATION, kModified, true), hash_of_heap(more, 0, false));
}

/// What is changed into a material's numbers is as if it were made of that. (But what glances off by a restitution of
/// its own is looked at where it will touch, not where it is nearest: those that bounce here fall straight.)
TEST(ModifiedContacts, HaveTheBitsOfMaterials) {
  constexpr PlumbNeeds kNeeds =
      kManifoldNeeds | PLUMB_NEED_RESTITUTION | PLUMB_NEED_SURFACE_VELOCITY | PLUMB_NEED_CONTACT_MODIFICATION;
  const auto hash = [&](std::uint32_t what, bool by_change) {
    const auto made_of = [&](std::uint32_t bit) { return (what & bit) != 0 && !by_change; };
    Scene scene(engine(), kNeeds, kDown, 1);
    scene.body.flags = kModified;
    scene.body.material = {0.5, 0, {made_of(PLUMB_MANIFOLD_SURFACE_VELOCITY) ? 1.0 : 0.0, 0, 0}};
    const PlumbBody floor = scene.add_static(scene.box({20, 0.5, 20}), {0, -0.5, 0});
    scene.body.material = {
        made_of(PLUMB_MANIFOLD_FRICTION) ? 2.0 : 0.5, made_of(PLUMB_MANIFOLD_RESTITUTION) ? 0.5 : 0.0, {0, 0, 0}};
    for (int i = 0; i < 4; ++i) {
      const PlumbBody box = scene.add(scene.box({0.5, 0.4, 0.5}), {2.0 * i, 1.0 + 0.2 * i, 0});
      if ((what & PLUMB_MANIFOLD_RESTITUTION) == 0) scene.write(PLUMB_FIELD_VELOCITY, box, {1, 0, 0.5, 0, 0, 0});
    }
    scene.modify_contacts = [=](ShownRows rows, ChangedRows& changes) {
      for (std::uint32_t row = 0; row < rows.size() && by_change; ++row) {
        changes.push_back(manifold_change(row));
        changes.back().what = what;
        changes.back().friction = 1;
        changes.back().restitution = 0.5;
        changes.back().surface_velocity = {rows[row].body_b == floor ? 1.0 : -1.0, 0, 0};
      }
    };
    scene.run(90);
    return scene.hash();
  };
  const std::uint64_t plain = hash(0, false);
  constexpr std::uint32_t kBoth = PLUMB_MANIFOLD_FRICTION | PLUMB_MANIFOLD_SURFACE_VELOCITY;
  for (const std::uint32_t what : std::initializer_list<std::uint32_t>{
           PLUMB_MANIFOLD_FRICTION, PLUMB_MANIFOLD_RESTITUTION, PLUMB_MANIFOLD_SURFACE_VELOCITY, kBoth}) {
    EXPECT_EQ(hash(what, true), hash(what, false)) << what;
    EXPECT_NE(hash(what, true), plain) << what << " changes nothing";
  }
}

/// A ledge 5 cm thick that is passed from below and stands from above.
TEST(ModifiedContacts, APlatformLetsUpWhatComesFromBelow) {
  for (const double speed : {6.0, 30.0})  // the faster one goes half a metre a step
    for (const bool continuous : {false, true}) {
      Scene scene(engine(), kManifoldNeeds | PLUMB_NEED_CONTACT_MODIFICATION | PLUMB_NEED_CCD, kDown, 1);
      scene.ground();
      scene.body.flags = kModified;
      const PlumbBody ledge = scene.add_static(scene.box({2, 0.025, 2}), {0, 1.5, 0});
      scene.body.flags = continuous ? static_cast<std::uint32_t>(PLUMB_BODY_CCD) : 0U;
      const PlumbBody jumper = scene.add(scene.box({0.25, 0.25, 0.25}), {0, 0.3, 0});
      scene.write(PLUMB_FIELD_VELOCITY, jumper, {0, speed, 0, 0, 0, 0});
      scene.modify_contacts = [=](ShownRows rows, ChangedRows& changes) {
        for (std::uint32_t row = 0; row < rows.size(); ++row) {
          const double up = rows[row].body_a == ledge ? 1 : -1;
          if (up * rows[row].velocity.y < 0.1 && up * rows[row].normal.y > 0.5) continue;
          changes.push_back(manifold_change(row));
          changes.back().what = PLUMB_MANIFOLD_DISABLED;
        }
      };
      double highest = 0;
      for (int i = 0; i < 480; ++i) {
        scene.run(1);
        highest = std::max(highest, scene.poses()[2].position.y);
      }
      const double reach = 0.3 + speed * speed / (2 * 9.81);
      EXPECT_NEAR(highest, reach, 0.05 * reach + 0.06) << "it was slowed down on its way up";
      EXPECT_NEAR(scene.poses()[2].position.y, 1.775, 0.01) << "it does not stand on the ledge";
    }
}

TEST(ModifiedContacts, OfATouchingPairOnlyWhatIsDisabledIsNotThere) {
  Scene scene(engine(), kManifoldNeeds | PLUMB_NEED_CONTACT_MODIFICATION | PLUMB_NEED_CONTACTS | PLUMB_NEED_EVENTS,
              kDown, 1);
  scene.ground();
  scene.body.flags = kModified;
  scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  scene.run(5);
  EXPECT_EQ(scene.world().contacts().size(), 4u);
  scene.modify_contacts = &disable_all;
  scene.run(1);
  EXPECT_TRUE(scene.world().contacts().empty());
  ASSERT_EQ(scene.world().events().size(), 1u);
  EXPECT_EQ(scene.world().events()[0].type, PlumbEventType{PLUMB_EVENT_CONTACT_END});
}

/// Capacity grows in the middle of a step, and the host sees everything all the same.
TEST(ModifiedContacts, AreAllShownWhereThereIsNoRoomYet) {
  Scene scene(engine(), kManifoldNeeds | PLUMB_NEED_CONTACT_MODIFICATION, kDown, 1);
  scene.ground();
  scene.body.flags = kModified;
  const PlumbShape cube = scene.box({0.1, 0.1, 0.1});
  for (int i = 0; i < 3000; ++i) scene.add(cube, {0.25 * (i % 60) - 7, 0.1, 0.25 * (i / 60) - 6});
  std::size_t seen = 0;
  scene.modify_contacts = [&](ShownRows rows, ChangedRows& changes) {
    seen += rows.size();
    disable_all(rows, changes);
  };
  scene.run(1);
  EXPECT_EQ(seen, 3000u);
  for (const double velocity :
       {scene.velocity(scene.world().bodies()[1])[1], scene.velocity(scene.world().bodies()[3000])[1]})
    EXPECT_NEAR(velocity, -9.81 / 60, 1e-6);
}

/// A step that meets a sleeper is gone over again with it awake, and the host is shown what there is then.
TEST(ModifiedContacts, AreShownAgainWhereASleeperWakes) {
  const auto batches_of = [](bool disabled) {
    Scene scene(engine(), kManifoldNeeds | PLUMB_NEED_CONTACT_MODIFICATION | PLUMB_NEED_SLEEPING, kDown, 1);
    scene.ground();
    const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
    const PlumbBody sleeper = scene.add(cube, {0, 0.5, 0});
    scene.run(300);
    const auto sleeps = [&] {
      double awake = 1;
      check(scene.world(), scene.world().read(PLUMB_FIELD_AWAKE, {&sleeper, 1}, rows_over(std::span(&awake, 1))));
      return awake == 0;
    };
    EXPECT_TRUE(sleeps());
    scene.body.flags = kModified;
    scene.add(cube, {0, 1.6, 0});
    int most = 0, batches = 0;
    scene.modify_contacts = [&](ShownRows rows, ChangedRows& changes) {
      ++batches;
      if (disabled) disable_all(rows, changes);
    };
    for (int i = 0; i < 20; ++i, batches = 0) {
      scene.run(1);
      most = std::max(most, batches);
    }
    EXPECT_EQ(sleeps(), disabled) << "who is passed through sleeps on";
    return most;
  };
  EXPECT_EQ(batches_of(false), 2);
  EXPECT_EQ(batches_of(true), 1);
}

/// Where joints let go and where energy would be made the engine takes a step again, or in parts: each time with what
/// the host says.
TEST(ModifiedContacts, HoldInStepsThatAreRepeated) {
  Scene scene(engine(), kManifoldNeeds | PLUMB_NEED_CONTACT_MODIFICATION | PLUMB_NEED_JOINTS, kDown, 1);
  scene.ground();
  scene.body.flags = kModified;
  const PlumbShape link = scene.box({0.05, 0.2, 0.05});
  PlumbBody above = scene.add_static(link, {0, 6, 0});
  for (int i = 0; i < 8; ++i) {
    const PlumbBody next = scene.add(link, {0.05 * i, 5.55 - 0.45 * i, 0});
    scene.ball_joint(above, {0, -0.2, 0}, next, {0, 0.25, 0});
    above = next;
  }
  scene.body.density = 1e5;
  scene.add(scene.box({0.5, 0.5, 0.5}), {0.3, 8, 0});  // falls onto the chain
  int batches = 0;
  scene.modify_contacts = [&](ShownRows rows, ChangedRows& changes) {
    ++batches;
    disable_all(rows, changes);
  };
  Scene free(engine(), PLUMB_NEED_ROTATION, kDown, 1);
  free.body.density = 1e5;
  free.body.material.friction = 0;
  free.add(free.box({0.5, 0.5, 0.5}), {0.3, 8, 0});
  scene.run(60);
  free.run(60);
  EXPECT_GT(batches, 0);
  EXPECT_NEAR(scene.poses().back().position.y, free.poses()[0].position.y, 1e-4) << "something touched it on its way";
}

}  // namespace
}  // namespace plumb::impulse::test
