// Bodies of several shapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "plugin/rows/proxy_slots.hpp"
#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kCompoundNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                      PLUMB_NEED_EVENTS | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES |
                                      PLUMB_NEED_RESTITUTION;

std::uint64_t pile(bool as_compounds) {
  Scene scene(engine(), kCompoundNeeds, kDown, 1);
  scene.ground();
  Random random(3);
  scene.body.mass_mode = PLUMB_MASS_EXPLICIT;  // or the sum over the children rounds otherwise
  scene.body.mass = 1;
  scene.body.inertia = {0.05, 0.06, 0.08};
  const PlumbShape shapes[] = {scene.sphere(0.3), scene.box({0.3, 0.2, 0.4}), scene.capsule(0.2, 0.3),
                               scene.hull({{0.4, 0, 0}, {-0.3, 0, 0.3}, {-0.3, 0, -0.3}, {0, 0.5, 0}})};
  for (int i = 0; i < 40; ++i) {
    const PlumbShape shape = shapes[i % 4];
    scene.add(as_compounds ? make_compound(scene, {child(shape)}) : shape,
              {random.between(-1, 1), 1 + 0.3 * i, random.between(-1, 1)}, random.turn());
  }
  scene.run(150);
  return scene.hash();
}
TEST(Compounds, OfOneChildAreThatChildBitForBit) { EXPECT_EQ(pile(true), pile(false)); }

TEST(Compounds, OfTwoHalvesMoveAsTheWhole) {
  const auto fall = [](bool halves) {
    Scene scene(engine(), kCompoundNeeds, kDown, 1);
    scene.ground();
    const PlumbShape half = scene.box({0.25, 0.5, 0.5});
    scene.add(halves ? make_compound(scene, {child(half, {-0.25, 0, 0}), child(half, {0.25, 0, 0})})
                     : scene.box({0.5, 0.5, 0.5}),
              {0, 0.6, 0});
    scene.run(120);
    return scene.poses().back();
  };
  const PlumbPose two = fall(true), one = fall(false);
  EXPECT_NEAR(two.position.y, one.position.y, 1e-4);
  EXPECT_NEAR(two.position.x, 0, 1e-3);
}

TEST(Compounds, NeverTouchThemselves) {
  Scene scene(engine(), kCompoundNeeds, {0, 0, 0}, 1);
  const PlumbShape ball = scene.sphere(1);
  scene.add(make_compound(scene, {child(ball), child(ball, {0.5, 0, 0}), child(ball, {0, 0.3, 0})}), {0, 0, 0});
  scene.run(5);
  EXPECT_TRUE(scene.world().contacts().empty());
}

TEST(Compounds, ContactsNameTheChildAndEventsTheBody) {
  Scene scene(engine(), kCompoundNeeds, kDown, 1);
  scene.ground();
  const PlumbShape ball = scene.sphere(0.5);
  const PlumbBody dumbbell = scene.add(
      make_compound(scene, {child(ball, {0, 3, 0}), child(ball, {-1, 0, 0}), child(ball, {1, 0, 0})}), {0, 0.5, 0});
  std::set<std::uint32_t> children;
  int begins = 0;
  for (int i = 0; i < 10; ++i) {
    scene.run(1);
    for (const PlumbContact& contact : scene.world().contacts()) {
      const bool first = contact.body_a == dumbbell;
      children.insert(first ? contact.child_a : contact.child_b);
      EXPECT_EQ(first ? contact.child_b : contact.child_a, 0U);
    }
    for (const PlumbEvent& event : scene.world().events()) begins += event.type == PLUMB_EVENT_CONTACT_BEGIN ? 1 : 0;
  }
  EXPECT_EQ(children, (std::set<std::uint32_t>{1, 2}));
  EXPECT_EQ(begins, 1);
}

TEST(Compounds, ChildrenHaveTheirOwnMaterials) {
  Scene scene(engine(), kCompoundNeeds, kDown, 1);
  scene.ground();
  const PlumbShape box = scene.box({0.5, 0.5, 0.5});
  std::vector<PlumbCompoundChild> ice = {child(box)};
  ice[0].has_material = 1;
  ice[0].material.friction = 0;
  scene.body.linear_velocity = {3, 0, 0};
  const PlumbShape slippery = make_compound(scene, ice), plain = make_compound(scene, {child(box)});
  const PlumbBody on_ice = scene.add(slippery, {0, 0.5, 0});
  scene.add(plain, {0, 0.5, 4});
  scene.write(PLUMB_FIELD_MATERIAL, on_ice, {0.9, 0});  // the body's, which its child does not have
  scene.run(60);
  EXPECT_NEAR(scene.poses()[1].position.x, 3, 0.05);
  EXPECT_LT(scene.poses()[2].position.x, 2);
}

/// Rows of proxies and slots of bodies go apart, and come back.
TEST(Compounds, ComeAndGoBesideBodiesOfOneShape) {
  Scene scene(engine(), kCompoundNeeds, kDown, 1);
  scene.ground();
  const PlumbShape ball = scene.sphere(0.3);
  const PlumbShape pair = make_compound(scene, {child(ball, {-0.3, 0, 0}), child(ball, {0.3, 0, 0})});
  Random random(5);
  std::vector<PlumbBody> bodies;
  for (int i = 0; i < 300; ++i) {
    scene.body.linear_velocity = {0, 0, 0};
    bodies.push_back(
        scene.add(i % 3 == 0 ? ball : pair, {random.between(-3, 3), 0.5 + 0.02 * i, random.between(-3, 3)}));
    if (i % 2 == 1) {
      const auto gone = static_cast<std::size_t>(random.between(0, static_cast<double>(bodies.size())));
      scene.remove(bodies[gone]);
      bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(gone));
    }
    scene.run(1);
    for (const PlumbContact& contact : scene.world().contacts()) {
      ASSERT_NE(contact.body_a, 0U);
      ASSERT_NE(contact.body_b, 0U);
      ASSERT_NE(contact.body_a, contact.body_b);
    }
  }
  scene.run(200);
  for (const PlumbPose& pose : scene.poses()) EXPECT_GT(pose.position.y, -0.6);
}

TEST(Compounds, RowsOfProxiesAreListedOnceHoweverManyComeAndGo) {
  ProxySlots slots;
  const std::uint32_t single = slots.take(0);
  std::vector<std::uint32_t> parts = {slots.take(1), slots.take_any(2), slots.take_any(2)};
  for (int i = 0; i < 1000; ++i) {
    slots.give_back(single);
    EXPECT_EQ(slots.take(0), single);
    for (const std::uint32_t row : parts) slots.give_back(row);
    parts = {slots.take(1), slots.take_any(2), slots.take_any(2)};
    EXPECT_EQ(std::set<std::uint32_t>(parts.begin(), parts.end()).size(), 3U);
    EXPECT_EQ(std::count(parts.begin(), parts.end(), single), 0);
  }
  EXPECT_EQ(slots.end(), 4U);
  EXPECT_LE(slots.listed(), slots.end());
}

}  // namespace
}  // namespace plumb::impulse::test
