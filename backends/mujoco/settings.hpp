// MuJoCo's knobs. Every default is MuJoCo's own, but for the cone of worlds with rolling friction; the sub-steps come
// near to its time step of 2 ms at 60 Hz.
#pragma once

#include <mujoco/mujoco.h>

#include "plumb/backend/settings_table.hpp"

namespace plumb::mujoco {

struct Settings {
  int substeps, solver, iterations, noslip_iterations, cone;
  double tolerance, impratio;
  double contact_time, contact_damping, joint_time, joint_damping;
  double impedance_least, impedance_most, impedance_width;
  int bounce_substeps;
  bool warm_starting, multiccd;
};

[[nodiscard]] const backend::SettingsTable<Settings>& settings_table();

/// To a model's options, and to all of its constraints but contacts. Runs at any time. rolls: the world has rolling
/// friction.
void apply_to_model(const Settings& settings, bool rolls, mjModel& model);
void put_impedance(const Settings& settings, mjtNum* solimp);

}  // namespace plumb::mujoco
