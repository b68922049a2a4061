#include "truth/contacts.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::truth {

double bounce_apex(double fall, double restitution, int n) { return fall * std::pow(restitution, 2 * n); }

double bounce_impact(double g, double fall, double restitution, int n) {
  double sum = 1;
  for (int i = 1; i < n; ++i) sum += 2 * std::pow(restitution, i);
  return sum * std::sqrt(2 * fall / g);
}

HeadOn head_on(double mass_a, double velocity_a, double mass_b, double velocity_b, double restitution) {
  const double total = mass_a + mass_b;
  const double centre = (mass_a * velocity_a + mass_b * velocity_b) / total;
  const double closing = velocity_a - velocity_b;
  return {centre - restitution * closing * mass_b / total, centre + restitution * closing * mass_a / total};
}

std::vector<double> sequential_row(std::size_t spheres) {
  std::vector<double> velocities(spheres, 0.0);
  velocities.back() = 1;
  return velocities;
}

std::vector<double> simultaneous_row(std::size_t spheres, double restitution) {
  const double common = (1 + restitution) / static_cast<double>(spheres);  // keeps the momentum
  std::vector<double> velocities(spheres, common);
  velocities.front() = common - restitution;
  return velocities;
}

GlancingImpact glancing_impact(double angle, double restitution) {
  const Eigen::Vector3d line(std::cos(angle), std::sin(angle), 0);
  const Eigen::Vector3d target = (1 + restitution) / 2 * line.x() * line;
  return {Eigen::Vector3d::UnitX() - target, target};
}

ObliqueImpact oblique_impact(double radius, double tangential, double normal, double friction, double restitution) {
  const double impulse = std::min(2.0 / 7 * tangential, friction * (1 + restitution) * normal);
  return {tangential - impulse, restitution * normal, impulse * 5 / (2 * radius)};
}

LeverImpact lever_impact(double mass, double inertia, double lever, double speed, double restitution) {
  const double impulse = (1 + restitution) * speed / (1 / mass + lever * lever / inertia);
  return {-speed + impulse / mass, impulse * lever / inertia};
}

StickingImpact sticking_impact(double mass, double inertia, double lever, double height, double speed) {
  const double spin = mass * speed * lever / (inertia + mass * (lever * lever + height * height));
  return {spin * height, -spin * lever, spin};
}

Eigen::Vector3d reflect(const Eigen::Vector3d& velocity, const Eigen::Vector3d& n, double restitution) {
  return velocity - (1 + restitution) * velocity.dot(n) * n;
}

double incline_slide(double g, double slope, double friction, double t) {
  return std::max(0.0, g * (std::sin(slope) - friction * std::cos(slope)) * t * t / 2);
}

SlideToRoll slide_to_roll(double g, double friction, double k, double velocity, double surface_spin) {
  // Slip v - r w falls at mu g (1 + 1 / k) until it is 0.
  const double time = (velocity - surface_spin) / (friction * g * (1 + 1 / k));
  return {velocity - friction * g * time, time, velocity * time - friction * g * time * time / 2};
}

RollDown roll_down(double g, double slope, double friction, double k) {
  const double rolling = g * std::sin(slope) / (1 + k);
  if (friction * std::cos(slope) * g >= k * rolling) return {rolling, rolling};
  return {g * (std::sin(slope) - friction * std::cos(slope)), friction * g * std::cos(slope) / k};
}

SpinStop spin_stop(double g, double friction, double side, double lever, double spin) {
  const double deceleration = 6 * friction * g * lever / (side * side);
  return {spin / deceleration, spin * spin / (2 * deceleration)};
}

double corner_lever(double side) { return side * std::sqrt(0.5); }
double uniform_lever(double side) { return side * (std::sqrt(2.0) + std::asinh(1.0)) / 6; }

BeltSlip belt_slip(double g, double friction, double speed) {
  const double time = speed / (friction * g);
  return {time, speed * time / 2};
}

LoadedBox pushed_box(double g, double box_mass, double balls_mass, double friction_ground, double push) {
  const double left = push - friction_ground * (box_mass + balls_mass) * g;
  if (left <= 0) return {0, 0};
  // A ball that rolls on an accelerated box moves with 2/7 of its acceleration.
  const double box = left / (box_mass + 2.0 / 7 * balls_mass);
  return {box, 2.0 / 7 * box};
}

}  // namespace plumb::truth
