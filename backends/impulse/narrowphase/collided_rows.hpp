// What collision found of a candidate and how the bodies lay then, for as long as it is recycled
// (contact_recycling.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "math/quat.hpp"
#include "math/wide.hpp"
#include "narrowphase/manifold.hpp"

namespace plumb::impulse {

struct alignas(16) CollidedManifold {
  Manifold manifold;  ///< without points and gap: none that may be recycled
  Real margin;        ///< how far ahead the two looked, m
  Quat orientation_a, orientation_b;
  Position apart;  ///< from body a to body b, m
};

/// Rows of these. They are copied whole from step to step: on a device 16 bytes at a time, and the same 16 of
/// neighbouring rows beside each other, so that a warp moves 512 that follow each other.
struct CollidedRows {
  struct alignas(16) Line {
    std::uint32_t words[4];
  };
  static constexpr std::uint32_t kLines = sizeof(CollidedManifold) / sizeof(Line), kBlock = kLanes == 1 ? 32 : 1;
  Line* lines;

  static constexpr std::size_t lines_for(std::size_t rows) { return (rows + kBlock - 1) / kBlock * kBlock * kLines; }

  [[nodiscard]] PLUMB_HD CollidedManifold load(std::uint32_t row) const {
    Line copied[kLines];
    PLUMB_UNROLL
    for (std::uint32_t k = 0; k < kLines; ++k) copied[k] = line(row, k);
    CollidedManifold collided;
    std::memcpy(&collided, copied, sizeof collided);
    return collided;
  }
  PLUMB_HD void store(std::uint32_t row, const CollidedManifold& collided) const {
    Line copied[kLines];
    std::memcpy(copied, &collided, sizeof collided);
    PLUMB_UNROLL
    for (std::uint32_t k = 0; k < kLines; ++k) line(row, k) = copied[k];
  }
  /// Nothing of it may be recycled.
  PLUMB_HD void clear(std::uint32_t row) const { line(row, 0) = {}; }
  [[nodiscard]] PLUMB_HD bool is_recyclable(std::uint32_t row) const {
    const Line& first = line(row, 0);
    Real gap;
    static_assert(offsetof(Manifold, count) == 0 && offsetof(Manifold, gap) == sizeof gap);
    std::memcpy(&gap, reinterpret_cast<const char*>(&first) + sizeof gap, sizeof gap);
    return first.words[0] != 0 || gap > 0;
  }

 private:
  [[nodiscard]] PLUMB_HD Line& line(std::uint32_t row, std::uint32_t k) const {
    return lines[(std::size_t{row / kBlock} * kLines + k) * kBlock + row % kBlock];
  }
};
static_assert(offsetof(CollidedManifold, manifold) == 0 && sizeof(CollidedManifold) % sizeof(CollidedRows::Line) == 0);

}  // namespace plumb::impulse
