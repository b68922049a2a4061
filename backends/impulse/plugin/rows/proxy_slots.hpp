// Which rows of the proxies are in use. A body's first shape has the row of the body's own slot where that is free, so
// that a world without compounds has as many proxies as bodies; the other children of compounds have any other row.
#pragma once

#include <cstdint>
#include <vector>

#include "exec/archive.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

class ProxySlots {
 public:
  std::uint32_t take(std::uint32_t body_slot) {
    if (is_taken(body_slot)) return take_any(body_slot + 1);
    mark(body_slot);
    return body_slot;
  }
  /// A row that was given back, or one behind all in use and not below `least`.
  std::uint32_t take_any(std::uint32_t least) {
    while (!free_.empty()) {
      const std::uint32_t row = free_.back();
      free_.pop_back();
      listed_[row] = false;
      if (!is_taken(row)) return mark(row);
    }
    const auto end = static_cast<std::uint32_t>(taken_.size());
    return mark(end < least ? least : end);
  }
  void give_back(std::uint32_t row) {
    PLUMB_ASSERT(is_taken(row));
    taken_[row] = false;
    if (listed_[row]) return;
    listed_[row] = true;
    free_.push_back(row);
  }
  /// One beyond the last row that was ever in use.
  [[nodiscard]] std::uint32_t end() const { return static_cast<std::uint32_t>(taken_.size()); }
  /// To or from a snapshot.
  void exchange(Archive& archive) {
    std::vector<std::uint8_t> rows;  // bit 0: taken, bit 1: listed
    for (std::size_t row = 0; row < taken_.size(); ++row)
      rows.push_back(static_cast<std::uint8_t>((taken_[row] ? 1 : 0) + (listed_[row] ? 2 : 0)));
    archive.list(rows);
    archive.list(free_);
    if (!archive.reads()) return;
    taken_.resize(rows.size());
    listed_.resize(rows.size());
    for (std::size_t row = 0; row < rows.size(); ++row) {
      taken_[row] = (rows[row] & 1) != 0;
      listed_[row] = (rows[row] & 2) != 0;
    }
  }
  /// Never more than end(), however many rows come and go.
  [[nodiscard]] std::size_t listed() const { return free_.size(); }

 private:
  [[nodiscard]] bool is_taken(std::uint32_t row) const { return row < taken_.size() && taken_[row]; }
  std::uint32_t mark(std::uint32_t row) {
    if (row >= taken_.size()) {
      taken_.resize(row + 1);
      listed_.resize(row + 1);
    }
    taken_[row] = true;
    return row;
  }

  std::vector<bool> taken_;
  std::vector<std::uint32_t> free_;  // may hold rows that were taken since as a body's own
  std::vector<bool> listed_;         // in free_
};

}  // namespace plumb::impulse
