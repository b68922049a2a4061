// What queries answer, out of what an engine finds in any order: one hit a body, its nearest, sorted as queries.h
// states.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::backend {

/// For one query of a batch: add() whatever is found, then finish(). Appends to a list that a batch shares.
class HitCollector {
 public:
  HitCollector(std::vector<PlumbHit>& hits, std::uint32_t query, PlumbHitMode mode)
      : hits_(hits), query_(query), mode_(mode), first_(hits.size()) {}

  void add(PlumbBody body, std::uint32_t child, double fraction, const PlumbVec3& position, const PlumbVec3& normal) {
    const PlumbHit hit{body, query_, child, fraction, position, normal};
    for (std::size_t i = first_; i < hits_.size(); ++i) {
      PlumbHit& other = hits_[i];
      if (mode_ == PLUMB_HIT_ALL && other.body != body) continue;
      if (before(hit, other)) other = hit;
      return;
    }
    hits_.push_back(hit);
  }
  /// An overlap has neither a place nor a normal.
  void add_overlap(PlumbBody body, std::uint32_t child) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    add(body, child, 0, {none, none, none}, {none, none, none});
  }

  [[nodiscard]] PlumbHitMode mode() const { return mode_; }
  [[nodiscard]] bool any() const { return hits_.size() > first_; }
  /// Of the nearest hit so far; 1 where there is none: no need to look further in PLUMB_HIT_CLOSEST.
  [[nodiscard]] double nearest() const { return any() && mode_ == PLUMB_HIT_CLOSEST ? hits_[first_].fraction : 1; }

  /// A row of body 0 where PLUMB_HIT_CLOSEST has found nothing.
  void finish() {
    if (mode_ == PLUMB_HIT_CLOSEST && !any()) {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      hits_.push_back({0, query_, 0, none, {none, none, none}, {none, none, none}});
    }
    std::sort(hits_.begin() + static_cast<std::ptrdiff_t>(first_), hits_.end(), before);
  }

 private:
  static bool before(const PlumbHit& a, const PlumbHit& b) {
    return a.fraction != b.fraction ? a.fraction < b.fraction : slot_of(a.body) < slot_of(b.body);
  }

  std::vector<PlumbHit>& hits_;
  std::uint32_t query_;
  PlumbHitMode mode_;
  std::size_t first_;
};

/// Of what a batch found, query after query, but pieces of a body each by itself and in any order: for each query the
/// deepest of each body, the deepest body first. rows is sorted and shortened.
[[nodiscard]] inline std::span<const PlumbPenetration> deepest_of_bodies(std::span<PlumbPenetration> rows) {
  using Row = PlumbPenetration;
  auto end = rows.begin();
  for (auto first = rows.begin(); first != rows.end();) {
    const auto next = std::find_if(first, rows.end(), [&](const Row& row) { return row.query != first->query; });
    std::sort(first, next, [](const Row& a, const Row& b) {
      return std::tuple(slot_of(a.body), -a.depth, a.child) < std::tuple(slot_of(b.body), -b.depth, b.child);
    });
    const auto last = std::unique(first, next, [](const Row& a, const Row& b) { return a.body == b.body; });
    std::sort(first, last, [](const Row& a, const Row& b) {
      return std::tuple(-a.depth, slot_of(a.body)) < std::tuple(-b.depth, slot_of(b.body));
    });
    end = end == first ? last : std::move(first, last, end);
    first = next;
  }
  return {rows.begin(), end};
}

}  // namespace plumb::backend
