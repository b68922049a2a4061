#include "hosts/ogre/game/script.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace plumb::ogre::tests {
namespace {

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(parse_script(text, "file"));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Script, HandsOutEachActionOnceWhenItsTimeHasCome) {
  Script script(parse_script("# comment\n\n2 jump\n0.5 walk 1 -2 # aside\n2 switch ode\n3 switch\n", "file"));
  EXPECT_TRUE(script.due(0.4).empty());
  const auto first = script.due(0.5);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_DOUBLE_EQ(std::get<Walk>(first[0]).z, -2);
  EXPECT_TRUE(script.due(1.9).empty());
  const auto later = script.due(10);
  ASSERT_EQ(later.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<Jump>(later[0]));
  EXPECT_EQ(std::get<SwitchTo>(later[1]).engine, "ode");
  EXPECT_EQ(std::get<SwitchTo>(later[2]).engine, "");
}

TEST(Script, RefusesByFileLineWordAndRemedy) {
  EXPECT_EQ(refusal("1 jmup"), "file:1: there is no action \"jmup\"; did you mean \"jump\"?");
  EXPECT_EQ(refusal("1 jump\n2 walk 1"), "file:2: walk got 1 numbers: write walk X Z (m/s)");
  EXPECT_EQ(refusal("1 walk 1 fast"), "file:1: \"fast\" is no number");
  EXPECT_EQ(refusal("soon jump"), "file:1: \"soon\" is no number");
  EXPECT_EQ(refusal("inf jump"), "file:1: \"inf\" is no number");
  EXPECT_EQ(refusal("-1 jump"), "file:1: time -1 is before the game: write 0 or more");
  EXPECT_EQ(refusal("1"), "file:1: there is a time without an action: write SECONDS ACTION");
  EXPECT_EQ(refusal("1 zoom 0"), "file:1: zoom got a factor of 0 or less: write 0.5 or 2");
  EXPECT_EQ(refusal("1 switch a b"), "file:1: switch takes one engine: switch [ENGINE]");
}

}  // namespace
}  // namespace plumb::ogre::tests
