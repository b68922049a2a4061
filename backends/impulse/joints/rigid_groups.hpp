// Bodies that joints hold as one rigid piece. A contact within a piece could only work against the joints, both of them
// exactly, so there is none ("welded" bodies do not collide in MuJoCo either: its documentation, "Collision
// detection").
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "broadphase/pair_filter.hpp"

namespace plumb::impulse {

/// Larger groups collide within, but for what is joined itself: their pairs would be too many to list.
constexpr std::size_t kMostInRigidGroup = 64;

class RigidGroups {
 public:
  /// They are one piece from now on.
  void weld(std::uint32_t a, std::uint32_t b) {
    if (const std::size_t needed = std::size_t{max(a, b)} + 1; parents_.size() < needed) {
      const auto first = static_cast<std::uint32_t>(parents_.size());
      parents_.resize(needed);
      std::iota(parents_.data() + first, parents_.data() + needed, first);
    }
    const std::uint32_t root_a = root(a), root_b = root(b);
    parents_[max(root_a, root_b)] = min(root_a, root_b);
    welded_.insert(welded_.end(), {a, b});
  }

  /// body_pair_key of every two bodies of a group.
  [[nodiscard]] std::vector<std::uint64_t> pairs() {
    std::sort(welded_.begin(), welded_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(root(a), a) < std::pair(root(b), b); });
    welded_.erase(std::unique(welded_.begin(), welded_.end()), welded_.end());
    std::vector<std::uint64_t> keys;
    for (auto first = welded_.begin(); first != welded_.end();) {
      const auto end =
          std::find_if(first, welded_.end(), [&](std::uint32_t body) { return root(body) != root(*first); });
      if (static_cast<std::size_t>(end - first) <= kMostInRigidGroup)
        for (auto a = first; a != end; ++a)
          for (auto b = a + 1; b != end; ++b) keys.push_back(body_pair_key(*a, *b));
      first = end;
    }
    return keys;
  }

 private:
  std::uint32_t root(std::uint32_t body) {
    while (parents_[body] != body) body = std::exchange(parents_[body], parents_[parents_[body]]);
    return body;
  }

  std::vector<std::uint32_t> welded_;   // bodies, some more than once
  std::vector<std::uint32_t> parents_;  // by body; of one that stands for its group itself
};

}  // namespace plumb::impulse
