// A running game goes on in another engine with all that it had, or stays where it is and says why.
#include <set>

#include "hosts/ogre/tests/playing.hpp"
#include "plumb/loader.hpp"

namespace plumb::ogre::tests {
namespace {

/// Of all things, by what the engine itself says of their masses: linear, and angular about the origin but for spins.
struct Momentum {
  PlumbVec3 linear{}, angular{};
};

Momentum momentum_of(Game& game) {
  struct Mass {
    double mass, rest[10];
  };
  IPhysicsWorld& world = game.stage().world();
  const Moment moment = game.stage().moment();
  std::vector<Mass> masses(moment.poses.size());
  const auto ids = world.bodies().first(masses.size());
  check(world, world.read(PLUMB_FIELD_MASS, ids, rows_over(std::span(masses))));
  Momentum sum;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const PlumbVec3 p = scale(masses[i].mass, moment.velocities[i].linear);
    sum.linear = add(sum.linear, p);
    sum.angular = add(sum.angular, cross(moment.poses[i].position, p));
  }
  return sum;
}

class Switching : public Playing {
 protected:
  /// Things fall, the platform rises with the character, and the ball swings in a hand; between two steps.
  void come_to_the_middle() {
    step_onto_platform();
    game.grab(ray_at("ball"));
    game.drag({add(place("ball"), {0, 0, 2}), {0.3, 0.8, -0.52}});
    play(1.4);
    game.advance(Stage::dt / 2);
  }
};

void expect_same(const Moment& a, const Moment& b) {
  EXPECT_DOUBLE_EQ(a.time, b.time);
  EXPECT_NEAR(a.pending, b.pending, 1e-12);
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    const PlumbQuat &p = a.poses[i].orientation, &q = b.poses[i].orientation;
    EXPECT_NEAR(distance(a.poses[i].position, b.poses[i].position), 0, 1e-5) << i;
    EXPECT_NEAR(std::abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w), 1, 1e-6) << i;
  }
  EXPECT_NEAR(distance(a.character, b.character), 0, 0.03);  // the skin about it is measured anew
  EXPECT_NEAR(distance(a.character_velocity, b.character_velocity), 0, 1e-9);
  ASSERT_TRUE(a.hold && b.hold);
  EXPECT_EQ(a.hold->thing, b.hold->thing);
  EXPECT_NEAR(distance(a.hold->target, b.hold->target), 0, 1e-12);
}

TEST_F(Switching, CarriesAllOverToEveryOtherEngine) {
  come_to_the_middle();
  ASSERT_GT(length(momentum_of(game).linear), 1);
  int took_it = 0;
  for (const std::string& name : other_backends()) {
    const Moment before = game.stage().moment();
    const Momentum momentum = momentum_of(game);
    const std::string from = game.engine();
    const std::size_t notices = game.notices().size();
    if (!game.switch_to(name)) {
      EXPECT_EQ(game.engine(), from);
      EXPECT_EQ(game.notices().size(), notices + 1);
      continue;
    }
    ++took_it;
    EXPECT_EQ(game.engine(), name);
    expect_same(before, game.stage().moment());
    EXPECT_EQ(game.switches().back().bodies, game.scene().things.size());
    EXPECT_LT(game.switches().back().position_error, 1e-5);
    EXPECT_LT(game.switches().back().velocity_error, 1e-5);
    const Momentum now = momentum_of(game);
    EXPECT_LT(distance(now.linear, momentum.linear), 1e-4 * length(momentum.linear));
    EXPECT_LT(distance(now.angular, momentum.angular), 1e-4 * length(momentum.angular));
    // It goes on as it went: what was lifted is lifted further, and the half step that was due is taken.
    game.advance(Stage::dt / 2);
    EXPECT_NEAR(game.stage().time(), before.time + Stage::dt, 1e-9);
    play(0.2);
    EXPECT_EQ(game.stage().ground(), game.scene().platform) << name;
    EXPECT_NEAR(game.stage().walker().position().y - kFoot, platform_top(), 0.1) << name;
    EXPECT_NEAR(distance(to_world(pose("ball"), game.stage().hold()->at), game.stage().hold()->target), 0, 0.2);
    game.advance(Stage::dt / 2);
    ASSERT_TRUE(game.switch_to(tested_backend())) << game.notices().back().text;
  }
  if (took_it == 0) GTEST_SKIP() << "no other engine here can take the game";
}

TEST_F(Switching, StaysWhereItIsWhenTheOtherIsMissing) {
  come_to_the_middle();
  const Moment before = game.stage().moment();
  EXPECT_FALSE(game.switch_to("no-such-engine"));
  EXPECT_EQ(game.engine(), tested_backend());
  EXPECT_TRUE(game.switches().empty());
  ASSERT_EQ(game.notices().size(), 1U);
  EXPECT_NE(game.notices()[0].text.find("no-such-engine"), std::string::npos) << game.notices()[0].text;
  expect_same(before, game.stage().moment());
  play(0.5);
  EXPECT_NEAR(game.stage().time(), before.time + 0.5, Stage::dt);
}

TEST_F(Switching, JumpGoesOnAsItBegan) {
  play(0.5);
  const double ground = game.stage().walker().position().y;
  for (const std::string& name : other_backends()) {
    game.walk({0, 0, 1});
    game.jump();
    play(0.2);
    const PlumbVec3 from = game.stage().walker().position(), velocity = game.stage().walker().velocity();
    if (game.switch_to(name)) {
      EXPECT_NEAR(distance(game.stage().walker().velocity(), velocity), 0, 1e-9) << name;
      play(0.1);
      const PlumbVec3 way = add(scale(0.1, velocity), scale(0.1 * 0.1 / 2, kGravity));
      EXPECT_NEAR(distance(sub(game.stage().walker().position(), from), way), 0, 0.01) << name;
    }
    game.walk({});
    play(1.5);
    EXPECT_NEAR(game.stage().walker().position().y, ground, 2 * kCharacter.skin) << name;
  }
}

TEST_F(Switching, NextGoesRoundPastThoseThatRefuse) {
  const std::size_t others = find_backends().size() - 1;
  std::set<std::string> told;
  for (std::size_t i = 0; i < others; ++i) {
    const std::string before = game.engine();
    const bool switched = game.switch_to_next();
    EXPECT_EQ(game.engine() != before, switched);
    told.insert(game.notices().back().text);
  }
  EXPECT_EQ(told.size(), others) << "one engine came twice in a round";
}

}  // namespace
}  // namespace plumb::ogre::tests
