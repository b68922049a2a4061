// Measures of the stacking group that live in files of their own, and what they share.
#pragma once

#include "measure/measure.hpp"
#include "measure/referee_view.hpp"

namespace plumb::harness {

constexpr double box_side = 1;  ///< m, of the boxes in scenes of towers, pyramids, crowds and mirrored piles

// stacking_towers.cpp
void measure_tower(MeasureContext& context);
void measure_pyramid(MeasureContext& context);
void measure_mass_ratio(MeasureContext& context);

/// Whether a tower of unit cubes, given from the ground up, stands: its top cube is no more than a tenth of the height
/// below its start. So a tower that leans or sinks a little stands, and one that has lost its top does not.
[[nodiscard]] bool tower_stands(const Scene& scene, std::span<const PoseRow> poses,
                                const std::vector<std::size_t>& boxes);
/// The stricter question: whether each cube is within half a side of its place as seen from the cube below (of the
/// lowest: from where it started).
[[nodiscard]] bool tower_is_intact(const Scene& scene, std::span<const PoseRow> poses,
                                   const std::vector<std::size_t>& boxes);

// stacking_balance.cpp
void measure_overhang(MeasureContext& context);
void measure_four_spheres(MeasureContext& context);

// stacking_masonry.cpp
void measure_voussoir_arch(MeasureContext& context);
void measure_catto_arch(MeasureContext& context);
void measure_cards(MeasureContext& context);
void measure_masonry(MeasureContext& context);

// stacking_loads.cpp
void measure_big_on_small(MeasureContext& context);
void measure_taken_load(MeasureContext& context);

// stacking_spheres.cpp
void measure_sphere_lattice(MeasureContext& context);

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
