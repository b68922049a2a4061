// What rubs and bounces.
#pragma once

#include <cstdint>

#include "math/real.hpp"
#include "plumb/shapes.h"

namespace plumb::impulse {

/// Of a body's surface, of a part of it, or of two that touch.
struct Material {
  Real friction;     ///< Coulomb's
  Real restitution;  ///< Newton's
};

/// What the materials of two are together, as the interface has it.
PLUMB_HD inline Material combined(const Material& a, const Material& b) {
  return {sqrt(a.friction * b.friction), max(a.restitution, b.restitution)};
}

/// Materials of a mesh or height field by triangle.
struct TriangleMaterials {
  const Material* rows;
  const std::uint32_t* of;  ///< by triangle: its row, or PLUMB_BODY_MATERIAL; null: all are the body's

  [[nodiscard]] PLUMB_HD std::uint32_t row(std::uint32_t triangle) const {
    return of == nullptr ? PLUMB_BODY_MATERIAL : of[triangle];
  }
};

}  // namespace plumb::impulse
