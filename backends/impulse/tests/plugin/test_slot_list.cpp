// A list of slots does what a plain vector that is searched would do.
#include "plugin/rows/slot_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/hashes/scene.hpp"

namespace plumb::impulse {
namespace {

TEST(SlotList, IsAListWithoutDoubles) {
  test::Random random(3);
  SlotList list;
  std::vector<std::uint32_t> plain;
  for (int i = 0; i < 5000; ++i) {
    const auto slot = static_cast<std::uint32_t>(random.next() % 300);
    if (i % 97 == 0) {
      const auto goes = [&](std::uint32_t one) { return one % 3 == slot % 3; };
      list.remove_if(goes);
      std::erase_if(plain, goes);
    } else {
      list.add(slot);
      if (std::find(plain.begin(), plain.end(), slot) == plain.end()) plain.push_back(slot);
    }
    ASSERT_TRUE(std::equal(list.begin(), list.end(), plain.begin(), plain.end())) << i;
  }
  EXPECT_FALSE(list.empty());
}

TEST(SlotList, ComesOutOfASnapshotAsItWentIn) {
  SlotList list, other;
  for (const std::uint32_t slot : {7U, 2U, 90U}) list.add(slot);
  other.add(5);
  Archive out;
  list.exchange(out);
  const std::vector<std::byte> bytes = out.take_bytes();
  Archive in(bytes);
  other.exchange(in);
  EXPECT_TRUE(std::equal(other.begin(), other.end(), list.begin(), list.end()));
  other.add(2);  // is known to be there
  other.add(5);  // is known to be gone
  EXPECT_EQ(std::vector<std::uint32_t>(other.begin(), other.end()), (std::vector<std::uint32_t>{7, 2, 90, 5}));
}

}  // namespace
}  // namespace plumb::impulse
