// What stands and for how long: watches over stacks, and over whatever else is to keep its place.
#pragma once

#include <cstddef>
#include <span>

#include "measure/instruments/referee_view.hpp"
#include "measure/measure.hpp"

namespace plumb::harness {

constexpr double box_side = 1;  ///< m, of the boxes in scenes of towers, pyramids, crowds and mirrored piles

/// Whether the simulation is in the last second of its run, over which forces are averaged.
[[nodiscard]] bool in_last_second(Simulation& simulation);

/// How far a body is from where it started, m. NaN when its pose is.
[[nodiscard]] double distance_from_start(const Scene& scene, std::span<const PoseRow> poses, std::size_t body);

/// Angle of a body's y axis from the vertical, rad.
[[nodiscard]] double tilt_of(const PoseRow& pose);

/// The time (s) for which a condition held without a break from the start.
class Survival {
 public:
  void add(double time, bool holds) {
    broken_ = broken_ || !holds;
    if (!broken_) time_ = time;
  }
  [[nodiscard]] bool whole() const { return !broken_; }
  [[nodiscard]] double time() const { return time_; }

 private:
  bool broken_ = false;
  double time_ = 0;
};
/// Metrics "stands" (expected) and "survival" (s, error the share of the run that is missing).
void add_survival(MeasureContext& context, const Survival& survival, double seconds);

/// Metric "ground_force": the mean force of the ground over the account's time, relative to the weight of all bodies.
void add_ground_force(MeasureContext& context, const ImpulseAccount& account, double total_mass);

}  // namespace plumb::harness
