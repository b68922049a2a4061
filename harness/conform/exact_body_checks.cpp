// Closed forms at tight tolerances: how free bodies move. Asked of what is claimed as native or emulated; who claims an
// approximation has said so.
#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace exact {
namespace {

/// In a pull askew: the velocity to the digits of a float, the path to the half step that integrators differ by.
void fall(Conformance& c) {
  const Vec g(1.5, -9.81, -0.7), start(4, 0.5, -1);
  // A thousand sums of sub-steps in single precision are within a few thousand roundings.
  const double digits = c.backend().info().precision == PLUMB_F64 ? 1e-9 : 3e-4;
  Probe probe(c, c.available(PLUMB_NEED_ROTATION), g);
  const PlumbBody body = probe.free_body({1, 2, 3}, start);
  for (const double dt : {1.0 / 60, 1.0 / 240}) {
    const Vec from = probe.position(body), before = probe.velocity(body);
    const int steps = static_cast<int>(1 / dt + 0.5);
    probe.step(steps, dt);
    const Vec after = probe.velocity(body), exact = from + before + 0.5 * g;
    c.expect((after - before - g).norm() < digits * g.norm(),
             "1 s of fall at dt {:.5f} changes the velocity by {:.6f} "
             "m/s, {:.6f} away from g",
             dt, (after - before).norm(), (after - before - g).norm());
    c.expect((probe.position(body) - exact).norm() < 0.505 * dt * g.norm() + 1e-4,
             "1 s of fall at dt {:.5f} ends {:.6f} m beside the parabola, more than the half step of an integrator of "
             "first order",
             dt, (probe.position(body) - exact).norm());
  }
}

/// Equal moments of inertia: the body turns about an axis that stays, from any orientation.
void spin(Conformance& c) {
  c.require_exact(PLUMB_CAP_NEED, need_index(PLUMB_NEED_ROTATION), 0, "rotation");
  Probe probe(c, PLUMB_NEED_ROTATION, Vec::Zero());
  const Eigen::Quaterniond before(Eigen::AngleAxisd(1.1, Vec(1, -2, 0.5).normalized()));
  const Vec omega(0.6, -1.1, 0.8);
  PlumbBodyDesc desc = dynamic_desc(probe.sphere(0.5), {0, 0, 0});
  desc.pose.orientation = {before.x(), before.y(), before.z(), before.w()};
  desc.angular_velocity = vec3(omega);
  const PlumbBody body = probe.body(desc);
  c.expect((probe.angular_velocity(body) - omega).norm() < 1e-6,
           "the angular velocity that a body was made with is {} "
           "rad/s off",
           (probe.angular_velocity(body) - omega).norm());
  probe.step(120);
  const Eigen::Quaterniond after(Eigen::AngleAxisd(2 * omega.norm(), omega.normalized()) * before);
  c.expect(probe.orientation(body).angularDistance(after) < 2e-3, "2 s of turning at {:.4f} rad/s end {:.5f} rad off",
           omega.norm(), probe.orientation(body).angularDistance(after));
  c.expect((probe.angular_velocity(body) - omega).norm() < 1e-5, "a free ball's spin changed by {:.6f} rad/s in 2 s",
           (probe.angular_velocity(body) - omega).norm());
}

/// A top free of torques: its axis goes round the angular momentum at L / I (Goldstein, Classical Mechanics, 5.6).
void precession(Conformance& c) {
  const PlumbNeeds needs = PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC;
  c.require_needs(needs);
  c.require_exact(PLUMB_CAP_NEED, need_index(PLUMB_NEED_GYROSCOPIC), 0, "gyroscopic term");
  Probe probe(c, needs, Vec::Zero());
  PlumbBodyDesc desc = dynamic_desc(probe.sphere(0.5), {0, 0, 0});
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = 1;
  desc.inertia = {1, 2, 1};
  desc.angular_velocity = {0.5, 2, 0};
  const PlumbBody body = probe.body(desc);
  const Vec momentum(0.5, 4, 0);
  constexpr double kSeconds = 2, kShort = 1.0 / 240;
  probe.step(static_cast<int>(kSeconds / kShort), kShort);
  const Vec axis = probe.orientation(body) * Vec::UnitY(),
            exact = Eigen::AngleAxisd(kSeconds * momentum.norm(), momentum.normalized()) * Vec::UnitY();
  c.expect((axis - exact).norm() < 0.01, "the axis of a free top is {:.5f} rad beside where it goes in {} s",
           (axis - exact).norm(), kSeconds);
}

void damping(Conformance& c) {
  const PlumbNeeds needs = PLUMB_NEED_ROTATION | PLUMB_NEED_DAMPING;
  c.require_needs(needs);
  c.require_exact(PLUMB_CAP_NEED, need_index(PLUMB_NEED_DAMPING), 0, "damping");
  Probe probe(c, needs, Vec::Zero());
  PlumbBodyDesc desc = dynamic_desc(probe.sphere(0.5), {0, 0, 0}, {1, 0, 0});
  desc.angular_velocity = {0, 1, 0};
  desc.linear_damping = 2;
  desc.angular_damping = 1.5;
  const PlumbBody body = probe.body(desc);
  probe.step(240, 1.0 / 240);  // a share of 1 - c dt, or of 1 / (1 + c dt), a step is within 1 % of exp(-c t)
  const double linear = -std::log(probe.velocity(body).x()), angular = -std::log(probe.angular_velocity(body).y());
  c.expect(std::abs(linear - 2) < 0.02, "a linear damping of 2/s acts as {:.5f}/s", linear);
  c.expect(std::abs(angular - 1.5) < 0.015, "an angular damping of 1.5/s acts as {:.5f}/s", angular);
}

/// A target is reached, the body has the velocity that led there, and then it stands.
void kinematic(Conformance& c) {
  const PlumbNeeds needs = PLUMB_NEED_ROTATION | PLUMB_NEED_KINEMATIC;
  c.require_needs(needs);
  c.require_exact(PLUMB_CAP_FIELD_WRITE, PLUMB_FIELD_KINEMATIC_TARGET, 0, "kinematic targets");
  Probe probe(c, needs, Vec::Zero());
  PlumbBodyDesc desc = body_desc(PLUMB_KINEMATIC);
  desc.shape = probe.box({0.5, 0.5, 0.5});
  desc.material.friction = 0;
  const PlumbBody body = probe.body(desc);
  for (int i = 1; i <= 30; ++i) {
    const Vec target(0.03 * i, -0.01 * i, 0.02 * i);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.04 * i, Vec(1, 1, -1).normalized()));
    probe.write_pose(PLUMB_FIELD_KINEMATIC_TARGET, body, target, turn);
    probe.step();
    c.expect((probe.position(body) - target).norm() < 1e-5 && probe.orientation(body).angularDistance(turn) < 1e-4,
             "target {} is missed by {:.6f} m and {:.6f} rad", i, (probe.position(body) - target).norm(),
             probe.orientation(body).angularDistance(turn));
    const Vec led = Vec(0.03, -0.01, 0.02) * 60, read = probe.velocity(body);
    c.expect((read - led).norm() < 0.01 * led.norm(), "at target {} it moved at {:.4f} m/s and reads {:.4f}", i,
             led.norm(), read.norm());
  }
  probe.step();
  c.expect(probe.velocity(body).norm() < 1e-6, "without a new target it reads {:.6f} m/s", probe.velocity(body).norm());
}

}  // namespace
}  // namespace exact

std::span<const Check> exact_body_checks() {
  static constexpr Check checks[] = {
      {"exact.fall", "a parabola in a pull askew, at two time steps", &exact::fall},
      {"exact.spin", "a ball turns about an axis that stays", &exact::spin},
      {"exact.precession", "a free top's axis goes round its angular momentum", &exact::precession},
      {"exact.damping", "both dampings within 1 %", &exact::damping},
      {"exact.kinematic", "targets that move and turn at once", &exact::kinematic},
  };
  return checks;
}

}  // namespace plumb::harness::conform
