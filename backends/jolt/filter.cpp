// This file is compiled without run-time type information, as Jolt is: its class GroupFilter has none.
#include "filter.hpp"

#include <Jolt/Physics/Collision/CollisionGroup.h>

#include <algorithm>

namespace plumb::jolt {
namespace {

class RuleFilter final : public JPH::GroupFilter {
 public:
  explicit RuleFilter(const PairRules& rules) : rules_(rules) {}

  bool CanCollide(const JPH::CollisionGroup& a, const JPH::CollisionGroup& b) const override {
    return rules_.may_touch(a.GetGroupID(), b.GetGroupID());
  }

 private:
  const PairRules& rules_;
};

}  // namespace

PairRules::PairRules() : filter_(new RuleFilter(*this)) {}

void PairRules::set_filter(std::uint32_t slot, const PlumbFilter& filter) {
  if (slot >= filters_.size()) filters_.resize(slot + 1);
  filters_[slot] = filter;
}

void PairRules::keep_apart(std::uint32_t a, std::uint32_t b, int reasons) {
  const std::pair<std::uint32_t, std::uint32_t> pair = std::minmax(a, b);
  if ((apart_[pair] += reasons) == 0) apart_.erase(pair);
}

bool PairRules::may_touch(std::uint32_t a, std::uint32_t b) const {
  if (a >= filters_.size() || b >= filters_.size()) return true;  // one of them has no group
  if (!plumb::may_touch(filters_[a], filters_[b])) return false;
  return apart_.empty() || !apart_.contains(std::minmax(a, b));
}

}  // namespace plumb::jolt
