// What the broad phase finds: pairs of proxies whose boxes overlap. A proxy is one shape of one body; it is a mover or
// a static.
#pragma once

#include <cstdint>

#include "math/real.hpp"

namespace plumb::impulse {

/// Two movers with a < b, or the mover a and the static b.
struct Pair {
  std::uint32_t a, b;
};
PLUMB_HD constexpr bool is_same(const Pair& p, const Pair& q) { return p.a == q.a && p.b == q.b; }

/// The pairs that the traversal of one mover found. The mover is a or b of each; every pair has one finder.
struct PairRange {
  std::uint32_t first, count;
};

/// Some proxies, by their rows.
struct ProxyRows {
  const std::uint32_t* rows;
  std::uint32_t count;
  PLUMB_HD std::uint32_t operator[](std::uint32_t i) const { return rows[i]; }
  bool operator==(const ProxyRows&) const = default;
};

/// Where the pairs that are found go.
struct PairList {
  Pair* pairs;
  PairRange* ranges;     ///< by proxy: of every mover the pairs that it found, as far as they were written
  std::uint32_t* count;  ///< how many there are, even if that is more than fit; 2^32 - 1 is that or more
};

}  // namespace plumb::impulse
