// Jolt's knobs. Every default is Jolt's own, but those of the greatest speeds.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/PhysicsSettings.h>

#include "plumb/backend/settings_table.hpp"

namespace plumb::jolt {

struct Settings {
  int velocity_steps, position_steps, collision_steps;
  double baumgarte, penetration_slop, speculative_distance, max_penetration_distance, manifold_tolerance;
  double restitution_threshold, max_linear_speed, max_angular_speed, convex_radius;
  struct Cast {
    double threshold, max_penetration;
  } cast;
  struct Recycling {
    double distance, angle;
    bool on;
  } recycling;
  struct Sleep {
    double threshold, time;
  } sleep;
  bool warm_starting, manifold_reduction, internal_edge_removal, split_islands;
};

[[nodiscard]] const backend::SettingsTable<Settings>& settings_table();

/// Those that Jolt takes at any time; may_sleep: whether the world needs sleeping.
[[nodiscard]] JPH::PhysicsSettings physics_settings(const Settings& settings, bool may_sleep);

}  // namespace plumb::jolt
