// Where two recordings of one scene part: the first moment at which a body is visibly elsewhere.
#pragma once

#include <optional>
#include <string>

#include "record/trajectory.hpp"

namespace plumb::harness {

/// Of a body's radius: so far a point of it must be from where the other engine has it. Seen, and not yet grown into
/// something else.
inline constexpr double visible_part_of_body = 0.1;
/// Likewise of the way that a body without a shape goes.
inline constexpr double visible_part_of_way = 0.01;

struct Parting {
  double seconds;   ///< of the scene
  double distance;  ///< m, between where the two have a point of the body, at most; infinite for a lost body
  std::string body;
  bool visible;  ///< false: they never part so far, and this is where they are farthest apart
};

/// Over the frames that both have. A body counts by the shift of its origin and what its other orientation moves at its
/// radius. None where the recordings have no frame in common or are not of the same bodies and step.
[[nodiscard]] std::optional<Parting> parting_of(const Trajectory& a, const Trajectory& b);

}  // namespace plumb::harness
