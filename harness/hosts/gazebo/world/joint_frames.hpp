// Where a joint's axes are, and its coordinates and rates by the motion of its links: the same for every engine.
#pragma once

#include "hosts/gazebo/world/entities.hpp"

namespace plumb::gazebo {

/// Plumb's frames a and b in the world.
[[nodiscard]] Placement frame_on_parent(const Joint& joint);
[[nodiscard]] Placement frame_on_child(const Joint& joint);

/// Unit, world axes.
[[nodiscard]] Vector axis_of(const Joint& joint, std::size_t axis);
/// Of Plumb's six.
[[nodiscard]] std::size_t plumb_axis(const Joint& joint, std::size_t axis);

/// Angles in -pi..pi; of a ball the rotation vector.
[[nodiscard]] double coordinate_of(const Joint& joint, std::size_t axis);
[[nodiscard]] double rate_of(const Joint& joint, std::size_t axis);

/// Equal and opposite on its two links: N along a slider's axis, N m about another's.
void push(Joint& joint, std::size_t axis, double force);

/// How hard it is to move the two along an axis, each by its own inertia alone: kg or kg m2.
[[nodiscard]] double inertia_along(const Joint& joint, std::size_t axis);

}  // namespace plumb::gazebo
