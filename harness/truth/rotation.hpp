// Rigid rotation: the free asymmetric body and the heavy symmetric top.
#pragma once

#include <Eigen/Geometry>

namespace plumb::truth {

/// A box of mass m and half extents h about its centre: m / 3 (hy^2 + hz^2) ...
[[nodiscard]] Eigen::Vector3d box_inertia(double mass, const Eigen::Vector3d& half_extents);

/// Free rotation of a body with I1 < I2 < I3 from the angular velocity w (body axes). The component about the middle
/// axis is a2 sn u; of the others, the axis that the motion stays about (3 where L^2 > 2 E I2, else 1) has dn u and the
/// third one cn u; u goes evenly with time (Landau & Lifshitz, Mechanics, section 37).
class FreeRotation {
 public:
  FreeRotation(const Eigen::Vector3d& inertia, const Eigen::Vector3d& w);
  [[nodiscard]] Eigen::Vector3d angular_velocity(double t) const;  ///< body axes
  [[nodiscard]] double energy() const { return energy_; }
  [[nodiscard]] double momentum() const { return momentum_; }
  [[nodiscard]] double modulus() const { return m_; }  ///< k^2
  [[nodiscard]] double first_flip() const;             ///< time at which w2 first changes its sign
  [[nodiscard]] double flip_interval() const;          ///< time between sign changes of w2
  [[nodiscard]] int flips(double seconds) const;
  /// Orientation at t, identity at 0; by reference integration.
  [[nodiscard]] Eigen::Quaterniond orientation(double t) const;

 private:
  double energy_, momentum_, m_, quarter_;
  double start_, rate_;  ///< u = start + rate t
  bool about_third_;     ///< the motion stays about axis 3, else about axis 1
  Eigen::Vector3d amplitudes_;
};

/// A symmetric top on a fixed point (Goldstein, Classical Mechanics, section 5.7). I1: about the point, across the
/// axis; I3: about the axis; weight: m g l, N m; spin: the constant component of the angular velocity along the axis.
struct HeavyTop {
  double across, along, weight, spin;

  /// The slow steady precession at the angle theta from the upward vertical, rad/s: the root of
  /// I1 cos(theta) W^2 - I3 w3 W + m g l = 0 that is small.
  [[nodiscard]] double slow_precession(double theta) const;

  /// Let go at rest (but for the spin) at theta.
  struct Nutation {
    double lowest;   ///< largest theta, rad
    double period;   ///< s
    double azimuth;  ///< rad per period
  };
  [[nodiscard]] Nutation nutation(double theta) const;
};

}  // namespace plumb::truth
