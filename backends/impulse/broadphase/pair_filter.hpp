// Which overlapping boxes are worth a look: not of the same body, allowed to touch, and not joined.
#pragma once

#include <cstdint>

#include "math/real.hpp"

namespace plumb::impulse {

/// Two proxies that both have this flag never make a pair: bodies that no contact moves.
constexpr std::uint32_t kProxyImmovable = 1U << 0;
/// A proxy that no step and no query sees.
constexpr std::uint32_t kProxyUnseen = 1U << 1;

/// What a proxy may touch; category, mask and group as in PlumbFilter.
struct alignas(16) ProxyFilter {
  std::uint32_t body;
  std::uint32_t category, mask;
  std::int32_t group;
  std::uint32_t flags;
};

/// Key of two bodies in the list of excluded ones.
PLUMB_HD constexpr std::uint64_t body_pair_key(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint64_t>(min(a, b)) << 32 | max(a, b);
}

struct PairFilter {
  const ProxyFilter* proxies;     ///< by proxy
  const std::uint64_t* excluded;  ///< body_pair_key of bodies that a joint keeps from colliding, ascending
  std::uint32_t excluded_count;
  bool operator==(const PairFilter&) const = default;

  PLUMB_HD bool operator()(std::uint32_t a, std::uint32_t b) const { return (*this)(proxies[a], proxies[b]); }
  PLUMB_HD bool operator()(const ProxyFilter& a, const ProxyFilter& b) const {
    if (a.body == b.body || (a.flags & b.flags & kProxyImmovable) != 0 || !may_touch(a, b)) return false;
    return excluded_count == 0 || !is_excluded(body_pair_key(a.body, b.body));
  }
  /// The rule of PlumbFilter (plumb::may_touch, which device code cannot call).
  PLUMB_HD static bool may_touch(const ProxyFilter& a, const ProxyFilter& b) {
    if (a.group == b.group && a.group != 0) return a.group > 0;
    return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
  }

 private:
  PLUMB_HD bool is_excluded(std::uint64_t key) const {
    std::uint32_t first = 0, last = excluded_count;
    while (first < last) {
      const std::uint32_t middle = first + (last - first) / 2;
      if (excluded[middle] < key)
        first = middle + 1;
      else
        last = middle;
    }
    return first < excluded_count && excluded[first] == key;
  }
};

}  // namespace plumb::impulse
