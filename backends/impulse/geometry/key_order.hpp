// Rows of the host put in order where kernels run, before a step.
#pragma once

#include <numeric>
#include <vector>

#include "exec/sort.hpp"

namespace plumb::impulse {

/// The indices of the keys, by key; of equal ones the first comes first.
inline std::vector<std::uint32_t> order_by_key(Executor& executor, const std::vector<std::uint64_t>& keys) {
  const auto count = static_cast<std::uint32_t>(keys.size());
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  Buffer<std::uint64_t> device_keys, sorted_keys(count);
  Buffer<std::uint32_t> device_order, sorted_order(count);
  device_keys.from_host(keys.data(), count);
  device_order.from_host(order.data(), count);
  RadixSort<std::uint64_t> sort;
  sort.reserve(count);
  sort.run(executor, count, device_keys.data(), device_order.data(), sorted_keys.data(), sorted_order.data(), 64);
  executor.wait();
  return sorted_order.to_host(count);
}

}  // namespace plumb::impulse
