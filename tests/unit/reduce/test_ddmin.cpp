// ddmin against brute force: what it leaves fails, and no single thing of it can go.
#include "reduce/ddmin.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

namespace plumb::harness {
namespace {

using Numbers = std::vector<int>;

Numbers up_to(int count) {
  Numbers all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TEST(Ddmin, LeavesWhatItTakes) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const int count = 1 + static_cast<int>(random() % 60);
    std::set<int> culprits;
    for (auto i = random() % 5; i > 0; --i)
      culprits.insert(static_cast<int>(random() % static_cast<std::size_t>(count)));
    const auto fails = [&](const Numbers& some) {
      return std::includes(some.begin(), some.end(), culprits.begin(), culprits.end());
    };
    EXPECT_EQ(ddmin<int>(up_to(count), fails), Numbers(culprits.begin(), culprits.end()));
  }
}

TEST(Ddmin, LeavesNothingThatCanGoAlone) {
  // Fails while three or more of one kind are there, of which there are several ways.
  const auto fails = [](const Numbers& some) {
    int kinds[3] = {0, 0, 0};
    for (const int i : some) ++kinds[i % 3];
    return kinds[0] >= 3 || kinds[1] >= 3 || kinds[2] >= 3;
  };
  const Numbers left = ddmin<int>(up_to(50), fails);
  EXPECT_TRUE(fails(left));
  EXPECT_EQ(left.size(), 3u);
}

TEST(Ddmin, AsksAboutTheLogarithmWhereOneIsToBlame) {
  int asked = 0;
  const Numbers left = ddmin<int>(up_to(1024), [&](const Numbers& some) {
    ++asked;
    return std::find(some.begin(), some.end(), 700) != some.end();
  });
  EXPECT_EQ(left, Numbers{700});
  EXPECT_LT(asked, 40);
}

TEST(Ddmin, OfWhatFailsAloneIsNothing) {
  EXPECT_TRUE(ddmin<int>(up_to(9), [](const Numbers&) { return true; }).empty());
  EXPECT_TRUE(ddmin<int>({}, [](const Numbers&) { return true; }).empty());
}

}  // namespace
}  // namespace plumb::harness
