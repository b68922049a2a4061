// The pairs of bodies that a host keeps apart, as a sorted list.
#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::backend {

/// All bodies in it are alive, so that slots name them.
class PairExceptions {
 public:
  using Pairs = std::vector<PlumbBodyPair>;

  /// The order of plumb.exceptions/1.
  static bool before(const PlumbBodyPair& x, const PlumbBodyPair& y) {
    return std::pair(slot_of(x.body_a), slot_of(x.body_b)) < std::pair(slot_of(y.body_a), slot_of(y.body_b));
  }

  [[nodiscard]] const Pairs& list() const { return list_; }
  [[nodiscard]] bool holds(const PlumbBodyPair& pair) const {
    return std::binary_search(list_.begin(), list_.end(), pair, before);
  }

  /// Of those asked for the ones that are not so yet: in order, each once, the lower slot first.
  [[nodiscard]] Pairs changes(Pairs asked, bool touch) const {
    for (PlumbBodyPair& pair : asked)
      if (slot_of(pair.body_b) < slot_of(pair.body_a)) std::swap(pair.body_a, pair.body_b);
    std::sort(asked.begin(), asked.end(), before);
    const auto same = [](const PlumbBodyPair& x, const PlumbBodyPair& y) { return !before(x, y) && !before(y, x); };
    asked.erase(std::unique(asked.begin(), asked.end(), same), asked.end());
    std::erase_if(asked, [&](const PlumbBodyPair& pair) { return holds(pair) != touch; });
    return asked;
  }

  /// Those in which one of these bodies is.
  [[nodiscard]] Pairs of(std::span<const PlumbBody> bodies) const {
    if (list_.empty()) return {};
    std::vector<PlumbBody> sorted(bodies.begin(), bodies.end());
    std::sort(sorted.begin(), sorted.end());
    const auto is_one = [&](PlumbBody body) { return std::binary_search(sorted.begin(), sorted.end(), body); };
    Pairs found;
    std::copy_if(list_.begin(), list_.end(), std::back_inserter(found),
                 [&](const PlumbBodyPair& pair) { return is_one(pair.body_a) || is_one(pair.body_b); });
    return found;
  }

  /// What the list will be after changes, as changes() gives them.
  [[nodiscard]] Pairs after(const Pairs& changed, bool touch) const {
    if (touch) return difference(list_, changed);
    Pairs all;
    std::merge(list_.begin(), list_.end(), changed.begin(), changed.end(), std::back_inserter(all), before);
    return all;
  }
  void become(Pairs list) noexcept { list_.swap(list); }

  [[nodiscard]] static Pairs difference(const Pairs& all, const Pairs& without) {
    Pairs left;
    std::set_difference(all.begin(), all.end(), without.begin(), without.end(), std::back_inserter(left), before);
    return left;
  }

 private:
  Pairs list_;
};

}  // namespace plumb::backend
