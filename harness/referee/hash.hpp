// The harness's own state hash: the same function as the backend side's, over the rows that the harness has read.
#pragma once

#include <cstdint>
#include <span>

#include "plumb/backend/state_hash.hpp"

namespace plumb::referee {

/// Bodies in order of creation, each 7 numbers of pose, then 6 of velocity. Equal to the world's own hash
/// (plumb.snapshot/1) when all live bodies are given. Rows are PODs of exactly 7 and 6 doubles.
template <class PoseRow, class VelocityRow>
[[nodiscard]] std::uint64_t state_hash(std::span<const PoseRow> poses, std::span<const VelocityRow> velocities) {
  static_assert(sizeof(PoseRow) == 7 * sizeof(double) && sizeof(VelocityRow) == 6 * sizeof(double));
  backend::StateHash hash;
  const auto* pose = reinterpret_cast<const double*>(poses.data());
  const auto* velocity = reinterpret_cast<const double*>(velocities.data());
  for (std::size_t body = 0; body < poses.size(); ++body) {
    for (std::size_t i = 0; i < 7; ++i) hash.add(pose[7 * body + i]);
    for (std::size_t i = 0; i < 6; ++i) hash.add(velocity[6 * body + i]);
  }
  return hash.value();
}

}  // namespace plumb::referee
