// What the engine sees as coloured lines, for any renderer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

struct DebugLine {
  PlumbVec3 from, to;    ///< world, m
  std::uint32_t colour;  ///< 0xrrggbb
};

/// Gathers lines between steps. Each add_ appends; what a backend cannot show throws Error, with its sentence.
class DebugLines {
 public:
  static constexpr PlumbNeeds needs = 0;  ///< but contacts need PLUMB_NEED_CONTACTS

  explicit DebugLines(IPhysicsWorld& world) : world_(world) {}

  void clear() { lines_.clear(); }
  [[nodiscard]] std::span<const DebugLine> lines() const { return lines_; }

  /// Axes of every body's frame: x red, y green, z blue, `size` m long.
  void add_frames(double size);
  /// The last step's contacts: a red stroke along the normal, as long as the depth or `least`, and their tangent
  /// impulse in yellow, m per N s.
  void add_contacts(double least = 0.05, double impulse_scale = 0.01);
  /// Both frames of joints and a stroke between their origins, which is the joint's gap. descs: as they were created.
  void add_joints(std::span<const PlumbJointDesc> descs, double size);
  /// Boxes of the broad phase by plumb.debug/1, inner nodes grey; leaves in the colour of their body's island, dark
  /// when it sleeps, white where the engine does not tell.
  void add_boxes();

 private:
  void add_box(const PlumbVec3& lower, const PlumbVec3& upper, std::uint32_t colour);
  void add_axes(const PlumbPose& pose, double size);

  IPhysicsWorld& world_;
  std::vector<DebugLine> lines_;
};

/// The same for the same island; distinct for neighbours (hues by the golden ratio). -1 is grey.
[[nodiscard]] std::uint32_t island_colour(std::int32_t island, bool asleep);

}  // namespace plumb::helpers
