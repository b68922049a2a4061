#include "reference/one_contact.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <optional>

#include "plumb/assert.hpp"
#include "reference/contact_problem.hpp"

namespace plumb::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// a0 + a1 cos + b1 sin + a2 cos 2 + b2 sin 2 of an angle: the part of the slip that is square to the direction of
/// friction, times the (positive) mobility along the impulse.
struct SlipAcross {
  double a0, a1, b1, a2, b2;

  SlipAcross(const Matrix3d& w, const Vector3d& q, double mu) {
    const double g1 = w(0, 0) * q[1] - q[0] * w(1, 0), g2 = w(0, 0) * q[2] - q[0] * w(2, 0);
    a0 = mu * (q[2] * w(1, 0) - q[1] * w(2, 0)) / 2;
    a1 = g2;
    b1 = -g1;
    a2 = mu * ((q[2] * w(1, 0) + q[1] * w(2, 0)) / 2 - q[0] * w(1, 2));
    b2 = mu * ((q[2] * w(2, 0) - q[1] * w(1, 0)) / 2 - q[0] * (w(2, 2) - w(1, 1)) / 2);
  }
  [[nodiscard]] double at(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return a0 + a1 * c + b1 * s + a2 * (c * c - s * s) + b2 * 2 * s * c;
  }
  [[nodiscard]] double slope(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return -a1 * s + b1 * c + 2 * (-a2 * 2 * s * c + b2 * (c * c - s * s));
  }
};

/// The root between two angles at which the signs differ: Newton's method, halving where that leaves the bracket.
double root_between(const SlipAcross& across, double low, double high) {
  PLUMB_ASSERT(low < high && (across.at(low) < 0) != (across.at(high) < 0));
  const bool rises = across.at(low) < 0;
  double angle = (low + high) / 2;
  for (int i = 0; i < 60; ++i) {
    const double value = across.at(angle);
    if (value == 0) break;
    ((value < 0) == rises ? low : high) = angle;
    const double next = angle - value / across.slope(angle);
    const double better = next > low && next < high ? next : (low + high) / 2;
    if (std::abs(better - angle) < 1e-15) break;
    angle = better;
  }
  return angle;
}

/// The impulse that slides with friction along this angle, where Coulomb's law allows it.
std::optional<Vector3d> sliding(const Matrix3d& w, const Vector3d& q, double mu, double angle) {
  const Vector3d direction(1, mu * std::cos(angle), mu * std::sin(angle));
  const double mobility = w.row(0).dot(direction);
  if (mobility <= 0) return std::nullopt;
  const Vector3d impulse = -q[0] / mobility * direction;
  const Vector2d slip = (w * impulse + q).tail<2>();
  if (slip.dot(direction.tail<2>()) > 0) return std::nullopt;
  return impulse;
}

}  // namespace

Vector3d solve_one_contact(const Matrix3d& w, const Vector3d& q, double mu, const Vector3d& before) {
  if (q[0] >= 0) return Vector3d::Zero();
  const Vector3d sticking = -w.partialPivLu().solve(q);
  if (sticking.tail<2>().norm() <= mu * sticking[0]) return sticking;
  if (mu == 0) return {-q[0] / w(0, 0), 0, 0};
  const SlipAcross across(w, q, mu);
  std::optional<Vector3d> best;
  // Roots that nearly fall together hide between coarse samples: where none is found, look closer.
  for (int parts = 16; parts <= 1024 && !best; parts *= 8) {
    const double step = 2 * std::numbers::pi / parts;
    double low = 0.1, at_low = across.at(low);  // off the axes, on which symmetric problems have their roots
    for (int i = 0; i < parts; ++i, low += step) {
      const double at_high = across.at(low + step);
      if ((at_low < 0) != (at_high < 0)) {
        const auto found = sliding(w, q, mu, root_between(across, low, low + step));
        if (found && (!best || (*found - before).norm() < (*best - before).norm())) best = found;
      }
      at_low = at_high;
    }
  }
  if (best) return *best;
  Vector3d lifted = w * before + q;
  lifted[0] += mu * lifted.tail<2>().norm();
  return nearest_in_cone(before - lifted, mu);
}

}  // namespace plumb::reference
