#include "plumb/helpers/contact_modification.hpp"

#include <cmath>
#include <stdexcept>

#include "backend_under_test.hpp"
#include "plumb/helpers/fixed_step.hpp"

namespace plumb::helpers::test {
namespace {

constexpr PlumbNeeds kPlatformNeeds = TestWorld::usual | OneWayPlatforms::needs;

/// A floor, and a ledge whose top is at 2 m.
struct Ledge : TestWorld {
  explicit Ledge(double thickness = 0.2) : TestWorld({0, -9.81, 0}, kPlatformNeeds) {
    box(PLUMB_STATIC, {20, 0.5, 20}, {0, -0.5, 0});
    PlumbShapeDesc desc = shape_desc(PLUMB_BOX);
    desc.half_extents = {2, thickness / 2, 2};
    PlumbBodyDesc body = body_desc(PLUMB_STATIC);
    body.shape = shape(desc);
    body.pose.position = {0, 2 - thickness / 2, 0};
    body.flags = PLUMB_BODY_MODIFY_CONTACTS;
    ledge = add(body);
    platforms.add(ledge);
  }
  PlumbBody jumper(PlumbVec3 at, PlumbVec3 velocity) {
    const PlumbBody body = box(PLUMB_DYNAMIC, {0.25, 0.25, 0.25}, at, 10);
    set_velocity(body, {velocity, {0, 0, 0}});
    return body;
  }
  void go(double seconds, double dt = 1.0 / 60) {
    for (int i = 0; i < std::lround(seconds / dt); ++i) step_with(*world, dt, std::ref(platforms));
  }
  PlumbBody ledge = 0;
  OneWayPlatforms platforms;
};

#define NEEDS_PLATFORMS() \
  if (!offers(kPlatformNeeds)) GTEST_SKIP() << "the backend modifies no contacts"

TEST(OneWayPlatforms, ArePassedFromBelowAndStoodOn) {
  NEEDS_PLATFORMS();
  for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240})
    for (const double thickness : {0.05, 0.2, 1.0}) {
      Ledge s(thickness);
      const PlumbBody jumper = s.jumper({0, 0.3, 0}, {0, 8, 0});  // up to 3.5 m
      const PlumbBody faller = s.jumper({1, 4, 1}, {0, 0, 0}), aside = s.jumper({5, 0.25, 0}, {0, 0, 0});
      double highest = 0;
      for (int i = 0; i < std::lround(3 / dt); ++i) {
        s.go(dt, dt);
        highest = std::max(highest, s.pose(jumper).position.y);
        EXPECT_GT(s.pose(faller).position.y, 2) << "what comes from above is not held, dt " << dt;
      }
      EXPECT_GT(highest, 3.2) << "it was slowed down on its way up, dt " << dt << ", thickness " << thickness;
      EXPECT_NEAR(s.pose(jumper).position.y, 2.25, 0.03) << "dt " << dt << ", thickness " << thickness;
      EXPECT_NEAR(s.pose(faller).position.y, 2.25, 0.03) << "dt " << dt;
      EXPECT_NEAR(s.pose(aside).position.y, 0.25, 0.03);
    }
}

TEST(OneWayPlatforms, WhoTurnsBackInTheMiddleFallsOut) {
  NEEDS_PLATFORMS();
  Ledge s(1);
  const PlumbBody jumper = s.jumper({0, 0.3, 0}, {0, 5, 0});  // up to 1.57 m: its head is in the ledge
  s.go(0.4);
  EXPECT_TRUE(s.platforms.lets_through(s.ledge, jumper));
  EXPECT_GT(s.pose(jumper).position.y, 1);
  s.go(2);
  EXPECT_NEAR(s.pose(jumper).position.y, 0.25, 0.03);
  EXPECT_FALSE(s.platforms.lets_through(s.ledge, jumper)) << "the two have parted";
}

TEST(OneWayPlatforms, LetDownWhoStandsOnThem) {
  NEEDS_PLATFORMS();
  Ledge s;
  const PlumbBody one = s.jumper({-1, 2.25, 0}, {0, 0, 0}), other = s.jumper({1, 2.25, 0}, {0, 0, 0});
  s.go(1);
  s.platforms.let_through(s.ledge, one);
  s.go(1.5);
  EXPECT_NEAR(s.pose(one).position.y, 0.25, 0.03);
  EXPECT_NEAR(s.pose(other).position.y, 2.25, 0.03);
  s.platforms.remove(s.ledge);
  s.set_velocity(one, {{0, 9, 0}, {0, 0, 0}});
  s.go(0.3);
  EXPECT_LT(s.pose(one).position.y, 1.8) << "it is no platform any more";
}

TEST(OneWayPlatforms, CrowdsPassAndLand) {
  NEEDS_PLATFORMS();
  Ledge s;
  std::vector<PlumbBody> crowd;
  for (int i = 0; i < 25; ++i)
    crowd.push_back(s.jumper({0.7 * (i % 5) - 1.4, 0.3, 0.7 * (i / 5) - 1.4}, {0, 7.5 + 0.1 * (i % 3), 0}));
  s.go(4);
  for (const PlumbBody body : crowd) EXPECT_NEAR(s.pose(body).position.y, 2.25, 0.05);
}

TEST(OneWayPlatforms, WorkUnderFixedSteps) {
  NEEDS_PLATFORMS();
  Ledge s;
  const PlumbBody jumper = s.jumper({0, 0.3, 0}, {0, 8, 0});
  FixedStep stepper(*s.world, {&jumper, 1});
  stepper.modify_contacts(std::ref(s.platforms));
  for (int i = 0; i < 180; ++i) stepper.advance(1.0 / 60);
  EXPECT_NEAR(s.pose(jumper).position.y, 2.25, 0.03);
}

TEST(StepWith, EndsAStepWhoseChangesFail) {
  NEEDS_PLATFORMS();
  Ledge s;
  const PlumbBody standing = s.jumper({0, 2.25, 0}, {0, 0, 0});
  s.go(0.5);
  const auto throws = [](std::span<const PlumbManifold> rows, std::vector<PlumbManifoldChange>& changes) {
    if (rows.empty()) throw std::runtime_error("of the host's own");
    changes.assign(2, manifold_change(0));
  };
  EXPECT_THROW(step_with(*s.world, 1.0 / 60, throws), Error) << "a change of nothing";
  EXPECT_THROW(step_with(*s.world, 1.0 / 60, [](auto, auto&) { throw std::runtime_error("of the host's own"); }),
               std::runtime_error);
  s.go(0.5);  // the world is none the worse for it
  EXPECT_NEAR(s.pose(standing).position.y, 2.25, 0.03);
  EXPECT_THROW(s.platforms.add(s.ledge, {0, 0, 0}), Error);
}

}  // namespace
}  // namespace plumb::helpers::test
