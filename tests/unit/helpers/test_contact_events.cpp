#include "plumb/helpers/contact_events.hpp"

#include <cmath>
#include <string>

#include "backend_under_test.hpp"
#include "plumb/helpers/fixed_step.hpp"

namespace plumb::helpers::test {
namespace {

constexpr double kDt = 1.0 / 60;

/// What a helper of events needs and what the tests' scenes do; with impulses, where they are told.
PlumbNeeds all_needs() {
  return TestWorld::usual | ContactEvents::needs | backend_under_test().offered(PLUMB_NEED_CONTACT_IMPULSES);
}
bool tells_impulses() { return offers(PLUMB_NEED_CONTACT_IMPULSES); }

struct Scene : TestWorld {
  explicit Scene(const ContactEventSettings& settings = {}, PlumbVec3 gravity = {0, -9.81, 0})
      : TestWorld(gravity, all_needs()), events(*world, settings) {}
  void step(double dt = kDt) {
    events.before_step();
    TestWorld::step(dt);
    events.after_step();
  }
  PlumbBody floor() { return box(PLUMB_STATIC, {20, 0.5, 20}, {0, -0.5, 0}); }
  ContactEvents events;
};

#define NEEDS_EVENTS() \
  if (!offers(all_needs())) GTEST_SKIP() << "the backend has no events or no contacts"

TEST(ContactEvents, ABallThatFallsHitsOnceWithItsSpeedAndMomentum) {
  NEEDS_EVENTS();
  const double mass = 4, speed = std::sqrt(2 * 9.81 * 2);
  for (const bool floor_first : {true, false})
    for (const double dt : {1.0 / 30, 1.0 / 240}) {
      Scene s;
      ContactEvents all(*s.world, {0, 0});
      PlumbBody floor = floor_first ? s.floor() : 0;
      const PlumbBody ball = s.sphere(0.25, {3, 2.25, -1}, mass);
      if (!floor_first) floor = s.floor();
      int hits = 0, touching = 0, steps = 0;
      double borne = 0;
      for (; steps * dt < 3; ++steps) {
        all.before_step();
        s.step(dt);
        all.after_step();
        touching += static_cast<int>(s.events.began().size()) - static_cast<int>(s.events.ended().size());
        for (const PairContact& pair : all.hits()) borne += pair.impulse;
        for (const PairContact& hit : s.events.hits()) {
          ++hits;
          EXPECT_NEAR(hit.closing_speed, speed, 2 * 9.81 * dt);
          EXPECT_EQ(hit.body_a, floor_first ? floor : ball);
          EXPECT_EQ(hit.body_b, floor_first ? ball : floor);
          EXPECT_NEAR(hit.normal.y, floor_first ? 1 : -1, 1e-3);
          EXPECT_NEAR(hit.position.x, 3, 1e-2);
          EXPECT_NEAR(hit.position.z, -1, 1e-2);
          if (tells_impulses()) {
            EXPECT_GT(hit.impulse, 0);
            EXPECT_LT(hit.impulse, 1.05 * mass * speed + 2 * mass * 9.81 * dt);
          }
        }
      }
      EXPECT_EQ(hits, 1) << "dt " << dt;
      EXPECT_EQ(touching, 1) << "dt " << dt;
      if (tells_impulses()) {
        EXPECT_NEAR(borne, mass * 9.81 * steps * dt, 0.02 * mass * 9.81 * 3) << "dt " << dt;
      }
    }
}

TEST(ContactEvents, AnEndThatSwingsHitsWithTheSpeedOfTheEnd) {
  NEEDS_EVENTS();
  Scene s({}, {0, 0, 0});
  const PlumbBody rod = s.box(PLUMB_DYNAMIC, {1, 0.1, 0.1}, {0, 0, 0}, 2);
  const PlumbBody post = s.box(PLUMB_STATIC, {0.1, 0.1, 0.1}, {0.8, 0.5, 0});
  s.set_velocity(rod, {{0, 0, 0}, {0, 0, 3}});
  std::vector<PairContact> hits;
  for (int i = 0; i < 60 && hits.empty(); ++i) {
    s.step(1.0 / 240);
    hits.assign(s.events.hits().begin(), s.events.hits().end());
  }
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].body_a, rod);
  EXPECT_EQ(hits[0].body_b, post);
  // The rod's face meets the post's edge at .9 .4.
  EXPECT_NEAR(hits[0].closing_speed, 3 * std::sqrt(0.9 * 0.9 + 0.4 * 0.4 - 0.1 * 0.1), 0.03);
}

