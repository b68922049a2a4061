// Limit analysis by linear programming: the largest factor of a load under which contact forces inside the friction
// cones still balance everything (the static theorem; Livesley 1978, "Limit analysis of structures formed from rigid
// blocks"). The second way of limit_analysis.hpp: simplex (GLPK) instead of least squares, for blocks in space too,
// whose circular cones are bounded by pyramids from inside and outside.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "truth/limit_analysis.hpp"

namespace plumb::truth {

/// A force at a point of a block, multiplied by the load factor.
struct LiveLoad {
  int block;
  Eigen::Vector2d point;  ///< m
  Eigen::Vector2d force;  ///< N
};

/// The largest load factor (it may be below 0) with which the structure can carry its weights and the live loads; none
/// when there is none between -1e4 and 1e4 times what makes the loads as heavy as the structure. Infinity where even
/// the largest of these is carried.
[[nodiscard]] std::optional<double> largest_load(const PlaneStructure& structure, std::span<const LiveLoad> loads);

// --- in space ---

struct SpaceBlock {
  Eigen::Vector3d centre;  ///< of mass, m
  double weight;           ///< N, along -y
};
struct SpaceContact {
  int from, to;            ///< indices of blocks, or PlaneContact::ground
  Eigen::Vector3d point;   ///< m
  Eigen::Vector3d normal;  ///< unit, from `from` to `to`
  double friction;
};
struct SpaceStructure {
  std::vector<SpaceBlock> blocks;
  std::vector<SpaceContact> contacts;
};

enum class Pyramid {
  inside,  ///< what stands with these stands
  outside  ///< what falls with these falls
};
/// Whether forces inside pyramids of so many sides balance the weights.
[[nodiscard]] bool can_stand(const SpaceStructure& structure, Pyramid pyramid, int sides);

/// Three equal spheres that touch each other on the ground and one on top, all contacts with one friction.
[[nodiscard]] SpaceStructure four_spheres_structure(double friction);

}  // namespace plumb::truth
