#include <gtest/gtest.h>

#include "base/locate.hpp"

namespace plumb::harness {
namespace {

const std::string source = R"({
  "a": 1,
  "b": { "c": [10,
    { "brace } in \" source": "]" },
    [1, 2,
     3]
  ] },
  "d":
    true
})";

TEST(Locate, FindsLines) {
  const auto root = nlohmann::json::parse(source);
  const auto line = [&](const nlohmann::json& value) { return line_of(source, path_to(root, &value)); };
  EXPECT_EQ(line(root), 1u);
  EXPECT_EQ(line(root.at("a")), 2u);
  EXPECT_EQ(line(root.at("b").at("c")), 3u);
  EXPECT_EQ(line(root.at("b").at("c").at(0)), 3u);
  EXPECT_EQ(line(root.at("b").at("c").at(1).at("brace } in \" source")), 4u);
  EXPECT_EQ(line(root.at("b").at("c").at(2).at(1)), 5u);
  EXPECT_EQ(line(root.at("b").at("c").at(2).at(2)), 6u);
  EXPECT_EQ(line(root.at("d")), 8u);
}

TEST(Locate, StopsAtTheDeepestPartThatExists) {
  EXPECT_EQ(line_of(source, {std::string("b"), std::string("missing")}), 3u);
  EXPECT_EQ(line_of(source, {std::string("b"), std::string("c"), std::size_t{2}, std::size_t{9}}), 5u);
  EXPECT_EQ(line_of(source, {std::size_t{0}}), 1u);
}

TEST(Locate, LinesOfBytes) {
  EXPECT_EQ(line_of_byte("a\nb\nc", 0), 1u);
  EXPECT_EQ(line_of_byte("a\nb\nc", 2), 2u);
  EXPECT_EQ(line_of_byte("a\nb\nc", 99), 3u);
}

}  // namespace
}  // namespace plumb::harness
