// Measures of the joints group: their list, and those that live in files of their own, and what they share.
#pragma once

#include <span>
#include <vector>

#include "measure/instruments/referee_view.hpp"
#include "measure/measure.hpp"

namespace plumb::harness {

/// The list of the group.
[[nodiscard]] std::span<const MeasureEntry> joint_measures();

// joints_nets.cpp
void measure_net(MeasureContext& context);

// joints_chains.cpp
void measure_heavy_chain(MeasureContext& context);
void measure_chain_mode(MeasureContext& context);
void measure_catenary(MeasureContext& context);

// joints_linkages.cpp
void measure_slider(MeasureContext& context);
void measure_parallelogram(MeasureContext& context);

// joints_driven.cpp
void measure_motor(MeasureContext& context);
void measure_limit_stop(MeasureContext& context);

// joints_single.cpp
void measure_toppling(MeasureContext& context);
void measure_spring(MeasureContext& context);
void measure_cantilever(MeasureContext& context);
void measure_four_bar(MeasureContext& context);
void measure_universal(MeasureContext& context);
void measure_free_figure(MeasureContext& context);

/// Places rods end to end from `start`, rod i turned by angles[i] about z, along its own axis `along` (body frame), at
/// rest. The joints' frames are theirs, so they fit when the rods are joined at their ends.
void place_rods(Scene& scene, const std::vector<std::size_t>& rods, double length, const referee::Vec3& start,
                const referee::Vec3& along, const std::vector<double>& angles);

/// Angle that a body has turned about z since the start, in -pi..pi.
[[nodiscard]] double turn_about_z(const Scene& scene, std::span<const PoseRow> poses, std::size_t body);

}  // namespace plumb::harness
