// What is looked at beside the poses in the frames of a recording: the referee's account of energy, momentum, overlaps
// and the gaps of joints, the engine's contacts and who sleeps; and, when asked for, what plumb.debug/1 shows.
#pragma once

#include <memory>

#include "record/trajectory.hpp"

namespace plumb::harness {

/// The layers, where scene and backend have them; bodies are indices of the scene:
///   series       one: kinetic, potential (J), momentum (kg m/s), momenta (sum of sizes), contacts (points)
///   joints       list: the joints that there are, with their gaps (record/joint_layer.hpp)
///   penetration  moving: deepest overlap of each body by the referee, m
///   contacts     list: the engine's points and normals, the referee's depth of the two bodies (the engine's own where
///                the referee sees none), the engine's depth of the point, force from the impulse (N, NaN where not
///                told), the feature's id in 32 bits. Where the engine tells no contacts: the referee's overlaps
///   asleep       moving
/// and with `debug`: islands (moving), constraints, boxes and axes (lists).
class SceneLayers {
 public:
  /// declared: the needs of the simulation's world.
  SceneLayers(Simulation& simulation, const Backend& backend, PlumbNeeds declared, bool debug);
  ~SceneLayers();
  [[nodiscard]] std::vector<LayerSpec> specs() const;
  /// For the header: {"every": {layer: frames}, "source": {layer: text}, "without": {layer: why}}.
  [[nodiscard]] Json description() const;
  /// One entry for each of specs(); those that are not due in this frame are empty.
  [[nodiscard]] FrameLayers look(Simulation& simulation, std::uint64_t frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What a world must declare beyond its scene so that all of this can be seen, as far as the backend has it.
[[nodiscard]] PlumbNeeds needs_of_layers(const Backend& backend);

}  // namespace plumb::harness
