// Keeps what is looked at near the origin, where floating-point numbers are dense.
//
// A float at 10 km is known to a millimetre, at 100 m to eight micrometres. The world is shifted by whole cells, whose
// size is a power of two: a coordinate and a multiple of a cell are then both multiples of the coordinate's last bit,
// so the difference is exact wherever it is smaller than what it came from. What is near the focus keeps its relative
// poses to the bit; only what the shift takes farther away is rounded.
#pragma once

#include <span>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

struct FloatingOriginSettings {
  double cell = 256;       ///< m, a power of two
  double distance = 1024;  ///< m, >= cell: the focus may be so far from the origin, along any axis
};

class FloatingOrigin {
 public:
  static constexpr PlumbNeeds needs = 0;

  /// world outlives this. Throws Error on a setting out of range.
  explicit FloatingOrigin(IPhysicsWorld& world, const FloatingOriginSettings& settings = {});

  /// Shifts all bodies, static ones too, by whole cells when the focus (m, in the world's coordinates of now) is too
  /// far out. joints: all of the world. A joint with the world cannot follow: where one is found all bodies are put
  /// back and Error (PLUMB_E_UNSUPPORTED) names it: join it to a static body instead. Sleepers go on sleeping. Returns
  /// what was added to every position: 0 0 0 when nothing moved.
  PlumbVec3 update(const PlumbVec3& focus, std::span<const PlumbJoint> joints = {});

  /// Where the world's origin lies in the coordinates of the start, m: absolute = origin + position.
  [[nodiscard]] const PlumbVec3& origin() const { return origin_; }

 private:
  void shift(const PlumbVec3& by);
  void read_coordinates(std::span<const PlumbJoint> joints, std::vector<double>& coordinates);

  IPhysicsWorld& world_;
  FloatingOriginSettings settings_;
  PlumbVec3 origin_{};
  std::vector<PlumbPose> poses_, before_;
  std::vector<double> awake_;
};

}  // namespace plumb::helpers
