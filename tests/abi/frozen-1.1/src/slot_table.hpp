// Slots with generations: what turns handles into indices, and stale handles into answers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plumb/assert.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::backend {

/// Live objects of one kind, with a Record each and their order of creation.
template <class Record>
class SlotTable {
 public:
  /// Allots a handle; the record starts as given.
  std::uint64_t add(Record record) {
    std::uint32_t slot = 0;
    if (free_.empty()) {
      slot = static_cast<std::uint32_t>(entries_.size());
      entries_.push_back({std::move(record), 1, true});
    } else {
      slot = free_.back();
      free_.pop_back();
      PLUMB_ASSERT(!entries_[slot].live && entries_[slot].generation != 0);
      entries_[slot].record = std::move(record);
      entries_[slot].live = true;
    }
    const std::uint64_t handle = (std::uint64_t{entries_[slot].generation} << 32) | slot;
    order_.push_back(handle);
    return handle;
  }

  [[nodiscard]] bool alive(std::uint64_t handle) const {
    const std::uint32_t slot = slot_of(handle);
    return slot < entries_.size() && entries_[slot].live && entries_[slot].generation == generation_of(handle);
  }

  /// Only for live handles.
  [[nodiscard]] Record& operator[](std::uint64_t handle) {
    PLUMB_ASSERT(alive(handle));
    return entries_[slot_of(handle)].record;
  }
  [[nodiscard]] const Record& operator[](std::uint64_t handle) const {
    PLUMB_ASSERT(alive(handle));
    return entries_[slot_of(handle)].record;
  }

  /// Frees live handles, each named once. A slot whose generations are used up is never given out again.
  void remove(std::span<const std::uint64_t> handles) {
    for (const std::uint64_t handle : handles) {
      PLUMB_ASSERT(alive(handle));
      Entry& entry = entries_[slot_of(handle)];
      entry.live = false;
      entry.record = Record{};
      if (++entry.generation != 0) free_.push_back(slot_of(handle));
    }
    std::erase_if(order_, [this](std::uint64_t handle) { return !alive(handle); });
  }

  [[nodiscard]] std::span<const std::uint64_t> in_order() const { return order_; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(order_.size()); }

 private:
  struct Entry {
    Record record;
    std::uint32_t generation;
    bool live;
  };
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint64_t> order_;
};

}  // namespace plumb::backend
