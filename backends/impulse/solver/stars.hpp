// Many heavy bodies on a light one: in the graph of contacts a star, with the light one as its hub.
//
// No spoke asks for sub-steps where none is much heavier than the hub; but all together are to what the hub lies on as
// one heavy body, of whose motion a pass over the contacts stops no more than the share w = m / (m + sum M). Later
// passes stop what is left, and impulses are kept: an integrator, so that the bodies swing on the hub as on a spring of
// the frequency sqrt(w) in a sub-step, which nothing damps. They come to rest where a sub-step has a relaxing pass for
// each six times the hub's mass on it, or more (measured, at 8 sub-steps). Islands with a star have so many.
#pragma once

#include "exec/atomic.hpp"

namespace plumb::impulse {

/// A spoke has at least that share of the hub's mass, and presses on it along gravity within so much: the cosine of an
/// angle.
constexpr Real kLeastSpoke = Real(0.25), kSpokeUpright = Real(0.5);
/// A star has so many spokes, of so many times the hub's mass: boxes on a plate on the ground were seen to swing from
/// 24 times on, crates on a cart, which rolls, from 12 on. Less is a body in a heap of its like. Of so many it is a
/// large one.
constexpr std::uint32_t kLeastSpokes = 3, kLeastStar = 10, kLargeStar = 24;

/// What presses on a body. A sum of whole numbers, which does not depend on the order.
struct Star {
  std::uint32_t sum;

  /// A spoke that is so many times as heavy as the hub. Whether this is a star now: of those who add one is told.
  PLUMB_HD bool add(Real ratio) {
    const auto mass = static_cast<std::uint32_t>(min(ratio, kMostRatio) * Real(kUnit));
    const std::uint32_t spoke = mass * kMostSpokes + 1;
    return Star{atomic_add(&sum, spoke) + spoke}.size() != 0;
  }
  /// 0: it is none; 1: a small one; 2: a large one.
  [[nodiscard]] PLUMB_HD std::uint32_t size() const {
    const std::uint32_t mass = sum / kMostSpokes;
    if (sum % kMostSpokes < kLeastSpokes || mass < kLeastStar * kUnit) return 0;
    return mass < kLargeStar * kUnit ? 1 : 2;
  }

 private:
  static constexpr std::uint32_t kMostSpokes = 1024, kUnit = 16;
  static constexpr Real kMostRatio = 250;  // so many spokes of that do not overflow
};

}  // namespace plumb::impulse
