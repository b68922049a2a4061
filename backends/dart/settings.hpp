// DART's knobs. Defaults are DART's own but for those of our own rows, and for two: its time step of 1 ms would be 16
// sub-steps at 60 Hz, and its speed of 1 mm/s would leave bodies in each other that begin so.
#pragma once

#include "plumb/backend/settings_table.hpp"

namespace plumb::dart6 {

struct Settings {
  int substeps, solver, iterations, friction_directions;
  double contact_reduction, contact_reduction_speed, contact_allowance, bounce_speed;
  double joint_reduction, joint_reduction_speed;
};

/// Values of Settings::solver.
enum Solver { kDantzig = 0, kGaussSeidel = 1 };

/// Values of Settings::friction_directions.
enum FrictionDirections { kOfNormal = 0, kOfSliding = 1 };

[[nodiscard]] const backend::SettingsTable<Settings>& settings_table();

}  // namespace plumb::dart6
