#include "truth/pendulums.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "truth/elliptic.hpp"
#include "truth/ode.hpp"

namespace plumb::truth {

double pendulum_period(double g, double length, double amplitude) {
  const double k = std::sin(amplitude / 2);
  return 4 * complete_elliptic(k * k) * std::sqrt(length / g);
}

double pendulum_angle(double g, double length, double amplitude, double t) {
  const double k = std::sin(amplitude / 2);
  const double u = complete_elliptic(k * k) + std::sqrt(g / length) * t;  // sn is at its top at the release
  return 2 * std::asin(k * jacobi(u, k * k).sn);
}

PendulumState semi_implicit_pendulum(double g, double length, PendulumState start, double dt, std::uint64_t steps) {
  for (std::uint64_t i = 0; i < steps; ++i) {
    start.rate -= dt * g / length * std::sin(start.angle);
    start.angle += dt * start.rate;
  }
  return start;
}

SphericalPendulum::Cycle SphericalPendulum::cycle() const {
  const double w = 2 * g / length, u0 = std::cos(theta), s = std::sin(theta);
  const double lz = s * s * rate;
  const double c = rate * rate * s * s - w * u0;
  // -(w u^3 + c u^2 - w u - c + lz^2) = -w (u - u0)(u - u1)(u - u2), the last two roots of a quadratic.
  const double p = (c + w * u0) / w, q = (c * u0 + w * u0 * u0 - w) / w;
  const double root = std::sqrt(p * p / 4 - q);
  const double u1 = -p / 2 + root, u2 = -p / 2 - root;
  constexpr int points = 512;
  double period = 0, azimuth = 0;
  for (int i = 0; i < points; ++i) {
    const double u = (u0 + u1) / 2 + (u0 - u1) / 2 * std::cos(2 * std::numbers::pi * i / points);
    const double dt = 2 * std::numbers::pi / points / std::sqrt(w * (u - u2));
    period += dt;
    azimuth += dt * lz / (1 - u * u);
  }
  return {std::acos(u1), period, azimuth};
}

Eigen::Vector3d SphericalPendulum::position(double t) const {
  // The tension keeps |x| = l: x'' = g - x (g.x + v.v) / l^2.
  const Derivative motion = [this](double, const Eigen::VectorXd& y) -> Eigen::VectorXd {
    const Eigen::Vector3d x = y.head<3>(), v = y.tail<3>(), gravity(0, -g, 0);
    Eigen::VectorXd rate_of_change(6);
    rate_of_change << v, gravity - x * ((gravity.dot(x) + v.squaredNorm()) / (length * length));
    return rate_of_change;
  };
  Eigen::VectorXd y(6);
  y << length * std::sin(theta), -length * std::cos(theta), 0, 0, 0, -rate * length * std::sin(theta);
  return integrate(motion, y, 0, t).head<3>();
}

Eigen::Vector4d double_pendulum(double g, double length, double theta1, double theta2, double t) {
  const Derivative motion = [=](double, const Eigen::VectorXd& y) -> Eigen::VectorXd {
    const double d = y[0] - y[1], s = std::sin(d), c = std::cos(d), w = g / length;
    // 2 a1 + c a2 = -s w2^2 - 2 w sin(theta1);  c a1 + a2 = s w1^2 - w sin(theta2)
    const double r1 = -s * y[3] * y[3] - 2 * w * std::sin(y[0]), r2 = s * y[2] * y[2] - w * std::sin(y[1]);
    const double determinant = 2 - c * c;
    return Eigen::Vector4d(y[2], y[3], (r1 - c * r2) / determinant, (2 * r2 - c * r1) / determinant);
  };
  return integrate(motion, Eigen::Vector4d(theta1, theta2, 0, 0), 0, t);
}

}  // namespace plumb::truth
