// Measures of single impacts without gravity: velocities are constant before and after.
#include <algorithm>
#include <cmath>

#include "measure/collision/collision.hpp"
#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "truth/contacts.hpp"

namespace plumb::harness {
namespace {

/// Velocity of a body two steps after its first touch: engines with soft contacts spread an impulse over steps. What it
/// was all along when nothing touched.
VelocityRow after_impact(Simulation& simulation, std::size_t body) {
  const referee::Vec3 before = referee::vec(simulation.velocities()[body].linear);
  while (simulation.advance()) {
    if ((referee::vec(simulation.velocities()[body].linear) - before).norm() <= 1e-4 * before.norm()) continue;
    simulation.advance();
    simulation.advance();
    break;
  }
  return simulation.velocities()[body];
}

}  // namespace

void measure_head_on(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t a = arg_body(scene, "a"), b = arg_body(scene, "b");
  const double mass_a = scene.bodies[a].desc.mass, mass_b = scene.bodies[b].desc.mass;
  const double speed = scene.bodies[a].desc.linear_velocity.x;
  const double restitution = arg_number(scene, "restitution");
  Simulation simulation = context.simulate(scene);
  simulation.run();
  const referee::Vec3 va = referee::vec(simulation.velocities()[a].linear);
  const referee::Vec3 vb = referee::vec(simulation.velocities()[b].linear);
  const truth::HeadOn truth = truth::head_on(mass_a, speed, mass_b, 0, restitution);
  context.compare("velocity_a", va.x(), truth.a, speed);
  context.compare("velocity_b", vb.x(), truth.b, speed);
  const double momentum = mass_a * speed;
  const referee::Vec3 lost = mass_a * va + mass_b * vb - referee::Vec3(momentum, 0, 0);
  context.deviation("momentum", lost.norm() / momentum);
  const double start = mass_a * speed * speed / 2;
  const double energy = (mass_a * va.squaredNorm() + mass_b * vb.squaredNorm()) / 2 / start;
  const double expected = (mass_a * truth.a * truth.a + mass_b * truth.b * truth.b) / 2 / start;
  context.compare("energy", energy, expected, 1);
}

void measure_oblique_impact(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double radius = arg_number(scene, "radius");
  const PlumbVec3 v0 = scene.bodies[body].desc.linear_velocity;
  const truth::ObliqueImpact truth =
      truth::oblique_impact(radius, v0.x, -v0.y, arg_number(scene, "friction"), arg_number(scene, "restitution"));
  Simulation simulation = context.simulate(scene);
  const VelocityRow after = after_impact(simulation, body);
  const double speed = v0.x;
  context.compare("tangential", after.linear.x, truth.tangential, speed);
  context.compare("normal", after.linear.y, truth.normal, speed);
  context.compare("spin", -after.angular.z, truth.spin, speed / radius);
}

void measure_tilted_cube(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double half = arg_number(scene, "half"), restitution = arg_number(scene, "restitution");
  const bool sticks = arg_number(scene, "friction") > 0;
  const referee::Mass mass = mass_of_body(scene, body);
  const double inertia = mass.inertia(0, 0), speed = -scene.bodies[body].desc.linear_velocity.y;
  const referee::Mat3 rotation = referee::quat(scene.bodies[body].desc.pose.orientation).toRotationMatrix();
  // The lowest corner, or of an edge that lies flat the middle between its corners.
  referee::Vec3 lowest = referee::Vec3::Zero();
  double corners = 0, depth = 0;
  for (int i = 0; i < 8; ++i) {
    const referee::Vec3 corner =
        rotation * (half * referee::Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
    if (corner.y() < depth - 1e-9) {
      depth = corner.y();
      lowest.setZero();
      corners = 0;
    }
    if (corner.y() < depth + 1e-9) {
      lowest += corner;
      ++corners;
    }
  }
  lowest /= corners;
  const double lever = std::hypot(lowest.x(), lowest.z());
  truth::LeverImpact truth = truth::lever_impact(mass.mass, inertia, lever, speed, restitution);
  double sideways = 0;
  if (sticks) {
    const truth::StickingImpact stuck = truth::sticking_impact(mass.mass, inertia, lever, -depth, speed);
    truth = {stuck.vertical, stuck.spin};
    sideways = stuck.sideways;
  }
  Simulation simulation = context.simulate(scene);
  const VelocityRow after = after_impact(simulation, body);
  const double spin_scale = speed / half;
  context.compare("vertical", after.linear.y, truth.velocity, speed);
  context.compare("sideways", std::hypot(after.linear.x, after.linear.z), sideways, speed);
  context.compare("spin", referee::vec(after.angular).norm(), truth.spin, spin_scale);
}

void measure_sphere_on_box(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double radius = arg_number(scene, "radius"), x = arg_number(scene, "offset_x"),
               z = arg_number(scene, "offset_z");
  const referee::Vec3 before = referee::vec(scene.bodies[body].desc.linear_velocity);
  const referee::Vec3 normal = referee::Vec3(x, std::sqrt(radius * radius - x * x - z * z), z) / radius;
  const referee::Vec3 truth = truth::reflect(before, normal, arg_number(scene, "restitution"));
  Simulation simulation = context.simulate(scene);
  const referee::Vec3 after = referee::vec(after_impact(simulation, body).linear);
  const referee::Vec3 seen = (after - before).normalized();
  context.compare("velocity_x", after.x(), truth.x(), before.norm());
  context.compare("velocity_y", after.y(), truth.y(), before.norm());
  context.compare("velocity_z", after.z(), truth.z(), before.norm());
  context.deviation("normal", std::acos(std::clamp(seen.dot(normal), -1.0, 1.0)) * degrees);
}

}  // namespace plumb::harness
