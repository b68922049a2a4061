#include "truth/rotation.hpp"

#include <cmath>
#include <numbers>

#include "truth/elliptic.hpp"
#include "truth/ode.hpp"

namespace plumb::truth {

Eigen::Vector3d box_inertia(double mass, const Eigen::Vector3d& half_extents) {
  const Eigen::Vector3d s = half_extents.cwiseAbs2();
  return mass / 3 * Eigen::Vector3d(s.y() + s.z(), s.z() + s.x(), s.x() + s.y());
}

FreeRotation::FreeRotation(const Eigen::Vector3d& inertia, const Eigen::Vector3d& w) {
  const double i1 = inertia.x(), i2 = inertia.y(), i3 = inertia.z();
  energy_ = w.dot(inertia.cwiseProduct(w)) / 2;
  momentum_ = inertia.cwiseProduct(w).norm();
  // 2 E I3 - L^2, L^2 - 2 E I1 and L^2 - 2 E I2 without the difference of large numbers.
  const Eigen::Vector3d s = inertia.cwiseProduct(w.cwiseAbs2());
  const double above = s.x() * (i3 - i1) + s.y() * (i3 - i2), below = s.y() * (i2 - i1) + s.z() * (i3 - i1);
  about_third_ = s.z() * (i3 - i2) > s.x() * (i2 - i1);
  const double fast = about_third_ ? below * (i3 - i2) : above * (i2 - i1);
  const double slow = about_third_ ? above * (i2 - i1) : below * (i3 - i2);
  m_ = slow / fast;
  quarter_ = complete_elliptic(m_);
  const double middle = about_third_ ? above / (i2 * (i3 - i2)) : below / (i2 * (i2 - i1));
  amplitudes_ = {std::sqrt(above / (i1 * (i3 - i1))), std::sqrt(middle), std::sqrt(below / (i3 * (i3 - i1)))};
  double& kept = about_third_ ? amplitudes_.z() : amplitudes_.x();  // of dn, which never changes its sign
  kept = std::copysign(kept, about_third_ ? w.z() : w.x());
  rate_ = std::copysign(std::sqrt(fast / (i1 * i2 * i3)), kept);
  const double cn = about_third_ ? w.x() / amplitudes_.x() : w.z() / amplitudes_.z();
  start_ = std::ellint_1(std::sqrt(m_), std::atan2(w.y() / amplitudes_.y(), cn));
}

Eigen::Vector3d FreeRotation::angular_velocity(double t) const {
  const Jacobi j = jacobi(start_ + rate_ * t, m_);
  return amplitudes_.cwiseProduct(Eigen::Vector3d(about_third_ ? j.cn : j.dn, j.sn, about_third_ ? j.dn : j.cn));
}

double FreeRotation::first_flip() const {
  // sn is 0 at whole multiples of 2 K.
  const double along = (rate_ > 0 ? start_ : -start_) / (2 * quarter_);
  return (std::floor(along) + 1 - along) * flip_interval();
}
double FreeRotation::flip_interval() const { return 2 * quarter_ / std::abs(rate_); }

int FreeRotation::flips(double seconds) const {
  return static_cast<int>(std::floor((seconds - first_flip()) / flip_interval())) + 1;
}

Eigen::Quaterniond FreeRotation::orientation(double t) const {
  const Derivative turn = [this](double time, const Eigen::VectorXd& y) -> Eigen::VectorXd {
    const Eigen::Vector3d w = angular_velocity(time);
    const Eigen::Quaterniond q(y[3], y[0], y[1], y[2]);
    return 0.5 * (q * Eigen::Quaterniond(0, w.x(), w.y(), w.z())).coeffs();
  };
  const Eigen::VectorXd y = integrate(turn, Eigen::Vector4d(0, 0, 0, 1), 0, t);
  return Eigen::Quaterniond(y[3], y[0], y[1], y[2]).normalized();
}

double HeavyTop::slow_precession(double theta) const {
  const double a = across * std::cos(theta), b = along * spin;
  return 2 * weight / (b + std::sqrt(b * b - 4 * a * weight));
}

HeavyTop::Nutation HeavyTop::nutation(double theta) const {
  // With u = cos(theta): u'^2 = (u0 - u) (b (1 - u^2) - a^2 (u0 - u)), which also vanishes at u1 < u0 and u2 > 1.
  const double a = along * spin / across, b = 2 * weight / across, u0 = std::cos(theta);
  const double half = a * a / (2 * b);
  const double root = std::sqrt(half * half - 2 * half * u0 + 1);
  const double u1 = half - root, u2 = half + root;
  // u = middle + reach cos(s) makes the integrands periodic, for which the trapezoidal rule converges exponentially.
  constexpr int points = 512;
  double period = 0, azimuth = 0;
  for (int i = 0; i < points; ++i) {
    const double u = (u0 + u1) / 2 + (u0 - u1) / 2 * std::cos(2 * std::numbers::pi * i / points);
    const double dt = 2 * std::numbers::pi / points / std::sqrt(b * (u2 - u));
    period += dt;
    azimuth += dt * a * (u0 - u) / (1 - u * u);
  }
  return {std::acos(u1), period, azimuth};
}

}  // namespace plumb::truth
