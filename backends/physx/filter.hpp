// Which pairs of bodies may touch: filters, excluded pairs, bodies of one joint; and what PhysX then does with a pair.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "physx_math.hpp"

namespace plumb::px {

/// Bodies are told by their slots.
class PairRules {
 public:
  PairRules() = default;
  PairRules(const PairRules&) = delete;
  PairRules& operator=(const PairRules&) = delete;

  void set_filter(std::uint32_t slot, const PlumbFilter& filter);
  /// One more reason why the two do not touch, or one less: -1. Whether that changes something.
  bool keep_apart(std::uint32_t a, std::uint32_t b, int reasons);
  [[nodiscard]] bool may_touch(std::uint32_t a, std::uint32_t b) const;

  /// Has the scene ask these rules, which outlive it.
  void put_filter(PxSceneDesc& desc) const;

  /// Of pairs that collide.
  PxPairFlags flags = PxPairFlag::eCONTACT_DEFAULT;

 private:
  const PairRules* itself_ = this;  ///< PhysX keeps a copy of this pointer
  std::vector<PlumbFilter> filters_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> apart_;
};

/// What the scene asks about the shapes of a body.
[[nodiscard]] inline PxFilterData filter_data(std::uint32_t slot) { return {slot, 0, 0, 0}; }

}  // namespace plumb::px
