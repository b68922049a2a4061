// Which pairs of bodies may touch, where layers do not say it: filters, excluded pairs, bodies of one joint.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/GroupFilter.h>

#include <map>
#include <utility>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::jolt {

/// Bodies are told by their slots.
class PairRules {
 public:
  PairRules();

  void set_filter(std::uint32_t slot, const PlumbFilter& filter);
  /// One more reason why the two do not touch, or one less: -1.
  void keep_apart(std::uint32_t a, std::uint32_t b, int reasons);
  [[nodiscard]] bool may_touch(std::uint32_t a, std::uint32_t b) const;

  /// What Jolt asks, for bodies whose group is their slot. Bodies without it are asked about nowhere.
  [[nodiscard]] const JPH::GroupFilter* group_filter() const { return filter_; }

 private:
  std::vector<PlumbFilter> filters_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> apart_;
  JPH::Ref<JPH::GroupFilter> filter_;
};

}  // namespace plumb::jolt
