#include "base/format.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumb::harness {
namespace {

TEST(Format, ShortNumbers) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(0.012345), "0.0123");
  EXPECT_EQ(short_number(9.999), "10.0");
  EXPECT_EQ(short_number(1234.5), "1234");
  EXPECT_EQ(short_number(3.1e-5), "3.1e-5");
  EXPECT_EQ(short_number(1.5e9), "1.5e9");
  EXPECT_EQ(short_number(-0.5, 2), "-0.50");
  EXPECT_EQ(short_number(std::nan("")), "nan");
  EXPECT_EQ(short_number(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(short_number(std::nullopt), no_value);
}

TEST(Format, LimitsHaveNoNoise) {
  EXPECT_EQ(limit_text(0.01), "0.01");
  EXPECT_EQ(limit_text(100), "100");
  EXPECT_EQ(limit_text(1e-4), "1e-4");
  EXPECT_EQ(limit_text(0.00841666), "0.00842");
}

TEST(Format, ShortestNumbersReadBack) {
  for (const double value : {0.1, 1.0 / 3, 1.0 / 60, 1e300, -2.5e-7, 12345678.9, 0.0}) {
    EXPECT_EQ(std::stod(shortest_number(value)), value);
  }
  EXPECT_EQ(shortest_number(50), "50");
}

TEST(Format, TimeStepsAreFractions) {
  EXPECT_EQ(dt_text(1.0 / 60), "1/60");
  EXPECT_EQ(dt_text(1.0 / 960), "1/960");
  EXPECT_EQ(dt_text(0.0123), "0.0123");
  EXPECT_EQ(dt_text(2.0), "2");
  EXPECT_EQ(dt_text(0.005892556509887896), "1/169.7");
  EXPECT_EQ(dt_text(std::nullopt), no_value);
}

TEST(Format, ClippingCountsCodePoints) {
  EXPECT_EQ(clipped("straße", 6), "straße");
  EXPECT_EQ(clipped("straßen", 6), "straß…");
  EXPECT_EQ(clipped("abc", 0), "");
  EXPECT_EQ(text_width(clipped("ééééé", 3)), 3u);
}

TEST(Format, NothingUnprintableSurvives) {
  EXPECT_EQ(printable("a\x1b[31mb\n"), "a [31mb ");
  EXPECT_EQ(printable("\xff\xc3\x28"), "\uFFFD\uFFFD(");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD") << "half of a UTF-16 pair";
  EXPECT_EQ(printable("\xc2\x9b"
                      "1m"),
            " 1m")
      << "the eight-bit escape sequence introducer";
  EXPECT_EQ(printable("µ≤𝛼"), "µ≤𝛼");
}

TEST(Format, NaturalOrder) {
  EXPECT_TRUE(natural_less("A2", "A10"));
  EXPECT_FALSE(natural_less("A10", "A2"));
  EXPECT_TRUE(natural_less("A5", "A5b"));
  EXPECT_TRUE(natural_less("A5b", "A6"));
  EXPECT_FALSE(natural_less("A5b", "A5b"));
}

}  // namespace
}  // namespace plumb::harness
