// Scenes that are run twice: through plumb, and by a program written straight against ODE.
#pragma once

#include <string>
#include <vector>

#include "plumb/plumb.h"

namespace plumb::ode_test {

struct BoxBody {
  PlumbVec3 half_extents;
  PlumbPose pose;
  double mass;  ///< kg; 0: static
  PlumbVec3 inertia;
};

/// All at the same place and along the same axis for both bodies.
struct Link {
  PlumbJointType type;  ///< ball or hinge
  int a, b;             ///< into bodies; a = -1: the world
  PlumbVec3 anchor;
};

struct Scene {
  std::string name;
  std::vector<BoxBody> bodies;
  std::vector<Link> links;
};

/// Of the moving bodies, in order of creation.
struct StateRows {
  std::vector<double> poses;       ///< 7 each: position, orientation x y z w
  std::vector<double> velocities;  ///< 6 each: linear, angular
  friend bool operator==(const StateRows&, const StateRows&) = default;
};

inline constexpr double friction = 0.5;
inline constexpr double dt = 1.0 / 60;
inline constexpr int most_contacts = 8;

[[nodiscard]] Scene tower(int height);
/// Planar, `base` boxes in the lowest row.
[[nodiscard]] Scene pyramid(int base);
/// Cubes of random orientation that fall into an open container, first overlapping a little: the pile of /scenes.
[[nodiscard]] Scene pile(int count);
/// Rods on ball joints, horizontal at first, hung on the world.
[[nodiscard]] Scene chain(int links);
/// A rod on a hinge along x.
[[nodiscard]] Scene pendulum();

}  // namespace plumb::ode_test
