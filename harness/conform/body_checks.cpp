// Bodies: how they move, what the host can do to them, and what it means.
#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace {

constexpr double kDt = 1.0 / 60;

PlumbBodyDesc smooth(PlumbBodyDesc desc) {
  desc.material.friction = 0;
  return desc;
}

bool near(const Vec& a, const Vec& b, double tolerance) { return (a - b).norm() <= tolerance; }

void free_fall(Conformance& c) {
  Probe probe(c, c.available(PLUMB_NEED_ROTATION));
  const PlumbBody body = probe.free_body({1, 2, 3}, {4, 0, 0});
  probe.step(60);
  c.expect(near(probe.velocity(body), {4, -9.81, 0}, 1e-4), "after 1 s of fall the velocity is {:.6f} m/s",
           probe.velocity(body).y());
  const double drop = 2 - probe.position(body).y();
  c.expect(std::abs(drop - 4.905) < 4.905 * kDt * 1.01, "in 1 s it fell {:.6f} m instead of 4.905", drop);
  c.expect(std::abs(probe.position(body).x() - 5) < 1e-4, "a free body slowed down sideways: x is {:.6f}",
           probe.position(body).x());
}

void gravity(Conformance& c) {
  Probe probe(c, c.available(PLUMB_NEED_ROTATION));
  PlumbBodyDesc desc = probe.free_desc({0, 0, 0});
  std::vector<std::pair<double, PlumbBody>> bodies;
  for (const double scale : {-1.0, 0.0, 0.5, 1.0, 2.0}) {
    desc.gravity_scale = scale;
    desc.pose.position.x += 10;
    bodies.emplace_back(scale, probe.body(desc));
  }
  probe.step(30);
  const bool nearly = c.backend().capability(PLUMB_CAP_FIELD_WRITE, PLUMB_FIELD_GRAVITY_SCALE) == PLUMB_APPROXIMATE;
  const double share = nearly ? 0.005 : 0;
  for (const auto& [scale, body] : bodies)
    c.expect(std::abs(probe.velocity(body).y() + 9.81 * scale * 0.5) < 1e-4 + share * std::abs(9.81 * scale * 0.5),
             "gravity scale {}: {:.6f} m/s after .5 s", scale, probe.velocity(body).y());
  check(probe.world(), probe.world().set_gravity({1, 0, 0}));
  const double before = probe.velocity(bodies[3].second).x();
  probe.step(60);
  c.expect(std::abs(probe.velocity(bodies[3].second).x() - before - 1) < 1e-4,
           "gravity changed to +x, but after 1 s v.x rose by {:.6f}", probe.velocity(bodies[3].second).x() - before);
  if (c.backend().capability(PLUMB_CAP_FIELD_WRITE, PLUMB_FIELD_GRAVITY_SCALE) == PLUMB_NONE) return;
  probe.write(PLUMB_FIELD_GRAVITY_SCALE, bodies[3].second, {0});
  const double still = probe.velocity(bodies[3].second).x();
  probe.step(30);
  c.expect(std::abs(probe.velocity(bodies[3].second).x() - still) < 1e-6,
           "gravity scale 0 was written, but the body is still pulled");
}

void damping(Conformance& c) {
  Probe probe(c, PLUMB_NEED_ROTATION | PLUMB_NEED_DAMPING, Vec::Zero());
  PlumbBodyDesc desc = smooth(dynamic_desc(probe.sphere(0.5), {0, 0, 0}, {1, 0, 0}));
  desc.angular_velocity = {0, 1, 0};
  desc.linear_damping = 0.5;
  desc.angular_damping = 2;
  const PlumbBody body = probe.body(desc);
  probe.step(60);
  c.expect(std::abs(probe.velocity(body).x() - std::exp(-0.5)) < 0.01,
           "damping .5/s leaves {:.5f} of the speed after 1 s instead of {:.5f}", probe.velocity(body).x(),
           std::exp(-0.5));
  c.expect(std::abs(probe.angular_velocity(body).y() - std::exp(-2.0)) < 0.01,
           "damping 2/s leaves {:.5f} of the spin instead of {:.5f}", probe.angular_velocity(body).y(), std::exp(-2.0));
}