TEST(ContactEvents, WhatTheHostMovesHitsWithItsSpeed) {
  NEEDS_EVENTS();
  for (const double gap : {0.2, 0.02}) {  // the nearer one hits in the step in which it sets out
    Scene s({}, {0, 0, 0});
    const PlumbBody ball = s.sphere(0.5, {0, 0, 0}, 1);
    const PlumbBody ram = s.box(PLUMB_KINEMATIC, {0.5, 0.5, 0.5}, {-1 - gap, 0, 0});
    s.step();
    std::vector<PairContact> hits;
    for (int i = 0; i < 30 && hits.empty(); ++i) {
      const PlumbPose next{{-1 - gap + 3 * kDt * (i + 1), 0, 0}, {0, 0, 0, 1}};
      check(*s.world, s.world->write(PLUMB_FIELD_KINEMATIC_TARGET, {&ram, 1}, const_rows_over(std::span(&next, 1))));
      s.step();
      hits.assign(s.events.hits().begin(), s.events.hits().end());
    }
    ASSERT_EQ(hits.size(), 1u) << "gap " << gap;
    EXPECT_EQ(hits[0].body_a, ball);
    EXPECT_NEAR(hits[0].closing_speed, 3, 0.1) << "gap " << gap;
    EXPECT_NEAR(hits[0].normal.x, -1, 1e-3);
  }
}

TEST(ContactEvents, OfThoseThatLieWhatTheyBearIsTold) {
  NEEDS_EVENTS();
  if (!tells_impulses()) GTEST_SKIP() << "the backend tells no impulses";
  // Cubes in a bin, at rest: what the floor bears is their weight.
  Scene s({0, 1e-6});
  const PlumbBody floor = s.floor();
  for (int side = 0; side < 4; ++side) {
    const double at = side < 2 ? -1.6 : 1.6;
    s.box(PLUMB_STATIC, side % 2 == 0 ? PlumbVec3{0.5, 3, 2} : PlumbVec3{2, 3, 0.5},
          side % 2 == 0 ? PlumbVec3{at, 3, 0} : PlumbVec3{0, 3, at});
  }
  const double mass = 2;
  for (int i = 0; i < 60; ++i)
    s.box(PLUMB_DYNAMIC, {0.15, 0.15, 0.15}, {-0.8 + 0.4 * (i % 5), 0.2 + 0.4 * (i / 20), -0.6 + 0.4 * (i / 5 % 4)},
          mass);
  double borne = 0;
  const int settled = 480, counted = 60;
  for (int i = 0; i < settled + counted; ++i) {
    s.step();
    if (i < settled) continue;
    for (const PairContact& pair : s.events.hits())
      if (pair.body_a == floor) borne += pair.impulse * pair.normal.y;
  }
  const double weight = 60 * mass * 9.81 * counted * kDt;
  EXPECT_NEAR(borne, weight, 0.02 * weight);
}

TEST(ContactEvents, OnlyWatchedPairsThatReachTheSettingsAreTold) {
  NEEDS_EVENTS();
  Scene s;
  s.floor();
  std::vector<PlumbBody> balls;
  for (int i = 0; i < 30; ++i) balls.push_back(s.sphere(0.2, {-6 + 0.5 * i, 1.2, 0}, 1));
  s.events.watch({&balls[7], 1});
  int hits = 0, began = 0;
  for (int i = 0; i < 60; ++i) {
    s.step();
    for (const PairContact& pair : s.events.began())
      began += pair.body_a == balls[7] || pair.body_b == balls[7] ? 1 : 100;
    hits += static_cast<int>(s.events.hits().size());
  }
  EXPECT_EQ(began, 1);
  EXPECT_EQ(hits, 1);
  s.events.watch({});
  for (const PlumbBody ball : balls) s.set_velocity(ball, {{0, 3, 0}, {0, 0, 0}});
  hits = 0;
  for (int i = 0; i < 60; ++i) {
    s.step();
    hits += static_cast<int>(s.events.hits().size());
  }
  EXPECT_EQ(hits, 30);
}

