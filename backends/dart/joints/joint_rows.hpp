// What holds a joint that is no link of a skeleton: rows between its two bodies.
#pragma once

#include "joints/joint.hpp"
#include "settings.hpp"
#include "solver/rows_constraint.hpp"

namespace plumb::dart6 {

/// The joint's frames are where the bodies are in DART now. h: s, of the sub-step.
[[nodiscard]] std::vector<Row> joint_rows(const Joint& joint, const Settings& settings, double h);

/// Motion along and about the world's axes that a body's locks, or NO_ROTATION, take away.
[[nodiscard]] std::vector<Row> lock_rows(const Body& body);

/// Where frame b, or frame a, is now.
[[nodiscard]] PlumbPose frame_in_world(const Body* body, const PlumbPose& frame);

}  // namespace plumb::dart6
