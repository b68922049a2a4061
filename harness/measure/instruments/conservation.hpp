// How a scene's mechanical energy and momentum keep over a run (metrics of any scene that steps).
#pragma once

#include <cstdint>
#include <vector>

#include "measure/measure.hpp"
#include "referee/mass.hpp"
#include "referee/mechanics.hpp"

namespace plumb::harness {

class Conservation {
 public:
  /// masses: of all bodies of the scene.
  explicit Conservation(std::vector<referee::Mass> masses) : masses_(std::move(masses)) {}
  /// Of the state that the simulation is in.
  void add(Simulation& simulation);
  /// energy_injected, energy_drift and momentum_drift, as far as they account for the engine in this scene; stride: of
  /// the steps that were sampled.
  void add_to(std::vector<Metric>& metrics, const Scene& scene, std::uint64_t stride) const;

 private:
  std::vector<referee::Mass> masses_;
  referee::EnergyAccount energy_;
  double kinetic_max_ = 0, potential_low_ = 0, potential_high_ = 0;
  referee::Vec3 momentum_start_ = referee::Vec3::Zero();
  double momentum_sum_ = 0, momentum_drift_ = 0;
  bool started_ = false;
};

}  // namespace plumb::harness
