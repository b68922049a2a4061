#include <gtest/gtest.h>

#include "scene/parameters.hpp"

namespace plumb::harness {
namespace {

ParameterSpec height() { return {"height", "m", "a height", 1.0, {}, 0.1, 50.0, false}; }

std::string refusal(const ParameterSpec& spec, const std::string& text) {
  try {
    static_cast<void>(parse_parameter(spec, text));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Parameters, AreNumbersExpressionsOrNumbersWithUnits) {
  const ParameterSpec spec = height();
  EXPECT_EQ(std::get<double>(parse_parameter(spec, "2.5")), 2.5);
  EXPECT_EQ(std::get<double>(parse_parameter(spec, "1e1")), 10);
  EXPECT_EQ(std::get<double>(parse_parameter(spec, "1/4")), 0.25);
  EXPECT_DOUBLE_EQ(std::get<double>(parse_parameter(spec, " 50 cm ")), 0.5);
  EXPECT_DOUBLE_EQ(std::get<double>(parse_parameter(spec, "50cm")), 0.5);
}

TEST(Parameters, AreRefusedInWords) {
  const ParameterSpec spec = height();
  EXPECT_NE(refusal(spec, "50 mn").find("unknown unit \"mn\"; did you mean \"m"), std::string::npos)
      << refusal(spec, "50 mn");
  EXPECT_NE(refusal(spec, "5 kg").find("does not measure"), std::string::npos);
  EXPECT_NE(refusal(spec, "51").find("above its maximum 50"), std::string::npos);
  EXPECT_NE(refusal(spec, "0").find("below its minimum 0.1"), std::string::npos);
  EXPECT_NE(refusal(spec, "tall").find("a number in m is wanted"), std::string::npos);
  EXPECT_NE(refusal(spec, "").find("parameter height"), std::string::npos);
  EXPECT_NE(refusal(spec, "nan").find("parameter height"), std::string::npos);
  ParameterSpec count = height();
  count.integer = true;
  EXPECT_NE(refusal(count, "2.5").find("whole number"), std::string::npos);
}

TEST(Parameters, MayBeWords) {
  const ParameterSpec kind{"kind", "", "a word", std::string("sphere"), {"sphere", "cylinder"}, {}, {}, false};
  EXPECT_EQ(std::get<std::string>(parse_parameter(kind, "cylinder")), "cylinder");
  EXPECT_NE(refusal(kind, "cilinder").find("did you mean \"cylinder\"?"), std::string::npos);
  EXPECT_THROW(check_parameter(kind, 1.0), UsageError);
  EXPECT_THROW(check_parameter(height(), std::string("sphere")), UsageError);
}

}  // namespace
}  // namespace plumb::harness
