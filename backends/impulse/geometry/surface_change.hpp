// What becomes of a mesh or height field that is changed in place, and where.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "geometry/shape.hpp"
#include "math/box.hpp"
#include "plumb/types.h"

namespace plumb::impulse {

/// A surface in its pool: its row among those of its kind, and what its Shape tells.
struct AddedSurface {
  std::uint32_t row;
  PlumbVec3 centre;  ///< of its box in the frame of the description; the origin of the Shape's frame
  Vec half;
  Real reach;
};

/// The Shape's own frame has its origin in the middle of the surface's box.
inline Shape surface_shape(ShapeType type, const AddedSurface& added) {
  return {type, added.row, added.half, added.reach};
}

/// A box in the frame of a description, m; at first empty.
struct Extent {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  PlumbVec3 low = {kFar, kFar, kFar}, high = {-kFar, -kFar, -kFar};

  void add(const PlumbVec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  [[nodiscard]] bool is_empty() const { return low.x > high.x; }
  /// All of a surface.
  void add(const AddedSurface& surface) {
    const auto& [x, y, z] = surface.half;
    for (const double side : {-1.0, 1.0})
      add(PlumbVec3{surface.centre.x + side * static_cast<double>(x), surface.centre.y + side * static_cast<double>(y),
                    surface.centre.z + side * static_cast<double>(z)});
  }
  /// Whether a ball reaches into it.
  [[nodiscard]] bool meets(const PlumbVec3& centre, double radius) const {
    const auto beyond = [](double x, double least, double most) { return std::max({least - x, x - most, 0.0}); };
    const double x = beyond(centre.x, low.x, high.x), y = beyond(centre.y, low.y, high.y),
                 z = beyond(centre.z, low.z, high.z);
    return x * x + y * y + z * z <= radius * radius;
  }
};

struct ChangedSurface {
  AddedSurface now;
  Extent where;         ///< all that was, or is, another; empty: nothing is
  bool frame_is_other;  ///< the origin of the Shape's frame is elsewhere

  /// Where, in the Shape's frame; rounding makes it no smaller.
  [[nodiscard]] Box seen_from_middle() const {
    if (where.is_empty()) return empty_box();
    const auto away = [&](const PlumbVec3& p) {
      return Vec{static_cast<Real>(p.x - now.centre.x), static_cast<Real>(p.y - now.centre.y),
                 static_cast<Real>(p.z - now.centre.z)};
    };
    const Real more = 8 * kEpsilon * (now.reach + length(away(where.low)) + length(away(where.high)));
    return {away(where.low) - Vec{more, more, more}, away(where.high) + Vec{more, more, more}};
  }
};

}  // namespace plumb::impulse
