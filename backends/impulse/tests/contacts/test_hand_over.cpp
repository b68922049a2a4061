// Contacts that take turns on a body: each awaits what the one before leaves, in the order of their colours.
#include <gtest/gtest.h>

#include <random>

#include "contacts/hand_over.hpp"

namespace plumb::impulse {
namespace {

TEST(HandOver, EachContactAwaitsWhatTheOneBeforeLeaves) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 1000; ++round) {
    const std::uint64_t colours = (round == 0 ? ~std::uint64_t{0} : random() & random()) >> (64 - kColours);
    int left = 0;
    for (std::uint32_t colour = 0; colour < kColours; ++colour) {
      if ((colours >> colour & 1U) == 0) continue;
      const Turn turn = turn_of(colours, colour);
      EXPECT_EQ(turn.awaits, left);
      const bool is_last = colour + 1 == kColours || colours >> (colour + 1) == 0;
      EXPECT_EQ(turn.leaves, is_last ? 0 : left + 1);
      left = turn.leaves;
    }
    EXPECT_EQ(left, 0);
  }
}

TEST(HandOver, WhoHasNoColourHasNoTurn) {
  const Turn turn = turn_of(~std::uint64_t{0}, kOverflow);
  EXPECT_EQ(turn.awaits, 0);
  EXPECT_EQ(turn.leaves, 0);
}

TEST(HandOver, OneLoopIsForAGpuAndForLargeColours) {
  EXPECT_EQ(longest_loop(kFewContacts, 1000, true), contact_loop(kFewContacts));
  EXPECT_EQ(longest_loop(100, 1000, false), contact_loop(100));
  EXPECT_EQ(longest_loop(100, 1000, true), contact_loop(kHandsOver ? 1000 : 100));
}

}  // namespace
}  // namespace plumb::impulse
