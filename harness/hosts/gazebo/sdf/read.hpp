// What SDF says, as records of this host: shapes with their surfaces, inertia, poses and axes.
#pragma once

#include <optional>
#include <sdf/Collision.hh>
#include <sdf/Joint.hh>
#include <sdf/Link.hh>
#include <sdf/SemanticPose.hh>

#include "hosts/gazebo/world/entities.hpp"

namespace plumb::gazebo {

/// Relative to what it lies in; the raw pose where a host has taken the object out of its file.
[[nodiscard]] Placement pose_of(const sdf::SemanticPose& pose);

/// Nothing, with a sentence on the console, for what Plumb has not.
[[nodiscard]] std::optional<Geometry> read_geometry(const sdf::Collision& collision);

struct Surface {
  double friction = 1;
  double restitution = 0;
  std::uint16_t mask = kTouchesAll;
};
[[nodiscard]] Surface surface_of(const sdf::Collision& collision);

/// "" for a mass that moves; else what is wrong with it.
[[nodiscard]] std::string fault_of(const ignition::math::Inertiald& inertial);
[[nodiscard]] bool gravity_of(const sdf::Link& link);

/// Kind, axes and their limits, and frame on the child; not whom it joins. Nothing, with a sentence on the console, for
/// a type that Plumb has not. model: how the model's frame lies in the child's.
[[nodiscard]] std::optional<Joint> read_joint(const sdf::Joint& joint, const Rotation& model_in_child);

}  // namespace plumb::gazebo
