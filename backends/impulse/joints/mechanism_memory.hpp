// Memory of the mechanisms that contacts move as a whole (bodies/mechanism.hpp).
#pragma once

#include <span>

#include "bodies/mechanism.hpp"
#include "exec/memory.hpp"
#include "joints/joint_system.hpp"

namespace plumb::impulse {

class MechanismMemory {
 public:
  void reserve_bodies(std::size_t bodies) { place_of_.grow(bodies); }
  /// Which mechanisms contacts move as a whole, and room for what that takes. pushed: the bodies of the system by
  /// place. bodies: how many rows of bodies there are.
  void put(std::span<const SystemMechanism> mechanisms, std::span<const std::uint32_t> pushed, std::size_t bodies);

  [[nodiscard]] Mechanisms view() {
    return {held_ == 0 ? nullptr : place_of_.data(), bodies_.data(), loads_.data(), mobility_.data(), held_};
  }
  /// For what finds the mobility to work with.
  [[nodiscard]] Real* scratch() { return scratch_.data(); }

 private:
  std::uint32_t held_ = 0;  // places, or 0 where contacts see all bodies alone
  Buffer<std::uint32_t> place_of_;
  Buffer<MechanismBody> bodies_;
  Buffer<ContactLoad> loads_;
  Buffer<Real> mobility_, scratch_;
};

}  // namespace plumb::impulse