/// A box 1 x 2 x 3 m of 1 kg, so that every axis has its own inertia.
PlumbBody brick(Probe& probe) {
  PlumbBodyDesc desc = smooth(dynamic_desc(probe.box({0.5, 1, 1.5}), {5, 6, 7}));
  desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
  desc.mass = 1;
  return probe.body(desc);
}
const Vec kBrickInertia(13.0 / 12, 10.0 / 12, 5.0 / 12);

void forces(Conformance& c) {
  const PlumbNeeds needs = PLUMB_NEED_ROTATION | PLUMB_NEED_FORCES;
  {
    Probe probe(c, needs, Vec::Zero());
    const PlumbBody body = brick(probe);
    probe.write(PLUMB_FIELD_FORCE, body, {6, 0, 0});
    probe.write(PLUMB_FIELD_FORCE, body, {0, 12, 0});  // adds to the first
    probe.write(PLUMB_FIELD_TORQUE, body, {0, 0, 3});
    probe.step();
    c.expect(near(probe.velocity(body), {0.1, 0.2, 0}, 1e-6),
             "forces 6 and 12 N on 1 kg for one step give ({:.6f}, {:.6f})", probe.velocity(body).x(),
             probe.velocity(body).y());
    c.expect(near(probe.angular_velocity(body), {0, 0, 3 * kDt / kBrickInertia.z()}, 1e-5),
             "3 N m for one step give {:.6f} rad/s", probe.angular_velocity(body).z());
    const Vec after = probe.velocity(body);
    probe.step();
    c.expect(near(probe.velocity(body), after, 1e-6), "a force acts beyond its step");
  }
  {
    Probe probe(c, needs, Vec::Zero());
    const PlumbBody body = brick(probe);
    probe.write(PLUMB_FIELD_IMPULSE, body, {1, 2, 3});
    c.expect(near(probe.velocity(body), {1, 2, 3}, 1e-6), "an impulse must change the velocity at once");
    probe.write(PLUMB_FIELD_ANGULAR_IMPULSE, body, {1, 0, 0});
    c.expect(near(probe.angular_velocity(body), {1 / kBrickInertia.x(), 0, 0}, 1e-5),
             "an angular impulse of 1 gives {:.6f} rad/s", probe.angular_velocity(body).x());
  }
  {
    Probe probe(c, needs, Vec::Zero());
    const PlumbBody body = brick(probe);
    probe.write(PLUMB_FIELD_IMPULSE_AT_POINT, body, {0, 1, 0, 5.5, 6, 7});  // half a metre along x from the centre
    c.expect(near(probe.velocity(body), {0, 1, 0}, 1e-6), "an impulse at a point must push the whole body");
    c.expect(near(probe.angular_velocity(body), {0, 0, 0.5 / kBrickInertia.z()}, 1e-5),
             "an impulse at a point gives {:.6f} rad/s about z", probe.angular_velocity(body).z());
  }
  {
    Probe probe(c, needs, Vec::Zero());
    const PlumbBody body = brick(probe);
    probe.write(PLUMB_FIELD_FORCE_AT_POINT, body, {0, 60, 0, 5.5, 6, 7});
    probe.step();
    c.expect(near(probe.velocity(body), {0, 1, 0}, 1e-5), "60 N at a point for one step give {:.6f} m/s",
             probe.velocity(body).y());
    c.expect(near(probe.angular_velocity(body), {0, 0, 0.5 / kBrickInertia.z()}, 1e-4),
             "a force at a point gives {:.6f} rad/s about z", probe.angular_velocity(body).z());
  }
}

