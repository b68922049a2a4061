// The knobs of the engine, and what is set.
#pragma once

#include <span>

#include "broadphase/broad_phase.hpp"
#include "plumb/plumb.h"
#include "step_parameters.hpp"

namespace plumb::impulse {

/// A choice is the number of its word.
struct Settings {
  double solver = 0;
  double broad_phase = 0;
  double relaxation = 0;
  double substeps = 0;
  double iterations = 0;
  double stop_below = 0;
  double bias = 0;
  double slop = 0;
  double contact_hertz = 0;
  double contact_damping_ratio = 0;
  double joint_hertz = 0;
  double joint_damping_ratio = 0;
  double push_speed = 0;
  double restitution_speed = 0;
  double warm_starting = 0;
  double sleep_speed = 0;
  double sleep_time = 0;

  [[nodiscard]] PlumbSettingValue get(const char* name) const;
  void set(const char* name, const PlumbSettingValue& value);

  [[nodiscard]] BroadPhase::Method broad_phase_method() const {
    return static_cast<BroadPhase::Method>(static_cast<std::uint32_t>(broad_phase));
  }
  /// Length of the parts that a step of dt is solved in.
  [[nodiscard]] double substep(double dt) const;
  /// What a step of dt works with. last_h: the sub-step before, 0 when there was none.
  [[nodiscard]] StepParameters parameters(double dt, double last_h, const PlumbVec3& gravity) const;
};

std::span<const PlumbSettingInfo> setting_infos();

}  // namespace plumb::impulse
