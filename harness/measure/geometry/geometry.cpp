// Measures of real geometry: models of packages that tumble, come to rest and are bounced upon.
#include "measure/geometry/geometry.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "measure/instruments/statistics.hpp"
#include "truth/rotation.hpp"
#include "truth/surfaces.hpp"

namespace plumb::harness {
namespace {

using referee::Mat3;
using referee::Vec3;

/// Principal moments, rising, and their right-handed axes in the body's frame.
struct Principal {
  Vec3 moments;
  Mat3 axes;
};

Principal principal(const Mat3& inertia) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  Principal found{solver.eigenvalues(), solver.eigenvectors()};
  if (found.axes.determinant() < 0) found.axes.col(0) *= -1;
  return found;
}

/// A body of any shape flies and turns freely: its moments come from the shape's volume, its motion from Jacobi's
/// elliptic functions.
void tumble(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const referee::Mass mass = mass_of_body(scene, body);
  const auto [moments, axes] = principal(mass.inertia);
  Simulation simulation = context.simulate(scene);
  const referee::BodyState start = state_of(simulation, body, mass);
  const Vec3 spin = axes.transpose() * start.pose.rotation.transpose() * start.angular;
  const truth::FreeRotation truth(moments, spin);
  double worst_energy = 0, worst_momentum = 0, energy_drift = 0, momentum_drift = 0;
  simulation.run([&](Simulation& now) {
    const referee::BodyState state = state_of(now, body, mass);
    energy_drift = state.angular.dot(state.spin()) / 2 / truth.energy() - 1;
    momentum_drift = (state.spin() - start.spin()).norm() / truth.momentum();
    worst_energy = largest(worst_energy, std::abs(energy_drift));
    worst_momentum = largest(worst_momentum, momentum_drift);
  });
  context.add({"energy_drift", energy_drift, 0.0, worst_energy, std::nullopt, ""});
  context.add({"momentum_drift", momentum_drift, 0.0, worst_momentum, std::nullopt, ""});
  const referee::BodyState end = state_of(simulation, body, mass);
  const Mat3 expected =
      start.pose.rotation * axes * truth.orientation(simulation.time()).toRotationMatrix() * axes.transpose();
  const double turned = start.angular.norm() * simulation.time();
  const double off = Eigen::AngleAxisd(expected.transpose() * end.pose.rotation).angle();
  context.add({"orientation", off * degrees, 0.0, off / turned, std::nullopt, "over the angle that it turned by"});
}

/// Hulls of a model dropped in many orientations come to rest on faces over which their centre of mass lies.
void come_to_rest(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> bodies = arg_bodies(scene, "bodies");
  const double size = arg_number(scene, "size");
  const referee::ShapePtr shape = shape_of(scene, *scene.bodies[bodies.front()].shape);
  const referee::Mass mass = mass_of_body(scene, bodies.front());
  std::vector<truth::HalfSpace> faces;
  for (const referee::Polytope::Face& face : shape->core().faces) faces.push_back({face.normal, face.offset});
  constexpr double flat = 1e-9;  // m, of a model of a metre
  const auto stands = truth::stable_stands(shape->core().corners, faces, mass.centre, flat * size);

  Simulation simulation = context.simulate(scene);
  simulation.run();
  std::vector<double> tilts, heights;
  std::size_t resting = 0;
  for (const std::size_t body : bodies) {
    const referee::BodyState state = state_of(simulation, body, mass);
    const double speed = std::hypot(state.linear.norm(), state.angular.norm() * size / 2);
    if (speed * speed < 1e-4 * std::abs(scene.gravity.y) * size) ++resting;
    const Vec3 down = state.pose.rotation.transpose() * -Vec3::UnitY();
    const auto nearest = std::min_element(stands.begin(), stands.end(), [&](const auto& a, const auto& b) {
      return a.down.dot(down) > b.down.dot(down);
    });
    tilts.push_back(std::atan2(nearest->down.cross(down).norm(), nearest->down.dot(down)));
    heights.push_back(std::abs(simulation.centre_of_mass(body).y - nearest->height) / size);
  }
  std::sort(tilts.begin(), tilts.end());
  std::sort(heights.begin(), heights.end());
  context.compare("resting", static_cast<double>(resting) / static_cast<double>(bodies.size()), 1, 1,
                  "share of the bodies; the hull has " + std::to_string(stands.size()) + " faces to stand on");
  context.deviation("tilt", tilts.back() * degrees);
  context.deviation("height", heights.back());
}

/// Marbles without friction fall on a mesh, each for itself, and bounce off it by the mirror.
void bounce_off_mesh(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> marbles = arg_bodies(scene, "bodies");
  const std::size_t model = arg_body(scene, "model");
  const referee::ShapePtr surface = shape_of(scene, *scene.bodies[model].shape);
  const double radius = scene.shapes[*scene.bodies[marbles.front()].shape].desc.radius;
  constexpr int settling = 4;  // steps: soft contacts take several to turn a body round

  struct Bounce {
    std::size_t marble;
    Vec3 before, after;
    std::uint64_t read;  ///< step at whose end the velocity is read
  };
  std::vector<Bounce> bounces;
  for (const std::size_t marble : marbles) {
    const PlumbBodyDesc& desc = scene.bodies[marble].desc;
    const Vec3 start = referee::vec(desc.pose.position), before = referee::vec(desc.linear_velocity);
    const double speed = before.norm(), reach = speed * scene.seconds;
    const auto touch = truth::first_touch(surface->triangles(), start, before / speed, radius, reach);
    if (!touch) continue;
    const Vec3 after = before - 2 * before.dot(touch->normal) * touch->normal;
    const auto read = static_cast<std::uint64_t>(std::ceil(touch->distance / speed / scene.dt)) + settling;
    // Out of a groove it bounces a second time: that is another question. 2 steps of slack, for what came late.
    const Vec3 place = start + touch->distance / speed * before;
    const double free = speed * (settling + 2) * scene.dt;
    if (truth::first_touch(surface->triangles(), place + 1e-6 * radius * touch->normal, after / speed, radius, free))
      continue;
    if (static_cast<double>(read) * scene.dt < scene.seconds) bounces.push_back({marble, before, after, read});
  }

  Simulation simulation = context.simulate(scene);
  std::vector<double> errors;
  std::size_t passed = 0;
  simulation.run([&](Simulation& now) {
    for (const Bounce& bounce : bounces) {
      if (bounce.read != now.steps()) continue;
      const Vec3 found = referee::vec(now.velocities()[bounce.marble].linear);
      errors.push_back((found - bounce.after).norm() / bounce.before.norm());
      if ((found - bounce.before).norm() < 0.01 * bounce.before.norm()) ++passed;
    }
  });
  std::sort(errors.begin(), errors.end());
  const auto at = [&](double share) {
    return errors.empty() ? not_measured : errors[static_cast<std::size_t>(share * static_cast<double>(errors.size()))];
  };
  const std::string note = std::to_string(errors.size()) + " marbles that bounce once";
  context.deviation("rebound", at(0.5));
  context.deviation("rebound_p90", at(0.9));
  context.add({"passed", static_cast<double>(passed), 0.0, static_cast<double>(passed), std::nullopt, note});
}

}  // namespace

std::span<const MeasureEntry> geometry_measures() {
  using enum ArgumentType;
  static constexpr MeasureArgument tumble_args[] = {{"body", body}};
  static constexpr MeasureArgument rest_args[] = {{"bodies", bodies}, {"size", number}};
  static constexpr MeasureArgument bounce_args[] = {{"bodies", bodies}, {"model", body}};
  static constexpr MeasureEntry entries[] = {
      {"tumble", "orientation, energy and momentum of a free body of any shape", tumble_args, tumble},
      {"rest", "hulls that fell stand on a face that bears them", rest_args, come_to_rest},
      {"mesh_bounce", "velocity of marbles after their first bounce off a mesh", bounce_args, bounce_off_mesh}};
  return entries;
}

}  // namespace plumb::harness
