#include "truth/mechanisms.hpp"

#include <cmath>
#include <numbers>

namespace plumb::truth {

double toppling_speed(double g, double length, double start) { return std::sqrt(3 * g * std::cos(start) / length); }

double toppling_time(double g, double length, double start) {
  // t = int d(angle) / w, with angle = start + u^2, which takes the root out of the beginning; Simpson's rule.
  const auto integrand = [&](double u) {
    // cos(start) - cos(start + u^2), over u^2
    const double half = u * u / 2;
    const double drop = 2 * std::sin(start + half) * (u > 0 ? std::sin(half) / (u * u) : 0.5);
    return 2 / std::sqrt(3 * g * drop / length);
  };
  constexpr int intervals = 2000;
  const double end = std::sqrt(std::numbers::pi / 2 - start), h = end / intervals;
  double sum = integrand(0) + integrand(end);
  for (int i = 1; i < intervals; ++i) sum += integrand(i * h) * (i % 2 == 1 ? 4 : 2);
  return sum * h / 3;
}

double damped_oscillation(double frequency, double damping_ratio, double x0, double t) {
  const double decay = 2 * std::numbers::pi * frequency * damping_ratio;
  const double turn = 2 * std::numbers::pi * frequency * std::sqrt(1 - damping_ratio * damping_ratio);
  return x0 * std::exp(-decay * t) * (std::cos(turn * t) + decay / turn * std::sin(turn * t));
}

double logarithmic_decrement(double damping_ratio) {
  return 2 * std::numbers::pi * damping_ratio / std::sqrt(1 - damping_ratio * damping_ratio);
}

double four_bar_rocker(double crank, double coupler, double rocker, double ground, double angle) {
  const double x = crank * std::cos(angle) - ground, y = crank * std::sin(angle);  // the crank's pin from the rocker's
  const double across = std::hypot(x, y);
  const double inside = std::acos((across * across + rocker * rocker - coupler * coupler) / (2 * across * rocker));
  return std::atan2(y, x) - inside + (y < 0 ? 2 * std::numbers::pi : 0);
}

double universal_turn(double bend, double angle) {
  const double whole = 2 * std::numbers::pi * std::round(angle / (2 * std::numbers::pi)), rest = angle - whole;
  return whole + std::atan2(std::sin(rest) * std::cos(bend), std::cos(rest));
}

}  // namespace plumb::truth
