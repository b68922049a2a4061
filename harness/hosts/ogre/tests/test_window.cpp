// The whole program in a window that nobody sees, rendered by the processor.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "hosts/ogre/game/game.hpp"
#include "hosts/ogre/tests/picture.hpp"
#include "hosts/ogre/tests/program.hpp"
#include "hosts/ogre/tests/tested_backend.hpp"

namespace plumb::ogre::tests {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kHeld = 0xff3df5;

class Window : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(picture); }

  Json play(const std::string& options) {
    const Ended ended = run_line(PLUMB_XVFB_RUN " -a " PLUMB_OGRE_PROGRAM " --backend " + tested_backend() + " " +
                                 options + " --screenshot " + picture);
    EXPECT_EQ(ended.status, 0) << ended.text;
    return Json::parse(ended.text);
  }
  /// One that the tested backend can hand the game to; "" where there is none.
  static std::string partner() {
    Game game(tested_backend());
    for (const std::string& name : other_backends())
      if (game.switch_to(name)) return name;
    return "";
  }

  std::string picture = testing::TempDir() + "plumb-ogre-" + tested_backend() + ".png";
};

TEST_F(Window, ShowsTheGameFromItsStartToAfterTheSwitch) {
  play("--frames 15");
  const Picture early = read_picture(picture);
  const Seen in_the_air = look_for(early, kFalling);
  EXPECT_GT(distinct_colours(early), 20U);
  EXPECT_GT(in_the_air.pixels, 1000U);
  EXPECT_EQ(look_for(early, kHeld).pixels, 0U);

  const std::string other = partner();
  const std::string line = "--frames 300 --script " PLUMB_DEMO_SCRIPT;
  const Json told = play(other.empty() ? line : line + " --switch-at 3.5 " + other);
  const Picture late = read_picture(picture);
  const Seen landed = look_for(late, kFalling);
  EXPECT_GT(landed.pixels, 1000U);
  EXPECT_GT(landed.row, in_the_air.row + 60);
  const std::size_t held = look_for(late, kHeld).pixels;
  EXPECT_GT(held, 1000U);
  EXPECT_LT(held, 10000U);  // the ball alone

  EXPECT_EQ(told["frames"], 300);
  EXPECT_EQ(told["engine"], other.empty() ? tested_backend() : other);
  const std::size_t bodies = make_scene().things.size();
  EXPECT_EQ(told["bodies"], bodies);
  EXPECT_EQ(told["character"]["ground"], "platform");
  const double top = told["platform_height"].get<double>() + kPlatformHalfExtents.y;
  const double foot = told["character"]["height"].get<double>() - kCharacter.half_height - kCharacter.radius;
  EXPECT_GT(top, 1.5);
  EXPECT_NEAR(foot, top, 0.1);
  EXPECT_EQ(told["picked"]["name"], "ball");
  EXPECT_GT(told["picked"]["moved"].get<double>(), 1);
  EXPECT_EQ(told["positions"].size(), bodies);
  ASSERT_EQ(told["switches"].size(), other.empty() ? 0U : 1U);
  if (other.empty()) return;
  EXPECT_EQ(told["switches"][0]["bodies"], bodies);
  EXPECT_LT(told["switches"][0]["position_error"].get<double>(), 1e-5);
  EXPECT_LT(told["switches"][0]["velocity_error"].get<double>(), 1e-5);
}

TEST_F(Window, GoesOnWhenTheOtherEngineIsMissing) {
  const Json told = play("--frames 60 --switch-at 0.3 no-such-engine");
  EXPECT_EQ(told["frames"], 60);
  EXPECT_EQ(told["engine"], tested_backend());
  EXPECT_EQ(told["switches"].size(), 0U);
  ASSERT_EQ(told["notices"].size(), 1U);
  EXPECT_NE(told["notices"][0].get<std::string>().find("no-such-engine"), std::string::npos);
  // The sentence stands in the window.
  EXPECT_GT(look_for(read_picture(picture), 0x9d0208).pixels, 300U);
}

}  // namespace
}  // namespace plumb::ogre::tests
