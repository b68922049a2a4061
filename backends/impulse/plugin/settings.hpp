// The knobs of the engine, and what is set.
#pragma once

#include "bodies/step_parameters.hpp"
#include "broadphase/broad_phase.hpp"
#include "plumb/backend/settings_table.hpp"

namespace plumb::impulse {

struct Settings {
  SolverKind solver{};
  BroadPhase::Method broad_phase{};
  bool relaxes_once = false;
  bool joints_one_by_one = false;
  std::uint32_t substeps = 0, most_substeps = 0;
  std::uint32_t iterations = 0;
  double stop_below = 0;
  double bias = 0;
  double slop = 0;
  double contact_hertz = 0;
  double contact_damping_ratio = 0;
  double joint_hertz = 0;
  double joint_damping_ratio = 0;
  double push_speed = 0;
  double restitution_speed = 0;
  bool warm_starting = false;
  double sleep_speed = 0;
  double sleep_time = 0;

  /// Sub-steps of the first kind in a step of this length, s.
  [[nodiscard]] std::uint32_t substeps_in(double whole) const;
  /// Length of the parts that a step of dt is solved in, when it is solved in so many if in any.
  [[nodiscard]] double substep(double dt, std::uint32_t parts) const;
  /// In what parts a step of dt may be solved, those that are set first. last_h: the sub-step before, 0 when there was
  /// none. whole: the step of which dt is a part, or dt. Of its parts contacts are no stiffer than of itself: overlap
  /// from before would be a spring that is wound up by the change. Nor are errors of joints taken back faster than
  /// in its time: what is taut lifts what lies on it by many times the error.
  [[nodiscard]] SubstepLevels levels(double dt, double last_h, double whole) const;
  /// What it works with, in parts of the first kind unless its loads choose others.
  [[nodiscard]] StepParameters parameters(double dt, const PlumbVec3& gravity, const SubstepLevels& levels) const;

 private:
  [[nodiscard]] SubstepParameters of_substep(double dt, std::uint32_t parts, double last_h, double whole) const;
};

[[nodiscard]] const backend::SettingsTable<Settings>& settings_table();

}  // namespace plumb::impulse
