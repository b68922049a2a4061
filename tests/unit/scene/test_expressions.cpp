#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "base/units.hpp"
#include "scene/expressions.hpp"
#include "scene/generators.hpp"

namespace plumb::harness {
namespace {

std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

std::string refusal(Expressions& expressions, const std::string& text) {
  return message([&] { static_cast<void>(expressions.evaluate(text)); });
}

TEST(Expressions, ComputeWithNamesAndFunctions) {
  Expressions e;
  e.set("H", 10);
  EXPECT_DOUBLE_EQ(e.evaluate("H - 1/2"), 9.5);
  EXPECT_DOUBLE_EQ(e.evaluate("sin(deg(30)) + pi"), 0.5 + 3.141592653589793);
  EXPECT_DOUBLE_EQ(e.evaluate("mod(-1, 8) + floor(2.7) + ceil(2.1) + round(2.5)"), 7 + 2 + 3 + 3);
  EXPECT_DOUBLE_EQ(e.evaluate("H > 5 && H < 20 ? 3 : 4"), 3);
  e.set("H", 4);
  EXPECT_DOUBLE_EQ(e.evaluate("H - 1/2"), 3.5);
}

TEST(Expressions, CompareWordsWithTheirChoices) {
  Expressions e;
  e.add_word("sphere");
  e.add_word("cylinder");
  e.set_word("kind", "cylinder");
  EXPECT_EQ(e.evaluate("kind == cylinder"), 1);
  EXPECT_EQ(e.evaluate("kind == sphere"), 0);
  EXPECT_EQ(e.evaluate("kind != sphere ? 7 : 8"), 7);
}

TEST(Expressions, DrawNumbersThatDependOnSeedAndPlaceOnly) {
  Expressions e;
  e.set("i", 3);
  const double drawn = e.evaluate("random(7, i)");
  EXPECT_EQ(drawn, SplitMix64((std::uint64_t{7} << 32) + 3).uniform());
  EXPECT_NE(drawn, e.evaluate("random(3, 7)"));
  double sum = 0, squares = 0;
  for (int i = 0; i < 10000; ++i) {
    e.set("i", i);
    const double x = e.evaluate("random(1, i)");
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / 1e4, 1. / 2, 0.01);  // 3.5 standard deviations of the mean
  EXPECT_NEAR(squares / 1e4, 1. / 3, 0.01);
  EXPECT_NE(refusal(e, "random(0.5, 1)").find("seed 0.5 is not a whole number"), std::string::npos);
  EXPECT_NE(refusal(e, "random(1, 0 - 1)").find("i -1 is not"), std::string::npos);
}

TEST(Expressions, ReplaceBracesInNames) {
  Expressions e;
  e.set("i", 3);
  e.set_word("kind", "ball");
  EXPECT_EQ(e.interpolate("link{i+1}_of_{kind}"), "link4_of_ball");
  EXPECT_EQ(e.interpolate("plain"), "plain");
  EXPECT_NE(message([&] { static_cast<void>(e.interpolate("x{i / 2}")); }).find("whole number"), std::string::npos);
  EXPECT_NE(message([&] { static_cast<void>(e.interpolate("x{i")); }).find("without"), std::string::npos);
}

TEST(Expressions, SayWhatIsWrong) {
  Expressions e;
  e.set("height", 1);
  EXPECT_NE(refusal(e, "2 * heigth").find("did you mean \"height\"?"), std::string::npos);
  EXPECT_NE(refusal(e, "sqr(2)").find("\"sqrt\""), std::string::npos);
  EXPECT_NE(refusal(e, "2 *").find("not an expression"), std::string::npos);
  EXPECT_NE(refusal(e, "").find("not an expression"), std::string::npos);
  EXPECT_NE(refusal(e, "1 / 0").find("gives inf"), std::string::npos);
  e.set("heigth", 5);  // a name that comes later is known to texts that failed before
  EXPECT_EQ(e.evaluate("2 * heigth"), 10);
  e.erase("heigth");
  EXPECT_NE(refusal(e, "2 * heigth").find("unknown name"), std::string::npos);
}

TEST(Units, ConvertWhatMeasuresTheSame) {
  EXPECT_DOUBLE_EQ(conversion("cm", "m"), 0.01);
  EXPECT_DOUBLE_EQ(conversion("deg", "rad"), 3.141592653589793 / 180);
  EXPECT_DOUBLE_EQ(conversion("km/h", "m/s"), 1 / 3.6);
  EXPECT_DOUBLE_EQ(conversion("N m", "kg m2/s2"), 1);
  EXPECT_DOUBLE_EQ(conversion("%", "1"), 0.01);
  EXPECT_NE(message([] { static_cast<void>(conversion("kg", "m")); }).find("does not measure"), std::string::npos);
  EXPECT_NE(message([] { static_cast<void>(conversion("dge", "rad")); }).find("\"deg\""), std::string::npos);
  EXPECT_TRUE(is_unit("rad/s"));
  EXPECT_FALSE(is_unit("furlong"));
  EXPECT_FALSE(is_unit(""));
}

}  // namespace
}  // namespace plumb::harness
