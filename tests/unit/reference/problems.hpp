// Contact problems for tests: boxes on the ground and on each other, and random ones.
#pragma once

#include <random>
#include <vector>

#include "reference/step_problem.hpp"

namespace plumb::reference {

constexpr double step_seconds = 1.0 / 60, gravity = 9.81;

inline StepForces weight() { return {{0, -gravity, 0}, step_seconds, false}; }

/// A cube of side 1 with its centre here.
inline referee::BodyState cube(double mass, const referee::Vec3& centre) {
  referee::BodyState state;
  state.mass = {mass, referee::Vec3::Zero(), referee::Mat3::Identity() * (mass / 6)};
  state.pose.position = centre;
  return state;
}

/// Body 0 is the ground; cubes stand on each other, body i centred at height i - 1/2, four contacts a face.
struct Tower {
  std::vector<referee::BodyState> bodies{referee::BodyState{}};
  std::vector<StepContact> contacts;

  Tower(std::size_t cubes, double friction, double mass_ratio = 1) {
    double mass = 1000;
    for (std::size_t i = 1; i <= cubes; ++i, mass *= mass_ratio) {
      const double height = static_cast<double>(i);
      bodies.push_back(cube(mass, {0, height - 0.5, 0}));
      for (const double x : {-0.5, 0.5})
        for (const double z : {-0.5, 0.5}) contacts.push_back({i - 1, i, {x, height - 1, z}, {0, 1, 0}, friction});
    }
  }
  [[nodiscard]] StepProblem problem() const { return {bodies, contacts, weight()}; }
};

/// Bodies of masses a hundredfold apart in contact here and there, most often with too many contacts to be unique.
inline StepProblem random_problem(std::mt19937& random, std::size_t bodies, std::size_t contacts, double friction) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return referee::Vec3(unit(random), unit(random), unit(random)); };
  std::vector<referee::BodyState> states(bodies + 1);
  for (std::size_t i = 1; i <= bodies; ++i) {
    const double mass = std::pow(10, unit(random));
    states[i].mass = {mass, referee::Vec3::Zero(),
                      Eigen::Vector3d(vector().cwiseAbs() * 0.2 + referee::Vec3::Constant(0.05)).asDiagonal() * mass *
                          referee::Mat3::Identity()};
    states[i].pose.position = 0.3 * vector();
    states[i].linear = vector();
    states[i].angular = vector();
  }
  std::vector<StepContact> points;
  std::uniform_int_distribution<std::size_t> any(0, bodies);
  while (points.size() < contacts) {
    const std::size_t a = any(random), b = any(random);
    if (a != b) points.push_back({a, b, 0.5 * vector(), vector().normalized(), friction, 0});
  }
  return {states, points, {referee::Vec3::Zero(), step_seconds, false}};
}

}  // namespace plumb::reference
