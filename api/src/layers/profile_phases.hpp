// Phases of a step as zones within it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "plumb/profile.hpp"

namespace plumb::layers {

inline constexpr std::array<const char*, PLUMB_PHASE_COUNT> phase_names = {
    "broad", "narrow", "islands", "solve", "integrate", "continuous", "output", "phase 7"};

[[nodiscard]] inline bool is_told(double phase_seconds) { return std::isfinite(phase_seconds) && phase_seconds >= 0; }

/// See ProfiledStep.
inline void lay_out_phases(ProfiledStep& step) {
  double told = 0;
  for (const double seconds : step.report.phase_seconds) told += is_told(seconds) ? seconds : 0;
  const double room = 1e-9 * static_cast<double>(step.zone.duration);
  const double ns = told > room ? 1e9 * room / told : 1e9;
  double gone = 0;
  for (std::size_t phase = 0; phase < step.phases.size(); ++phase) {
    const double seconds = step.report.phase_seconds[phase];
    ProfileZone& zone = step.phases[phase] = step.zone;
    zone.name = is_told(seconds) ? phase_names[phase] : nullptr;
    // From the sum, so that roundings do not add up to more than the step.
    const auto begin = static_cast<std::int64_t>(gone * ns);
    if (is_told(seconds)) gone += seconds;
    zone.start += begin;
    zone.duration = std::min(static_cast<std::int64_t>(gone * ns), step.zone.duration) - begin;
  }
}

}  // namespace plumb::layers
