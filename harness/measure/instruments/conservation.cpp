#include "measure/instruments/conservation.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "simulation/scene_nature.hpp"

namespace plumb::harness {

void Conservation::add(Simulation& simulation) {
  const auto states = referee::body_states<PoseRow, VelocityRow>(masses_, simulation.poses(), simulation.velocities());
  const referee::Energy now = referee::energy(states, referee::vec(simulation.scene().gravity));
  energy_.add(now.total());
  kinetic_max_ = std::max(kinetic_max_, now.kinetic());
  potential_low_ = started_ ? std::min(potential_low_, now.potential) : now.potential;
  potential_high_ = started_ ? std::max(potential_high_, now.potential) : now.potential;
  const referee::Vec3 momentum = referee::linear_momentum(states);
  if (!started_) momentum_start_ = momentum;
  momentum_sum_ = std::max(momentum_sum_, referee::sum_of_momenta(states));
  momentum_drift_ = std::max(momentum_drift_, (momentum - momentum_start_).norm());
  started_ = true;
}

void Conservation::add_to(std::vector<Metric>& metrics, const Scene& scene, std::uint64_t stride) const {
  const SceneNature nature = nature_of(scene);
  const auto add = [&](const char* name, double value, const std::string& note) {
    metrics.push_back({name, value, 0.0, std::abs(value), std::nullopt, note});
  };
  const double reference = kinetic_max_ + (potential_high_ - potential_low_);
  const std::string every = stride == 1 ? "every step" : "every " + std::to_string(stride) + " steps";
  if (reference > 0 && !nature.driven && !nature.stores) {
    add("energy_injected", energy_.injected() / reference,
        "of the largest kinetic energy and potential range, sampled " + every);
    if (!nature.dissipates) add("energy_drift", energy_.drift() / reference, "of the same reference");
  }
  if (nature.closed && momentum_sum_ > 0)
    add("momentum_drift", momentum_drift_ / momentum_sum_, "largest, of the sum of all momenta");
}

}  // namespace plumb::harness
