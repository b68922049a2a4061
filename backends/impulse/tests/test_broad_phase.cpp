// The broad phase against all pairs, tested one by one, and against a sweep of the test's own where they are too many.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "box_fields.hpp"
#include "broad_phase_rig.hpp"

namespace plumb::impulse {
namespace {

/// Movers are the first `movers` boxes; no two statics make a pair.
std::vector<Pair> all_pairs(const std::vector<Box>& boxes, std::uint32_t movers) {
  std::vector<Pair> pairs;
  for (std::uint32_t a = 0; a < movers; ++a)
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
      if (overlap(boxes[a], boxes[b])) pairs.push_back({a, b});
  return pairs;
}

std::uint32_t size(const std::vector<Pair>& pairs) { return static_cast<std::uint32_t>(pairs.size()); }

class BroadPhaseFields : public testing::TestWithParam<Field> {};
std::string field_name(const testing::TestParamInfo<Field>& info) { return name_of(info.param); }
INSTANTIATE_TEST_SUITE_P(All, BroadPhaseFields, testing::ValuesIn(kFields), field_name);

TEST_P(BroadPhaseFields, FindsWhatAllPairsFind) {
  for (const std::uint32_t n : {0U, 1U, 2U, 3U, 7U, 64U, 65U, 1000U, 4096U}) {
    for (const MortonBits bits : {MortonBits::k30, MortonBits::k63}) {
      const std::vector<Box> boxes = make_boxes(GetParam(), n, n);
      for (const std::uint32_t movers : {n, n - n / 5, n / 5, 0U}) {
        BroadPhaseRig rig;
        rig.broad_phase.morton_bits = bits;
        rig.set(boxes, movers);
        const std::vector<Pair> truth = all_pairs(boxes, movers);
        EXPECT_EQ(sorted(rig.find(size(truth))), truth) << n << " boxes, " << movers << " movers";
        EXPECT_EQ(rig.found, size(truth));
      }
    }
  }
}

}  // namespace
}  // namespace plumb::impulse
