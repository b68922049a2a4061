// What the laws of motion and contact say of an engine's own impulses, sampled over a run (metrics without a closed
// form). For engines that tell impulses, in scenes that need them.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "measure/instruments/referee_view.hpp"
#include "measure/measure.hpp"
#include "referee/contacts.hpp"

namespace plumb::harness {

/// |lambda - P_K(lambda - rho u^)| / W: 0 exactly where velocity and impulse solve the frictional contact problem (De
/// Saxce & Feng 1998; the natural map of Acary & Cadoux 2013). rho: the effective mass at the contact, mean of the
/// three directions, which gives the velocity its units.
[[nodiscard]] double natural_map(const referee::ContactSample& sample, const referee::Scale& scale);

/// Worst residuals of one step, all relative to the weight of all in a step, its speed scale and 1 m.
struct LawResiduals {
  referee::ContactQuality quality;
  double natural_map = 0;
  double body_balance = 0;    ///< worst body; NaN where forces other than contacts act
  double world_balance = 0;   ///< momentum of all against gravity and what the ground gave; NaN likewise
  double ground_balance = 0;  ///< the ground's impulses against the weight: 0 for a scene at rest
};
/// before, after: states of all bodies, in one order; the samples point into `after`. balance: whether nothing but
/// gravity and these contacts acts.
[[nodiscard]] LawResiduals law_residuals(std::span<const referee::BodyState> before,
                                         std::span<const referee::BodyState> after,
                                         std::span<const referee::ContactSample> samples, const referee::Vec3& gravity,
                                         double dt, bool balance);

/// The worst of sampled steps. Call before_step with the state that the step starts from, then after_step.
class ContactLaws {
 public:
  /// Knows nothing, and costs nothing, in scenes without the need "contact_impulses" or with materials of compound
  /// children, whose friction is not the body's.
  explicit ContactLaws(Simulation& simulation);

  [[nodiscard]] bool judges() const { return judges_; }
  void before_step(Simulation& simulation);
  void after_step(Simulation& simulation);
  /// cone_violation_max, cone_distance_max, signorini_speed_max, signorini_gap_max, pull_max, dissipation_defect,
  /// creep_max, complementarity_max, natural_map_max, body_balance_max, world_balance_max, ground_balance_end.
  void add_to(std::vector<Metric>& metrics) const;
  [[nodiscard]] static std::vector<MetricSpec> specs();

 private:
  bool judges_ = false, balance_ = false, known_ = false;
  std::vector<referee::Mass> masses_;
  std::unordered_map<PlumbBody, std::size_t> index_;
  std::vector<referee::BodyState> before_;
  LawResiduals worst_;
  double defect_sum_ = 0;
  std::uint64_t defect_steps_ = 0;
};

}  // namespace plumb::harness
