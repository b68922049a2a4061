// The joints of a recording: what they join and where, once; and in each frame which of them there are, and how far
// each is from what it allows, by the referee's float64 from the poses of its bodies alone.
#pragma once

#include "record/trajectory.hpp"

namespace plumb::harness {

/// [{"name","type","body_a" (null: the world),"body_b","frame_a":[7],"frame_b":[7]}], of a distance joint
/// "rest_length", and "spring": true where one holds the distance. Frames are in their bodies' frames: position,
/// orientation x y z w.
[[nodiscard]] Json joints_of(const Scene& scene);

class JointLayer {
 public:
  explicit JointLayer(const Simulation& simulation);
  /// A list: joint (its number in joints_of), gap (m: how far the anchors are from where the joint allows them, limits
  /// included; NaN where a spring alone holds them), angle (rad, likewise). What broke has no row from then on.
  [[nodiscard]] static LayerSpec spec();
  [[nodiscard]] LayerData look(Simulation& simulation);

 private:
  void forget_broken(Simulation& simulation);

  std::vector<std::size_t> alive_;
};

}  // namespace plumb::harness
