// Materials: the coefficients of a pair are the same in every backend.
#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace {

constexpr double kG = 9.81;

/// A cube of friction a that starts at 3 m/s on a floor of friction b: how far it slides in metres.
double slide(Conformance& c, double a, double b) {
  Probe probe(c, kPlainNeeds);
  PlumbBodyDesc floor = body_desc(PLUMB_STATIC);
  floor.shape = probe.box({100, 1, 100});
  floor.pose.position.y = -1;
  floor.material.friction = b;
  probe.body(floor);
  PlumbBodyDesc cube = dynamic_desc(probe.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  cube.material.friction = a;
  const PlumbBody body = probe.body(cube);
  probe.seconds(0.5);
  const double start = probe.position(body).x();
  probe.write(PLUMB_FIELD_VELOCITY, body, {3, 0, 0, 0, 0, 0});
  probe.seconds(1.5);
  return probe.position(body).x() - start;
}

void friction(Conformance& c) {
  for (const auto& [a, b] : {std::pair{0.4, 0.4}, {0.9, 0.1}, {0.2, 0.8}, {2.0, 0.2}}) {
    const double mu = std::sqrt(a * b);
    const double expected = 9 / (2 * mu * kG);
    const double distance = slide(c, a, b);
    c.expect(std::abs(distance - expected) < 0.08 * expected,
             "friction {} on {} (pair {:.3f}): slides {:.4f} m instead of {:.4f}", a, b, mu, distance, expected);
  }
  const double smooth = slide(c, 1, 0);
  c.expect(std::abs(smooth - 4.5) < 0.02, "friction 1 on 0 (pair 0): slides {:.4f} m in 1.5 s instead of 4.5", smooth);
}

/// Drops a ball of restitution a on a floor of restitution b: rebound speed over impact speed.
double bounce(Conformance& c, double a, double b) {
  Probe probe(c, kPlainNeeds | PLUMB_NEED_RESTITUTION, Vec::Zero());
  PlumbBodyDesc floor = body_desc(PLUMB_STATIC);
  floor.shape = probe.box({10, 1, 10});
  floor.pose.position.y = -1;
  floor.material.restitution = b;
  probe.body(floor);
  // Twelve steps of 1/120 s bring the ball from .499 m above the floor to 1 mm below its surface, so that neither
  // speculative contacts nor pushing out of a deep overlap has a part in the rebound.
  PlumbBodyDesc ball = dynamic_desc(probe.sphere(0.5), {0, 0.999, 0}, {0, -5, 0});
  ball.material.restitution = a;
  const PlumbBody body = probe.body(ball);
  probe.step(18, 1.0 / 120);
  return probe.velocity(body).y() / 5;
}

void restitution(Conformance& c) {
  for (const auto& [a, b] : {std::pair{0.0, 0.0}, {0.5, 0.5}, {0.8, 0.2}, {0.2, 0.8}, {1.0, 0.0}}) {
    const double expected = std::max(a, b);
    const double got = bounce(c, a, b);
    c.expect(std::abs(got - expected) < 0.05, "restitution {} on {}: rebounds with {:.4f} instead of {:.4f}", a, b, got,
             expected);
  }
}

void written_material(Conformance& c) {
  c.require(PLUMB_CAP_FIELD_WRITE, PLUMB_FIELD_MATERIAL, 0, "writing of materials");
  Probe probe(c, kPlainNeeds);
  probe.ground();
  const PlumbBody body = probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  probe.write(PLUMB_FIELD_MATERIAL, body, {0, 0});
  c.expect(probe.read(PLUMB_FIELD_MATERIAL, body)[0] == 0, "a written friction is not read back");
  probe.seconds(0.25);
  probe.write(PLUMB_FIELD_VELOCITY, body, {3, 0, 0, 0, 0, 0});
  probe.seconds(1);
  c.expect(std::abs(probe.velocity(body).x() - 3) < 0.05,
           "friction was set to 0 in a contact, but the cube slowed to {:.3f} m/s", probe.velocity(body).x());
}

void surface_velocity(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SURFACE_VELOCITY;
  c.require_needs(needs);
  Probe probe(c, needs);
  PlumbBodyDesc belt = body_desc(PLUMB_STATIC);
  belt.shape = probe.box({50, 1, 5});
  belt.pose.position.y = -1;
  belt.material.surface_velocity = {2, 0, 0};
  probe.body(belt);
  const PlumbBody body = probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  probe.seconds(2);
  c.expect(std::abs(probe.velocity(body).x() - 2) < 0.05, "on a belt of 2 m/s a cube moves at {:.4f} m/s after 2 s",
           probe.velocity(body).x());
}

void child_material(Conformance& c) {
  c.require(PLUMB_CAP_CHILD_MATERIAL, 0, 0, "materials of compound children");
  Probe probe(c, kPlainNeeds);
  probe.ground();
  PlumbCompoundChild child{probe.box({0.5, 0.5, 0.5}), identity_pose(), 1, 0, {}};
  child.material.friction = 0;  // the body's own is .5
  PlumbShapeDesc desc = shape_desc(PLUMB_COMPOUND);
  desc.children = &child;
  desc.child_count = 1;
  const PlumbBody body = probe.dynamic(probe.shape(desc), {0, 0.5, 0}, {3, 0, 0});
  probe.seconds(1);
  c.expect(std::abs(probe.velocity(body).x() - 3) < 0.05, "a child without friction slowed to {:.3f} m/s",
           probe.velocity(body).x());
}

}  // namespace

std::span<const Check> material_checks() {
  static constexpr Check checks[] = {
      {"materials.friction", "the pair's friction is sqrt(mu1 mu2)", &friction},
      {"materials.restitution", "the pair's restitution is max(e1, e2)", &restitution},
      {"materials.written", "a material changed while in contact", &written_material},
      {"materials.surface_velocity", "a conveyor belt", &surface_velocity},
      {"materials.children", "a compound's child with its own material", &child_material},
  };
  return checks;
}

}  // namespace plumb::harness::conform
