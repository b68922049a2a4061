// What the broad phase finds: pairs of proxies whose boxes overlap. A proxy is one shape of one body; it is a mover or
// a static.
#pragma once

#include <cstdint>

namespace plumb::impulse {

/// Two movers with a < b, or the mover a and the static b.
struct Pair {
  std::uint32_t a, b;
};

/// The pairs that the traversal of one mover found. The mover is a or b of each; every pair has one finder.
struct PairRange {
  std::uint32_t first, count;
};

}  // namespace plumb::impulse
