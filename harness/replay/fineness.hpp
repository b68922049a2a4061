// How finely a replay keeps positions: finer than a picture of it shows.
#pragma once

#include <vector>

#include "record/trajectory.hpp"

namespace plumb::harness {

/// m: 1/512 of the radius of the small among the bodies that move, so that none is seen to tremble from nearby, and at
/// most 1/8192 of the radius of what happens, of which one in twenty-five bodies at either end may fly off.
[[nodiscard]] double step_of_positions(const Trajectory& trajectory);

/// m: of each body that moves, about its origin; 0 for one without a shape.
[[nodiscard]] std::vector<double> radii_of_moving(const Trajectory& trajectory);

/// m: of a small one among the bodies that move, 0 where none has a shape.
[[nodiscard]] double radius_of_small_bodies(const Trajectory& trajectory);

}  // namespace plumb::harness
