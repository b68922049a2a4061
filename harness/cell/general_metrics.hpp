// What the referee has to say of any scene that steps, whatever its measure looks at: metrics without a threshold
// unless the scene lists one.
#pragma once

#include <memory>
#include <vector>

#include "measure/measure.hpp"

namespace plumb::harness {

/// Follows one simulation. Energy and momentum are sampled after steps, at most a few hundred times; overlaps and joint
/// gaps at the start, a few times in between, and at the end. All outside the timing.
class GeneralMetrics {
 public:
  explicit GeneralMetrics(Simulation& simulation);
  ~GeneralMetrics();
  void stepped(Simulation& simulation);
  /// At the end: penetration_max, penetration_p50, _p95 and _p99, energy_drift, energy_injected, momentum_drift,
  /// joint_gap_max, _rms and _slope, joint_angle_max, joint_limit_max, solver_fallbacks, energy_bounded,
  /// steps_repeated, and those of ContactLaws and ReferenceScore, as far as they mean something in the scene.
  [[nodiscard]] std::vector<Metric> finish(Simulation& simulation);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Their names and units.
[[nodiscard]] std::vector<MetricSpec> general_metric_specs();

}  // namespace plumb::harness
