#include "truth/structures.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "truth/pendulums.hpp"

namespace plumb::truth {

double harmonic_overhang(double length, std::size_t blocks, double share) {
  double overhang = 0;
  for (std::size_t k = 1; k <= blocks; ++k) overhang += share * length / (2 * static_cast<double>(k));
  return overhang;
}

FourSpheres four_spheres() {
  // The line of centres leans by beta from the vertical: sin beta = 1/sqrt 3 (circumradius over side of the triangle).
  const double sine = 1 / std::sqrt(3.0), cosine = std::sqrt(2.0 / 3);
  FourSpheres forces{};
  // Torque about a lower sphere's centre: its two friction forces are equal, so N sin = F (1 + cos).
  forces.critical_friction = sine / (1 + cosine);
  // The top: 3 (N cos + F sin) = 1.
  forces.normal = 1 / (3 * (cosine + forces.critical_friction * sine));
  forces.friction = forces.critical_friction * forces.normal;
  forces.ground = 4.0 / 3;
  forces.ground_friction = forces.friction / forces.ground;
  return forces;
}

std::vector<ChainMode> chain_modes(double g, std::size_t rods, double rod_mass, double rod_length, double tip_mass) {
  const auto n = static_cast<Eigen::Index>(rods);
  const double m = rod_mass, l = rod_length;
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n), stiffness = Eigen::MatrixXd::Zero(n, n);
  // Sideways position of a point is sum of lever * angle: l for the rods above it, a share of its own rod.
  const auto add_point = [&](Eigen::Index rod, double share, double point_mass) {
    Eigen::VectorXd lever = Eigen::VectorXd::Zero(n);
    lever.head(rod).setConstant(l);
    lever[rod] = share * l;
    mass += point_mass * lever * lever.transpose();
    stiffness.diagonal() += point_mass * g * lever;  // height rises by lever (1 - cos angle)
  };
  for (Eigen::Index rod = 0; rod < n; ++rod) {
    add_point(rod, 0.5, m);
    mass(rod, rod) += m * l * l / 12;
  }
  add_point(n - 1, 1, tip_mass);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  std::vector<ChainMode> modes;
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::VectorXd shape = solver.eigenvectors().col(i);
    Eigen::Index largest = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    shape /= shape[largest];
    modes.push_back({std::sqrt(solver.eigenvalues()[i]), {shape.begin(), shape.end()}});
  }
  return modes;
}

Catenary catenary(double g, std::size_t rods, double rod_mass, double rod_length, double span) {
  const double weight = rod_mass * g;
  const auto slope = [&](std::size_t i, double force) {
    return std::atan((static_cast<double>(rods) / 2 - static_cast<double>(i) - 0.5) * weight / force);
  };
  const auto width = [&](double force) {
    double sum = 0;
    for (std::size_t i = 0; i < rods; ++i) sum += rod_length * std::cos(slope(i, force));
    return sum;
  };
  // The width grows with the pull: bisection to the last bit.
  double low = 0, high = weight;
  while (width(high) < span) high *= 2;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (width(middle) < span ? low : high) = middle;
  }
  Catenary shape{high, std::hypot(high, static_cast<double>(rods) * weight / 2), {}, {0}};
  for (std::size_t i = 0; i < rods; ++i) {
    shape.slopes.push_back(slope(i, high));
    shape.depths.push_back(shape.depths.back() + rod_length * std::sin(shape.slopes.back()));
  }
  return shape;
}

double slider_crank(double crank, double rod, double angle) {
  const double across = crank * std::sin(angle);
  return crank * std::cos(angle) + std::sqrt(rod * rod - across * across);
}

double falling_rod_speed(double g, double length, double angle) { return std::sqrt(3 * g * std::sin(angle) / length); }

double falling_rod_time(double g, double length, double angle) {
  // t = int d(phi) / w(phi), with phi = u^2, which takes the root out of the beginning; Simpson's rule.
  const auto integrand = [&](double u) {
    const double sine_over = u > 0 ? std::sin(u * u) / (u * u) : 1;
    return 2 / std::sqrt(3 * g * sine_over / length);
  };
  constexpr int intervals = 2000;
  const double h = std::sqrt(angle) / intervals;
  double sum = integrand(0) + integrand(std::sqrt(angle));
  for (int i = 1; i < intervals; ++i) sum += integrand(i * h) * (i % 2 == 1 ? 4 : 2);
  return sum * h / 3;
}

double parallelogram_period(double g, double crank, double amplitude) {
  return pendulum_period(g, 5 * crank / 6, amplitude);
}

}  // namespace plumb::truth
