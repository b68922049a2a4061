// A broad phase with everything around it, asked from the host.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "broadphase/broad_phase.hpp"

namespace plumb::impulse {

inline bool operator<(const Pair& x, const Pair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; }
inline bool operator==(const Pair& x, const Pair& y) { return x.a == y.a && x.b == y.b; }

inline std::vector<Pair> sorted(std::vector<Pair> pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

struct BroadPhaseRig {
  explicit BroadPhaseRig(std::uint32_t threads = 1) : executor(nullptr, threads) {}

  /// Proxies 0 .. n-1 are the boxes; those from first_static on are statics. Every proxy is a body of its own that
  /// touches all, unless `filters` says otherwise.
  void set(const std::vector<Box>& all, std::uint32_t first_static) {
    const auto n = static_cast<std::uint32_t>(all.size());
    mover_count = first_static;
    static_count = n - first_static;
    boxes.from_host(all.data(), n);
    std::vector<std::uint32_t> proxies(n);
    std::iota(proxies.begin(), proxies.end(), 0U);
    movers.from_host(proxies.data(), first_static);
    statics.from_host(proxies.data() + first_static, static_count);
    filters.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) filters[i] = {i, 1, ~0U, 0, 0};
    ranges.grow(n);
    count.grow(1);
  }

  std::vector<Pair> find(std::uint32_t room) {
    device_filters.from_host(filters.data(), filters.size());
    device_excluded.from_host(excluded.data(), excluded.size());
    broad_phase.reserve(executor, mover_count, static_count, room);
    pairs.grow(room);
    broad_phase.build_statics(executor, boxes.data(), statics.data(), static_count);
    enqueue();
    executor.wait();
    found = count.to_host(1)[0];
    return pairs.to_host(std::min(found, room));
  }
  void enqueue() {
    const PairFilter filter{device_filters.data(), device_excluded.data(), static_cast<std::uint32_t>(excluded.size())};
    broad_phase.find_pairs(executor, boxes.data(), {movers.data(), mover_count}, filter,
                           {pairs.data(), ranges.data(), count.data()});
  }

  Executor executor;
  BroadPhase broad_phase;
  std::vector<ProxyFilter> filters;
  std::vector<std::uint64_t> excluded;
  Buffer<Box> boxes;
  Buffer<std::uint32_t> movers, statics, count;
  Buffer<ProxyFilter> device_filters;
  Buffer<std::uint64_t> device_excluded;
  Buffer<Pair> pairs;
  Buffer<PairRange> ranges;
  std::uint32_t mover_count = 0, static_count = 0, found = 0;
};

}  // namespace plumb::impulse
