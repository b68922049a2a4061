#include "filter.hpp"

#include <algorithm>

namespace plumb::px {
namespace {

PxFilterFlags filter(PxFilterObjectAttributes, PxFilterData a, PxFilterObjectAttributes, PxFilterData b,
                     PxPairFlags& flags, const void* constants, PxU32) {
  const PairRules& rules = **static_cast<const PairRules* const*>(constants);
  if (!rules.may_touch(a.word0, b.word0)) return PxFilterFlag::eKILL;
  flags = rules.flags;
  return PxFilterFlag::eDEFAULT;
}

}  // namespace

void PairRules::put_filter(PxSceneDesc& desc) const {
  desc.filterShader = filter;
  desc.filterShaderData = &itself_;
  desc.filterShaderDataSize = sizeof itself_;
}

void PairRules::set_filter(std::uint32_t slot, const PlumbFilter& filter) {
  if (slot >= filters_.size()) filters_.resize(slot + 1);
  filters_[slot] = filter;
}

bool PairRules::keep_apart(std::uint32_t a, std::uint32_t b, int reasons) {
  const std::pair<std::uint32_t, std::uint32_t> pair = std::minmax(a, b);
  int& all = apart_[pair];
  const bool was = all != 0;
  all += reasons;
  const bool is = all != 0;
  if (!is) apart_.erase(pair);
  return was != is;
}

bool PairRules::may_touch(std::uint32_t a, std::uint32_t b) const {
  if (!plumb::may_touch(filters_[a], filters_[b])) return false;
  return apart_.empty() || !apart_.contains(std::minmax(a, b));
}

}  // namespace plumb::px
