// Slots in the order in which they were added, none of them twice; whether one is among them is known at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exec/archive.hpp"

namespace plumb::impulse {

class SlotList {
 public:
  void add(std::uint32_t slot) {
    if (slot >= has_.size()) has_.resize(slot + std::size_t{1});
    if (has_[slot]) return;
    has_[slot] = true;
    list_.push_back(slot);
  }
  template <class F>
  void remove_if(const F& f) {
    std::erase_if(list_, [&](std::uint32_t slot) {
      if (!f(slot)) return false;
      has_[slot] = false;
      return true;
    });
  }
  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] auto begin() const { return list_.begin(); }
  [[nodiscard]] auto end() const { return list_.end(); }
  [[nodiscard]] std::span<const std::uint32_t> all() const { return list_; }

  /// To or from a snapshot.
  void exchange(Archive& archive) {
    std::vector<std::uint32_t> list = list_;
    archive.list(list);
    if (!archive.reads()) return;
    remove_if([](std::uint32_t) { return true; });
    for (const std::uint32_t slot : list) add(slot);
  }

 private:
  std::vector<std::uint32_t> list_;
  std::vector<bool> has_;  // by slot
};

}  // namespace plumb::impulse
