// Objects by the slot of their handle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "plumb/assert.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::ode {

/// Empty objects, made many at a time: they lie together in memory, and so do ODE's own objects, which would otherwise
/// be scattered between ours. Worth some percent of a step's time.
template <class Object>
class Stock {
 public:
  std::unique_ptr<Object> take() {
    if (stock_.empty()) refill();
    auto object = std::move(stock_.back());
    stock_.pop_back();
    return object;
  }

 private:
  void refill() {
    stock_.resize(batch_);
    for (auto object = stock_.rbegin(); object != stock_.rend(); ++object) *object = std::make_unique<Object>();
    batch_ = std::min<std::size_t>(2 * batch_, 1024);
  }
  std::vector<std::unique_ptr<Object>> stock_;
  std::size_t batch_ = 16;
};

/// Puts an object in its handle's slot.
template <class Object>
void put(std::vector<std::unique_ptr<Object>>& slots, std::uint64_t handle, std::unique_ptr<Object> object) {
  const std::uint32_t slot = slot_of(handle);
  if (slot >= slots.size()) slots.resize(slot + 1);
  PLUMB_ASSERT(slots[slot] == nullptr);  // handles of the living differ in their slots
  slots[slot] = std::move(object);
}

/// The guard has refused handles of those who are gone.
template <class Object>
[[nodiscard]] Object& living(const std::vector<std::unique_ptr<Object>>& slots, std::uint64_t handle) {
  PLUMB_ASSERT(slot_of(handle) < slots.size());
  PLUMB_ASSERT(slots[slot_of(handle)] != nullptr && slots[slot_of(handle)]->handle == handle);
  return *slots[slot_of(handle)];
}

}  // namespace plumb::ode