void centre_of_mass(Conformance& c) {
  Probe probe(c, PLUMB_NEED_ROTATION | PLUMB_NEED_FORCES, Vec::Zero());
  PlumbBodyDesc desc = smooth(dynamic_desc(probe.box({0.5, 0.5, 0.5}), {0, 0, 0}));
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = 2;
  desc.centre_of_mass = {1, 0, 0};
  desc.inertia = {1, 1, 1};
  desc.angular_velocity = {0, 0, 1};
  const PlumbBody body = probe.body(desc);
  probe.step(60);
  // The centre of mass stays at (1, 0, 0) and the body's origin goes round it.
  const Vec expected(1 - std::cos(1.0), -std::sin(1.0), 0);
  c.expect(near(probe.position(body), expected, 2e-3),
           "a body spinning about a centre of mass 1 m off is at ({:.4f}, {:.4f}) instead of ({:.4f}, {:.4f})",
           probe.position(body).x(), probe.position(body).y(), expected.x(), expected.y());
  c.expect(probe.velocity(body).norm() < 1e-6, "the velocity of the centre of mass is {:.6f} m/s instead of 0",
           probe.velocity(body).norm());
  const Vec spin = probe.angular_velocity(body);  // which a second may have worn: exact.spin looks at that
  probe.write(PLUMB_FIELD_IMPULSE, body, {0, 2, 0});
  c.expect(near(probe.velocity(body), {0, 1, 0}, 1e-6) && near(probe.angular_velocity(body), spin, 1e-6) &&
               std::abs(spin.z() - 1) < 1e-3,
           "an impulse of 2 N s at the centre of mass of 2 kg that spun at {:.6f} rad/s gives {:.6f} m/s and {:.6f} "
           "rad/s",
           spin.z(), probe.velocity(body).y(), probe.angular_velocity(body).z());
}

void principal_axes(Conformance& c) {
  Probe probe(c, PLUMB_NEED_ROTATION | PLUMB_NEED_FORCES, Vec::Zero());
  PlumbBodyDesc desc = smooth(dynamic_desc(probe.sphere(0.5), {0, 0, 0}));
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = 1;
  desc.inertia = {1, 2, 4};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec(1, 2, 3).normalized()));
  desc.inertia_orientation = {turn.x(), turn.y(), turn.z(), turn.w()};
  const PlumbBody body = probe.body(desc);
  const Vec impulse(1, 1, 1);
  probe.write(PLUMB_FIELD_ANGULAR_IMPULSE, body, {1, 1, 1});
  const Vec expected = turn * Vec(1, 0.5, 0.25).cwiseProduct(turn.conjugate() * impulse);
  c.expect(near(probe.angular_velocity(body), expected, 1e-4), "turned principal axes: omega is off by {:.6f} rad/s",
           (probe.angular_velocity(body) - expected).norm());
}

void particles(Conformance& c) {
  Probe probe(c, PLUMB_NEED_FORCES);
  PlumbBodyDesc desc = smooth(body_desc());
  desc.flags = PLUMB_BODY_NO_ROTATION;
  desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
  desc.mass = 2;
  const PlumbBody body = probe.body(desc);
  probe.write(PLUMB_FIELD_IMPULSE_AT_POINT, body, {2, 0, 0, 0, 1, 0});
  probe.step(60);
  c.expect(std::abs(probe.velocity(body).x() - 1) < 1e-5 && std::abs(probe.velocity(body).y() + 9.81) < 1e-3,
           "a particle must fall and fly");
  c.expect(probe.orientation(body).angularDistance(Eigen::Quaterniond::Identity()) < 1e-9, "a particle turned");
}

void state_writes(Conformance& c) {
  Probe probe(c, c.available(PLUMB_NEED_ROTATION), Vec::Zero());
  const bool turns = probe.declares(PLUMB_NEED_ROTATION);
  const PlumbBody body = turns ? brick(probe) : probe.free_body({5, 6, 7});
  const Eigen::Quaterniond q(Eigen::AngleAxisd(turns ? 1 : 0, Vec(1, 1, 0).normalized()));
  probe.write_pose(PLUMB_FIELD_POSE, body, {-1, -2, -3}, q);
  c.expect(near(probe.position(body), {-1, -2, -3}, 1e-6) && probe.orientation(body).angularDistance(q) < 1e-6,
           "a written pose is not read back");
  probe.write(PLUMB_FIELD_VELOCITY, body, {1, 2, 3, 0, 0, 0});
  c.expect(near(probe.velocity(body), {1, 2, 3}, 1e-6), "a written velocity is not read back");
  probe.step(60);
  c.expect(near(probe.position(body), {0, 0, 0}, 1e-4),
           "after 1 s the body is {:.5f} m from where its velocity takes it", probe.position(body).norm());
  float row[7];
  check(probe.world(), probe.world().read(PLUMB_FIELD_POSE, {&body, 1},
                                          Rows(reinterpret_cast<std::byte*>(row), 1, sizeof row, PLUMB_F32)));
  c.expect(std::abs(static_cast<double>(row[0]) - probe.position(body).x()) < 1e-5, "f32 rows differ from f64 rows");
}

