// Objects by the slot of their handle.
#pragma once

#include <memory>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::ode {

/// Puts an object in its handle's slot.
template <class Object>
void put(std::vector<std::unique_ptr<Object>>& slots, std::uint64_t handle, std::unique_ptr<Object> object) {
  const std::uint32_t slot = slot_of(handle);
  if (slot >= slots.size()) slots.resize(slot + 1);
  slots[slot] = std::move(object);
}

}  // namespace plumb::ode
