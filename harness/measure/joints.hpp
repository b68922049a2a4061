// Measures of the joints group that live in files of their own, and what they share.
#pragma once

#include <vector>

#include "measure/measure.hpp"
#include "measure/referee_view.hpp"

namespace plumb::harness {

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

/// Mean force and torque that a joint puts on its body b, over the steps added. For engines that tell reactions.
class ReactionAccount {
 public:
  explicit ReactionAccount(std::size_t joint) : joint_(joint) {}
  void add(Simulation& simulation);
  [[nodiscard]] referee::Vec3 force() const { return force_ / count_; }
  [[nodiscard]] referee::Vec3 torque() const { return torque_ / count_; }

 private:
  std::size_t joint_;
  referee::Vec3 force_ = referee::Vec3::Zero(), torque_ = referee::Vec3::Zero();
  double count_ = 0;
};
/// Whether the backend tells reactions of this joint's type.
[[nodiscard]] bool tells_reaction(MeasureContext& context, std::size_t joint);

}  // namespace plumb::harness
