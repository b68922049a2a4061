// What a player does, and what the game makes of it.
#include <cmath>

#include "hosts/ogre/tests/playing.hpp"

namespace plumb::ogre::tests {
namespace {

TEST_F(Playing, PyramidStandsAndFallingThingsComeDown) {
  play(4);
  EXPECT_NEAR(place("pyramid 4.0").y, 2.25, 0.02);
  for (const char* name : {"falling box 0", "falling box 1", "falling box 2", "falling box 3", "sphere", "cylinder"})
    EXPECT_LT(place(name).y, 1.2) << name;
}

TEST_F(Playing, CharacterWalksAndJumps) {
  play(0.5);
  EXPECT_NEAR(game.stage().character().y, kFoot, 2.1 * kCharacter.skin);
  game.walk({1, 0, 2});
  const PlumbVec3 from = game.stage().walker().position();
  play(0.5);
  const PlumbVec3 gone = sub(game.stage().walker().position(), from);
  EXPECT_NEAR(gone.x, 0.5, 0.02);
  EXPECT_NEAR(gone.z, 1, 0.02);
  game.jump();
  double highest = 0;
  for (int i = 0; i < 60; ++i) {
    game.advance(Stage::dt);
    highest = std::max(highest, game.stage().walker().position().y - from.y);
  }
  EXPECT_NEAR(highest, Game::kJump * Game::kJump / (2 * -kGravity.y), 0.02);
}

TEST_F(Playing, PlatformCarriesCharacterAndBoxes) {
  step_onto_platform();
  ASSERT_EQ(game.stage().ground(), game.scene().platform);
  const PlumbVec3 start = place("platform");
  const PlumbVec3 box = sub(place("carried box 0"), start);
  const PlumbVec3 walker = sub(game.stage().walker().position(), start);
  play(9 - game.stage().time());
  const PlumbVec3 now = place("platform");
  EXPECT_GT(now.y - start.y, 1.5);
  EXPECT_LT(now.z - start.z, -3);
  EXPECT_NEAR(platform_top(), platform_at(9).y + kPlatformHalfExtents.y, 0.01);
  EXPECT_EQ(game.stage().ground(), game.scene().platform);
  EXPECT_NEAR(distance(sub(game.stage().walker().position(), now), walker), 0, 0.05);
  EXPECT_NEAR(distance(sub(place("carried box 0"), now), box), 0, 0.05);
}

TEST_F(Playing, CharacterPushesABox) {
  step_onto_platform();
  const PlumbVec3 box = place("carried box 0");
  game.walk({0, 0, 2 * (box.z - game.stage().walker().position().z)});
  play(0.5);
  game.walk({2, 0, 0});
  play(1);
  EXPECT_GT(place("carried box 0").x - box.x, 0.2);
}

TEST_F(Playing, HeldThingComesToThePointerAndFallsWhenLetGo) {
  play(0.5);
  game.grab(ray_at("ball"));
  ASSERT_TRUE(game.stage().hold());
  EXPECT_EQ(game.stage().hold()->thing, thing("ball"));
  // What is held hangs from its point at the same distance along another ray.
  const PlumbVec3 eye = add(place("ball"), {0, 0, 2});
  const PlumbVec3 way{0.3, 0.8, -std::sqrt(1 - 0.09 - 0.64)};
  const double reach = 2 - 0.4;
  game.drag({eye, way});
  play(2);
  const PlumbVec3 held = to_world(pose("ball"), game.stage().hold()->at);
  EXPECT_NEAR(distance(held, add(eye, scale(reach, way))), 0, 0.05);
  EXPECT_GT(game.picked()->moved, 1);
  game.release();
  EXPECT_FALSE(game.stage().hold());
  play(1.5);
  EXPECT_NEAR(place("ball").y, 0.4, 0.02);
  EXPECT_EQ(game.stage().world().bodies().size(), game.scene().things.size());
}

TEST_F(Playing, SkyAndGroundAreNotPickedUp) {
  game.grab({{0, 5, 5}, {0, 1, 0}});
  EXPECT_FALSE(game.stage().hold());
  game.grab({{6, 5, 6}, {0, -1, 0}});
  EXPECT_FALSE(game.stage().hold());
  EXPECT_FALSE(game.picked());
}

TEST_F(Playing, FramesBetweenStepsAreBlended) {
  play(0.5);
  const std::size_t falling = thing("falling box 3");
  const double before = game.stage().poses()[falling].position.y;
  game.advance(Stage::dt / 2);
  const double half = game.stage().poses()[falling].position.y;
  game.advance(Stage::dt / 2);
  const double whole = game.stage().poses()[falling].position.y;
  EXPECT_LT(whole, before - 0.05);
  EXPECT_NEAR(half, (before + whole) / 2, 1e-6);
}

}  // namespace
}  // namespace plumb::ogre::tests