void teleported_static(Conformance& c) {
  Probe probe(c, kPlainNeeds);
  const PlumbBody floor = probe.fixed(probe.box({5, 0.5, 5}), {0, -0.5, 0});
  const PlumbBody body = probe.dynamic(probe.sphere(0.5), {100, 5.5, 0});
  probe.write_pose(PLUMB_FIELD_POSE, floor, {100, 2.5, 0});
  probe.seconds(2);
  c.expect(std::abs(probe.position(body).y() - 3.5) < 0.05, "a static moved under a ball does not hold it: y = {:.3f}",
           probe.position(body).y());
}

void kinematic(Conformance& c) {
  Probe probe(c, kPlainNeeds | PLUMB_NEED_KINEMATIC);
  PlumbBodyDesc desc = body_desc(PLUMB_KINEMATIC);
  desc.shape = probe.box({2, 0.5, 2});
  const PlumbBody platform = probe.body(desc);
  const PlumbBody rider = probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 1, 0});
  probe.seconds(0.5);
  c.expect(near(probe.position(platform), {0, 0, 0}, 1e-9), "a kinematic body moved by itself");
  for (int i = 1; i <= 120; ++i) {  // half a metre a second sideways, with a gentle start
    const double t = i * kDt;
    const double x = t < 1 ? 0.25 * t * t : 0.25 + 0.5 * (t - 1);
    probe.write_pose(PLUMB_FIELD_KINEMATIC_TARGET, platform, {x, 0, 0});
    probe.step();
    c.expect(std::abs(probe.position(platform).x() - x) < 1e-5, "step {}: the target {:.5f} was not reached: {:.5f}", i,
             x, probe.position(platform).x());
  }
  c.expect(std::abs(probe.position(rider).x() - 0.75) < 0.05, "a platform moved .75 m carried its rider {:.3f} m",
           probe.position(rider).x());
  const Vec stopped = probe.position(platform);
  probe.seconds(0.5);
  c.expect(near(probe.position(platform), stopped, 1e-5),
           "without a new target the platform must stop; it went on {:.5f} m",
           (probe.position(platform) - stopped).norm());
}

void axis_locks(Conformance& c) {
  Probe probe(c, kPlainNeeds | PLUMB_NEED_AXIS_LOCKS);
  PlumbBodyDesc desc = dynamic_desc(probe.box({0.5, 0.5, 0.5}), {0, 3, 0}, {1, 0, 1});
  desc.angular_velocity = {1, 2, 3};
  desc.locks = PLUMB_LOCK_LINEAR_Z | PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Z;
  const PlumbBody body = probe.body(desc);
  probe.ground();
  probe.seconds(1.5);
  c.expect(std::abs(probe.position(body).z()) < 1e-3, "locked along z, it moved {:.5f} m", probe.position(body).z());
  c.expect(probe.position(body).x() > 0.3, "free along x, it moved only {:.5f} m", probe.position(body).x());
  const Vec up = probe.orientation(body) * Vec::UnitY();
  c.expect(up.y() > 1 - 1e-4, "locked about x and z, it tilted: its y axis is at {:.5f}", up.y());
}

void sensors(Conformance& c) {
  Probe probe(c, kPlainNeeds | PLUMB_NEED_SENSORS);
  PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
  desc.shape = probe.box({1, 1, 1});
  desc.flags = PLUMB_BODY_SENSOR;
  const PlumbBody sensor = probe.body(desc);
  const PlumbBody ball = probe.dynamic(probe.sphere(0.5), {0, 3, 0});
  int entered = 0, left = 0;
  for (int i = 0; i < 120; ++i) {
    probe.step();
    for (const PlumbEvent& event : probe.events()) {
      if (event.type == PLUMB_EVENT_SENSOR_ENTER && event.body_a == sensor && event.body_b == ball) ++entered;
      if (event.type == PLUMB_EVENT_SENSOR_LEAVE && event.body_a == sensor && event.body_b == ball) ++left;
    }
  }
  c.expect(entered == 1 && left == 1, "a ball that fell through a sensor entered {} times and left {} times", entered,
           left);
  c.expect(std::abs(probe.velocity(ball).y() + 19.62) < 0.01, "a sensor slowed the ball down to {:.3f} m/s",
           probe.velocity(ball).y());
}

