// Pendulums: plane, spherical, double. Angles from the downward vertical, rad; g m/s2; lengths m.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace plumb::truth {

/// Period of a plane pendulum of reduced length l (I / (m d)) and amplitude a: 4 K(sin^2(a / 2)) sqrt(l / g).
[[nodiscard]] double pendulum_period(double g, double length, double amplitude);
/// Its angle at t, released at rest at the amplitude.
[[nodiscard]] double pendulum_angle(double g, double length, double amplitude, double t);

/// What semi-implicit Euler in the angle itself makes of it: first the angular velocity, then the angle, `steps` times.
struct PendulumState {
  double angle, rate;
};
[[nodiscard]] PendulumState semi_implicit_pendulum(double g, double length, PendulumState start, double dt,
                                                   std::uint64_t steps);

/// A point on a massless rod, started horizontally at the angle theta with the azimuth rate w: the start is a turning
/// point of theta. u = cos(theta) obeys u'^2 = (1 - u^2)(c + 2 g u / l) - Lz^2 (Landau & Lifshitz, section 14).
struct SphericalPendulum {
  double g, length, theta, rate;

  struct Cycle {
    double other_theta;  ///< the other turning point
    double period;       ///< of theta, s
    double azimuth;      ///< turned in one period, rad
  };
  [[nodiscard]] Cycle cycle() const;
  /// Relative to the pivot, y up, started at (sin theta, -cos theta, 0) l with the velocity (0, 0, -w l sin theta),
  /// which turns counter-clockwise seen from above. Reference integration.
  [[nodiscard]] Eigen::Vector3d position(double t) const;
};

/// Two equal points on two equal massless rods, released at rest at the angles (theta1, theta2): (theta1, theta2, w1,
/// w2) at t. Reference integration.
[[nodiscard]] Eigen::Vector4d double_pendulum(double g, double length, double theta1, double theta2, double t);

}  // namespace plumb::truth
