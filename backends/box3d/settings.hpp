// Box3D's knobs. Every default is Box3D's own.
#pragma once

#include <box3d/box3d.h>

#include "plumb/backend/settings_table.hpp"

namespace plumb::box3d {

struct Settings {
  int substeps;
  double contact_hertz, contact_damping_ratio, contact_speed;
  double joint_hertz, joint_damping_ratio;
  double restitution_threshold, max_linear_speed, recycle_distance;
  bool continuous, speculative, warm_starting, fast_rotation;
  int cylinder_sides;
  double sleep_threshold;
};

[[nodiscard]] const backend::SettingsTable<Settings>& settings_table();

/// Those that Box3D takes at any time.
void apply_to_world(const Settings& settings, b3WorldId world);

}  // namespace plumb::box3d
