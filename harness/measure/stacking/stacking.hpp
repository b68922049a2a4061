// Measures of the stacking group: their list, and what those that live in files of their own share.
#pragma once

#include <span>

#include "measure/measure.hpp"

namespace plumb::harness {

/// The list of the group.
[[nodiscard]] std::span<const MeasureEntry> stacking_measures();

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

}  // namespace plumb::harness
