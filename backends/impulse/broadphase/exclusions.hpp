// The pairs of bodies that do not collide whatever their filters say: those that joints keep apart, and the exceptions
// of the host. One sorted list for the steps; without any it is empty and costs nothing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "broadphase/pair_filter.hpp"
#include "exec/memory.hpp"

namespace plumb::impulse {

class Exclusions {
 public:
  using Keys = std::vector<std::uint64_t>;  ///< body_pair_key

  /// Those of the joints, all of them, in any order.
  void set_joined(Keys keys) {
    joined_ = std::move(keys);
    changed_ = true;
  }
  void add_exceptions(Keys keys) {
    std::sort(keys.begin(), keys.end());
    Keys all;
    std::set_union(exceptions_.begin(), exceptions_.end(), keys.begin(), keys.end(), std::back_inserter(all));
    become(std::move(all));
  }
  void remove_exceptions(Keys keys) {
    std::sort(keys.begin(), keys.end());
    Keys left;
    std::set_difference(exceptions_.begin(), exceptions_.end(), keys.begin(), keys.end(), std::back_inserter(left));
    become(std::move(left));
  }
  /// Whether the host keeps two bodies apart.
  [[nodiscard]] bool excepts(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(exceptions_.begin(), exceptions_.end(), body_pair_key(a, b));
  }

  /// Copies to where kernels run what has changed.
  void upload() {
    if (!changed_) return;
    Keys all = joined_;
    all.insert(all.end(), exceptions_.begin(), exceptions_.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    // While exceptions come and go the length stays in coarse steps, and a recorded step serves on.
    if (!exceptions_.empty()) all.resize((all.size() + kUnit - 1) / kUnit * kUnit, kNoPair);
    count_ = static_cast<std::uint32_t>(all.size());
    keys_.from_host(all.data(), all.size());
    changed_ = false;
  }

  /// As of the last upload; ascending.
  [[nodiscard]] const std::uint64_t* device() { return keys_.data(); }
  [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
  static constexpr std::size_t kUnit = 64;
  static constexpr std::uint64_t kNoPair = ~std::uint64_t{0};  // a body with itself, and the last of all

  void become(Keys exceptions) {
    exceptions_ = std::move(exceptions);
    changed_ = true;
  }

  Keys joined_, exceptions_;
  bool changed_ = false;
  std::uint32_t count_ = 0;
  Buffer<std::uint64_t> keys_;
};

}  // namespace plumb::impulse
