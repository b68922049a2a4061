// All overlaps of a world at once, and their statistics (metric 1 of the catalogue).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "referee/penetration.hpp"

namespace plumb::referee {

struct PosedShape {
  const Shape* shape = nullptr;  ///< may be null: touches nothing
  Pose pose;
  bool moves = true;  ///< false for static bodies: two of them are not a pair
};

struct Overlap {
  std::uint32_t a, b;  ///< indices, a < b
  Penetration penetration;
};

struct WorldPenetration {
  std::vector<Overlap> overlaps;              ///< depth > 0, sorted by a, then b
  double p50 = 0, p95 = 0, p99 = 0, max = 0;  ///< of the depths of all overlaps, m (nearest rank); 0 when there is none
  double sum_of_squares = 0;                  ///< m2
};

/// Whether a pair counts: filters, and pairs that a joint keeps from touching, are the caller's to know.
using MayTouch = std::function<bool(std::uint32_t a, std::uint32_t b)>;

/// Pairs that may overlap by their bounds, each once, sorted: sort and sweep along the axis of the widest spread.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> bounding_pairs(std::span<const PosedShape> shapes);

/// may_touch empty: every pair counts. Shapes with a pose that is not finite are left out.
[[nodiscard]] WorldPenetration world_penetration(std::span<const PosedShape> shapes, const MayTouch& may_touch = {});

}  // namespace plumb::referee
