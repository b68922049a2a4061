// Sets of bodies that hang together, which grow joint by joint: what would close a loop is no link of a tree.
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace plumb::articulated {

/// Disjoint sets (Tarjan 1975) of so many bodies, by number; some have a root that nothing moves.
class BodySets {
 public:
  explicit BodySets(std::size_t count) : parent_(count), rooted_(count, false) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void root(std::size_t i) { rooted_[i] = true; }
  /// False where they hang together already, or both have such a root.
  bool join(std::size_t i, std::size_t k) {
    i = find(i), k = find(k);
    if (i == k || (rooted_[i] && rooted_[k])) return false;
    if (rooted_[k]) std::swap(i, k);
    parent_[k] = i;
    return true;
  }

 private:
  std::vector<std::size_t> parent_;
  std::vector<bool> rooted_;
};

}  // namespace plumb::articulated