void filters(Conformance& c) {
  struct Case {
    PlumbFilter a, b;
    const char* what;
  };
  const Case cases[] = {{{1, ~0u, 0, 0}, {1, ~0u, 0, 0}, "default"},
                        {{1, 2, 0, 0}, {2, 1, 0, 0}, "each in the other's mask"},
                        {{1, 2, 0, 0}, {2, 2, 0, 0}, "one not in the other's mask"},
                        {{1, 1, 0, 0}, {2, 1, 0, 0}, "the other not in the one's mask"},
                        {{1, 2, 7, 0}, {1, 2, 7, 0}, "same positive group against masks"},
                        {{1, ~0u, -3, 0}, {1, ~0u, -3, 0}, "same negative group against masks"},
                        {{1, ~0u, -3, 0}, {1, ~0u, -4, 0}, "different groups"},
                        {{1u << 31, 1u << 31, 0, 0}, {1u << 31, 1u << 31, 0, 0}, "highest bit"}};
  for (const Case& one : cases) {
    Probe probe(c, kPlainNeeds | PLUMB_NEED_FILTERS);
    PlumbBodyDesc floor = body_desc(PLUMB_STATIC);
    floor.shape = probe.box({5, 0.5, 5});
    floor.filter = one.a;
    PlumbBodyDesc ball = dynamic_desc(probe.sphere(0.5), {0, 1.2, 0});
    ball.filter = one.b;
    probe.body(floor);
    const PlumbBody body = probe.body(ball);
    probe.seconds(1);
    const bool held = probe.position(body).y() > 0.5;
    c.expect(held == may_touch(one.a, one.b), "filter case \"{}\": they {}", one.what, held ? "touch" : "do not touch");
  }
}

/// Of 20 balls of 300 m/s, how many pass a wall of .1 m.
int passed_through(Conformance& c, std::uint32_t flags) {
  int passed = 0;
  for (int i = 0; i < 20; ++i) {
    Probe probe(c, kPlainNeeds | PLUMB_NEED_CCD, Vec::Zero());
    probe.fixed(probe.box({0.05, 5, 5}), {0, 0, 0});
    PlumbBodyDesc desc = dynamic_desc(probe.sphere(0.1), {-20 - 0.25 * i, 0, 0}, {300, 0, 0});
    desc.flags = flags;
    const PlumbBody bullet = probe.body(desc);
    probe.seconds(0.5);
    if (probe.position(bullet).x() > 0.2) ++passed;
  }
  return passed;
}

void continuous(Conformance& c) {
  const PlumbDegree claim = c.require(PLUMB_CAP_NEED, 5, 0, "PLUMB_NEED_CCD");
  const int passed = passed_through(c, PLUMB_BODY_CCD), unasked = passed_through(c, 0);
  const bool better = claim == PLUMB_APPROXIMATE && passed < unasked;  // not each is caught, but it makes a difference
  c.expect(passed == 0 || better, "{} of 20 bullets of 300 m/s passed a wall of .1 m, {} without PLUMB_BODY_CCD",
           passed, unasked);
}

}  // namespace

std::span<const Check> body_checks() {
  static constexpr Check checks[] = {
      {"bodies.fall", "a free body falls by g and keeps its course", &free_fall},
      {"bodies.gravity", "gravity scales, and gravity changed while running", &gravity},
      {"bodies.damping", "damping c means dv/dt = -c v", &damping},
      {"bodies.forces", "forces, torques and impulses, also at points", &forces},
      {"bodies.centre_of_mass", "a centre of mass away from the body's origin", &centre_of_mass},
      {"bodies.principal_axes", "inertia given in turned axes", &principal_axes},
      {"bodies.particles", "bodies without shape and rotation", &particles},
      {"bodies.state", "pose and velocity written and read back", &state_writes},
      {"bodies.teleport", "a static body moved by writing its pose", &teleported_static},
      {"bodies.kinematic", "kinematic targets are reached in one step and carry what stands on them", &kinematic},
      {"bodies.axis_locks", "locked axes stay, free ones do not", &axis_locks},
      {"bodies.sensors", "sensors see once and push nothing", &sensors},
      {"bodies.filters", "category, mask and group by the rule of PlumbFilter", &filters},
      {"bodies.ccd", "a fast ball does not pass a thin wall", &continuous},
  };
  return checks;
}

}  // namespace plumb::harness::conform