TEST(ContactEvents, WhoPartsAndWhoGoesIsTold) {
  NEEDS_EVENTS();
  Scene s;
  const PlumbBody floor = s.floor();
  const PlumbBody ball = s.sphere(0.2, {0, 0.21, 0}, 1), other = s.sphere(0.2, {5, 0.21, 0}, 1);
  for (int i = 0; i < 60; ++i) s.step();
  s.set_velocity(ball, {{0, 5, 0}, {0, 0, 0}});
  int ended = 0;
  for (int i = 0; i < 12; ++i) {
    s.step();
    for (const PlumbEvent& event : s.events.ended()) {
      ++ended;
      EXPECT_EQ(event.body_a, floor);
      EXPECT_EQ(event.body_b, ball);
    }
  }
  EXPECT_EQ(ended, 1);
  check(*s.world, s.world->destroy_bodies({&other, 1}));
  s.step();
  ASSERT_EQ(s.events.ended().size(), 1u);
  EXPECT_EQ(s.events.ended()[0].body_b, other);
}

TEST(ContactEvents, NoStepOfAFrameIsMissedAndBodiesComeAndGo) {
  NEEDS_EVENTS();
  Scene s;
  s.floor();
  FixedStep steps(*s.world, {});
  int hits = 0;
  for (int frame = 0; frame < 75; ++frame) {  // 15 a second
    const PlumbBody ball = frame < 60 && frame % 3 == 0 ? s.sphere(0.2, {0.2 * frame, 1.7, 0}, 1) : 0;
    steps.advance(
        1.0 / 15, [&](double) { s.events.before_step(); },
        [&] {
          s.events.after_step();
          hits += static_cast<int>(s.events.hits().size());
        });
    if (ball != 0 && frame % 2 == 0) check(*s.world, s.world->destroy_bodies({&ball, 1}));
  }
  EXPECT_EQ(hits, 10);  // of twenty every other one stayed
}

TEST(ContactEvents, WhoCameAfterTheReadIsNamed) {
  NEEDS_EVENTS();
  Scene s;
  s.floor();
  const PlumbBody gone = s.sphere(0.2, {0, 5, 0}, 1);
  s.step();
  check(*s.world, s.world->destroy_bodies({&gone, 1}));
  s.events.before_step();
  s.sphere(0.2, {0, 0.19, 0}, 1);
  static_cast<TestWorld&>(s).step(kDt);
  EXPECT_THROW(s.events.after_step(), Error);
  EXPECT_TRUE(s.events.began().empty());
}

TEST(ContactEvents, AWorldThatTellsNothingIsNamed) {
  NEEDS_EVENTS();
  TestWorld t({0, 0, 0}, TestWorld::usual);
  ContactEvents events(*t.world);
  events.before_step();
  t.step(kDt);
  try {
    events.after_step();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), PLUMB_E_NOT_DECLARED);
    EXPECT_NE(std::string(error.what()).find("reading events"), std::string::npos) << error.what();
  }
}

TEST(ContactEvents, SettingsOutOfRangeAreNamed) {
  NEEDS_EVENTS();
  TestWorld t({0, 0, 0}, all_needs());
  const auto text_of = [&](const ContactEventSettings& settings) {
    try {
      ContactEvents events(*t.world, settings);
      return std::string("no error");
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_NE(text_of({-1, 0}).find("min_speed is -1"), std::string::npos);
  EXPECT_NE(text_of({1, std::nan("")}).find("min_impulse is nan"), std::string::npos);
}

}  // namespace
}  // namespace plumb::helpers::test
