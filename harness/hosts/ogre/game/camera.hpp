// From where the game is seen, as geometry: the window draws with it, and a point in the window becomes a ray by it.
#pragma once

#include "plumb/physics_world.hpp"

namespace plumb::ogre {

struct Ray {
  PlumbVec3 origin{};
  PlumbVec3 direction{};  ///< unit
};

/// Circles about what it looks at.
struct Camera {
  PlumbVec3 target{-0.2, 1.2, 0};
  double yaw = 0.35, pitch = 0.42;  ///< rad: 0 looks along -z; 0 is level, positive from above
  double distance = 14;             ///< m
  double field_of_view = 0.54;      ///< rad, from top to bottom
  double aspect = 1.6;              ///< width over height of the window

  [[nodiscard]] PlumbVec3 forward() const;
  [[nodiscard]] PlumbVec3 right() const;
  [[nodiscard]] PlumbVec3 eye() const;
  /// x, y: 0..1 from the window's left and top.
  [[nodiscard]] Ray ray(double x, double y) const;

  /// By angles, never below the ground or over the top.
  void turn(double by_yaw, double by_pitch);
  /// Nearer by a factor below 1.
  void zoom(double factor);
};

}  // namespace plumb::ogre
