// Slots with generations: what turns handles into indices, and stale handles into answers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "plumb/assert.hpp"
#include "plumb/backend/host_memory.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::backend {

/// Whose handles live, in order of creation, and those that come next, the last first.
struct Slots {
  std::vector<std::uint64_t> order, free;

  [[nodiscard]] bool are_distinct() const {
    std::vector<std::uint32_t> all;
    for (const std::vector<std::uint64_t>* handles : {&order, &free})
      for (const std::uint64_t handle : *handles) {
        if (generation_of(handle) == 0) return false;
        all.push_back(slot_of(handle));
      }
    std::sort(all.begin(), all.end());
    return std::adjacent_find(all.begin(), all.end()) == all.end();
  }
};

/// Live objects of one kind, with a Record each and their order of creation.
template <class Record>
class SlotTable {
 public:
  SlotTable() = default;
  /// As it stood when slots() gave these. records: in order of creation. Of the slots that are named nowhere the
  /// generations are used up.
  SlotTable(const Slots& slots, std::vector<Record> records) : order_(slots.order.begin(), slots.order.end()) {
    const auto entry = [this](std::uint64_t handle) -> Entry& {
      if (slot_of(handle) >= entries_.size()) entries_.resize(slot_of(handle) + std::size_t{1});
      return entries_[slot_of(handle)];
    };
    for (std::size_t i = 0; i < order_.size(); ++i)
      entry(order_[i]) = {std::move(records[i]), generation_of(order_[i]), true};
    for (const std::uint64_t handle : slots.free) {
      entry(handle) = {Record{}, generation_of(handle), false};
      free_.push_back(slot_of(handle));
    }
  }
  [[nodiscard]] Slots slots() const {
    Slots slots{{order_.begin(), order_.end()}, {}};
    for (const std::uint32_t slot : free_)
      slots.free.push_back((std::uint64_t{entries_[slot].generation} << 32) | slot);
    return slots;
  }

  /// Allots a handle; the record starts as given. Where memory runs out, nothing has changed.
  std::uint64_t add(Record record) {
    make_room(order_, order_.size() + 1);
    make_room(free_, entries_.size() + 1);  // so that none is needed to remove it again
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
  template <class Value>
  static void make_room(HostVector<Value>& values, std::size_t size) {
    if (values.capacity() < size) values.reserve(std::max(size, 2 * values.capacity()));
  }

  struct Entry {
    Record record{};
    std::uint32_t generation = 0;
    bool live = false;
  };
  HostVector<Entry> entries_;
  HostVector<std::uint32_t> free_;
  HostVector<std::uint64_t> order_;
};

}  // namespace plumb::backend
