// How far an engine's step is from the exact one: small scenes, at a few sampled steps, outside the timing.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "measure/instruments/step_contacts.hpp"
#include "measure/measure.hpp"

namespace plumb::harness {

/// One step of an engine against the exact one by the referee's geometry. What is compared is unique also where the
/// contacts are more than the bodies need: velocities after the step, and the net impulse that each body gets. Both are
/// speeds in the norm of kinetic energy (RMS over all mass) relative to what a step of gravity gives. Shapes within
/// StepContacts::flat() count as touching, and need not part: how deep an engine lets bodies sink, or how far off it
/// holds them, is measured elsewhere.
struct StepErrors {
  enum class Verdict {
    scored,
    apart,    ///< nothing touches, or too much
    meeting,  ///< bodies meet anew: an engine may rightly meet them a step sooner or later
    unsolved  ///< by the reference
  };
  Verdict verdict = Verdict::apart;
  double velocity = 0;
  std::optional<double> force;  ///< where `told` is given
  double residual = 0;          ///< natural map of the exact solution itself
};
/// told: six numbers a body, the linear and angular impulse (about its centre of mass) of all its contacts.
[[nodiscard]] StepErrors step_errors(const StepContacts& contacts, double dt,
                                     std::span<const referee::BodyState> before,
                                     std::span<const referee::BodyState> after,
                                     const std::optional<Eigen::VectorXd>& told);

/// The errors of sampled steps. Call before_step with the state that the step starts from, then after_step.
class ReferenceScore {
 public:
  /// Knows nothing, and costs nothing, in scenes that are large or out of reach of StepContacts.
  explicit ReferenceScore(Simulation& simulation);
  ~ReferenceScore();

  void before_step(Simulation& simulation);
  void after_step(Simulation& simulation);
  /// reference_velocity_error and _max, reference_force_error (of engines that tell impulses, where the scene needs
  /// them), reference_residual.
  void add_to(std::vector<Metric>& metrics) const;
  [[nodiscard]] static std::vector<MetricSpec> specs();

 private:
  struct State;
  std::unique_ptr<State> state_;  ///< null where it does not judge
};

}  // namespace plumb::harness
