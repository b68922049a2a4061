#include "plumb/nearest.hpp"

#include <gtest/gtest.h>

namespace plumb::test {
namespace {

TEST(Nearest, EditDistance) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("friction", "frictoin"), 1u);  // a swap
  EXPECT_EQ(edit_distance("Tower", "tower"), 0u);
}

TEST(Nearest, FindsWhatWasMeant) {
  const std::vector<std::string> known{"tower", "pyramid", "pile", "pendulum"};
  EXPECT_EQ(nearest("twoer", known), "tower");
  EXPECT_EQ(nearest("pyramide", known), "pyramid");
  EXPECT_EQ(nearest("pend", known), "pendulum");
  EXPECT_EQ(nearest("zzzzz", known), "");
  EXPECT_EQ(nearest("x", {"H"}), "");  // a word of one letter is near to every other, and meant by none
}

TEST(Nearest, EndsAMessage) {
  EXPECT_EQ(suggestion("twoer", {"tower", "pile"}), "; did you mean \"tower\"?");
  EXPECT_EQ(suggestion("zzzzz", {"tower", "pile"}), "; known are tower, pile");
  EXPECT_EQ(suggestion("zzzzz", {}), "");
}

}  // namespace
}  // namespace plumb::test
