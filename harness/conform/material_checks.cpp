// Materials: the coefficients of a pair are the same in every backend.
#include <bit>

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
  const double off = c.is_exact(PLUMB_CAP_NEED, std::countr_zero(PLUMB_NEED_RESTITUTION)) ? 0.05 : 0.15;
  for (const auto& [a, b] : {std::pair{0.0, 0.0}, {0.5, 0.5}, {0.8, 0.2}, {0.2, 0.8}, {1.0, 0.0}}) {
    const double expected = std::max(a, b);
    const double got = bounce(c, a, b);
    c.expect(std::abs(got - expected) < off, "restitution {} on {}: rebounds with {:.4f} instead of {:.4f}", a, b, got,
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

constexpr PlumbNeeds kRollingNeeds = kPlainNeeds | PLUMB_NEED_ROLLING_FRICTION;

/// m/s of the speed that a second of rolling friction takes, .7 or .9 m/s.
double rolling_tolerance(const Conformance& c) {
  return c.is_exact(PLUMB_CAP_NEED, std::countr_zero(PLUMB_NEED_ROLLING_FRICTION)) ? 0.03 : 0.15;
}

/// A ball of radius .5 m on level ground, of friction against rolling and spinning.
struct ResistingBall {
  static constexpr double kRadius = 0.5, kRolling = 0.05, kSpinning = 0.02;

  /// What resists is the ball or the ground; the other one has less.
  ResistingBall(Conformance& c, bool by_ground, double speed, double spin) : probe(c, kRollingNeeds) {
    PlumbBodyDesc floor = body_desc(PLUMB_STATIC), ball = dynamic_desc(probe.sphere(kRadius), {0, kRadius, 0});
    floor.shape = probe.box({100, 1, 100});
    floor.pose.position.y = -1;
    PlumbBodyDesc& resists = by_ground ? floor : ball;
    PlumbBodyDesc& other = by_ground ? ball : floor;
    resists.rolling_friction = kRolling;
    resists.spinning_friction = kSpinning;
    other.rolling_friction = kRolling / 3;
    other.spinning_friction = kSpinning / 3;
    ball.mass_mode = PLUMB_MASS_FROM_TOTAL;
    ball.mass = 3;
    ball.linear_velocity.x = speed;
    ball.angular_velocity = {0, spin, -speed / kRadius};
    probe.body(floor);
    body = probe.body(ball);
  }
  double speed() { return probe.velocity(body).x(); }
  double spin() { return probe.read(PLUMB_FIELD_VELOCITY, body)[4]; }

  Probe probe;
  PlumbBody body = 0;
};

/// a = rho g / (r (1 + 2 / 5)), until it stops.
void ball_rolls(Conformance& c, bool by_ground) {
  ResistingBall ball(c, by_ground, 2, 0);
  ball.probe.seconds(1);
  const double speed = ball.speed(), truth = 2 - ball.kRolling * kG / (ball.kRadius * 1.4);
  c.expect(std::abs(speed - truth) < rolling_tolerance(c),
           "a ball of 2 m/s and a rolling friction of .05 m has {:.4f} m/s after 1 s instead of {:.4f}", speed, truth);
  ball.probe.seconds(4);
  c.expect(std::abs(ball.speed()) < 0.02, "a ball against rolling friction still has {:.4f} m/s after 5 s",
           ball.speed());
}

void rolling_friction(Conformance& c) {
  c.require_needs(kRollingNeeds);
  ball_rolls(c, false);
}

/// dw / dt = sigma g / (2 / 5 r^2), and of two bodies the larger friction counts: engines that know it approximately
/// may have neither.
void spinning_friction(Conformance& c) {
  c.require_needs(kRollingNeeds);
  c.require_exact(PLUMB_CAP_NEED, std::countr_zero(PLUMB_NEED_ROLLING_FRICTION), 0, "spinning friction");
  ball_rolls(c, true);
  for (const bool by_ground : {false, true}) {
    ResistingBall ball(c, by_ground, 0, 4);
    ball.probe.seconds(1);
    const double spin = ball.spin(), truth = 4 - ball.kSpinning * kG / (0.4 * ball.kRadius * ball.kRadius);
    c.expect(std::abs(spin - truth) < 0.1,
             "a ball of 4 rad/s and a spinning friction of .02 m has {:.4f} rad/s after 1 s instead of {:.4f}", spin,
             truth);
  }
}

void written_rolling_friction(Conformance& c) {
  c.require_needs(kRollingNeeds);
  c.require(PLUMB_CAP_FIELD_WRITE, PLUMB_FIELD_ROLLING_FRICTION, 0, "writing of rolling friction");
  Probe probe(c, kRollingNeeds);
  probe.ground();
  PlumbBodyDesc desc = dynamic_desc(probe.sphere(0.5), {0, 0.5, 0}, {2, 0, 0});
  desc.angular_velocity.z = -4;
  desc.spinning_friction = 0.25;
  desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
  desc.mass = 3;
  const PlumbBody ball = probe.body(desc);
  c.expect(probe.read(PLUMB_FIELD_ROLLING_FRICTION, ball)[1] == 0.25, "a spinning friction is not read back");
  probe.seconds(0.5);
  const double free = probe.velocity(ball).x();
  probe.write(PLUMB_FIELD_ROLLING_FRICTION, ball, {0.0625, 0});
  c.expect(probe.read(PLUMB_FIELD_ROLLING_FRICTION, ball)[0] == 0.0625, "a written rolling friction is not read back");
  probe.seconds(1);
  const double slowed = free - probe.velocity(ball).x(), truth = 0.0625 * kG / 0.7;
  c.expect(std::abs(slowed - truth) < rolling_tolerance(c),
           "rolling friction was set in a contact, and a ball slowed by {:.4f} m/s in 1 s instead of {:.4f}", slowed,
           truth);
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

/// A square about the origin of 2 x 2 cells whose triangles have, by the side of x on which they lie, one of two
/// materials.
struct HalvedSurface {
  static constexpr std::uint32_t kCells = 2;
  static constexpr double kSide = 8;  // m: nothing here slides over an edge, at which an engine may catch it

  explicit HalvedSurface(PlumbShapeType type) : desc(shape_desc(type)) {
    constexpr std::uint32_t across = kCells + 1;
    for (std::uint32_t row = 0; row < across; ++row)
      for (std::uint32_t column = 0; column < across; ++column)
        corners.insert(corners.end(), {kSide * (column - kCells / 2.0), 0, kSide * (row - kCells / 2.0)});
    for (std::uint32_t row = 0; row < kCells; ++row)
      for (std::uint32_t column = 0; column < kCells; ++column) {
        const std::uint32_t here = row * across + column;
        indices.insert(indices.end(), {here, here + across, here + 1, here + 1, here + across, here + across + 1});
        of.insert(of.end(), 2, column < kCells / 2 ? 0U : PLUMB_BODY_MATERIAL);
      }
    desc.vertices = corners.data();
    desc.vertex_count = across * across;
    desc.indices = indices.data();
    desc.triangle_count = 2 * kCells * kCells;
    desc.heights = heights.data();
    desc.rows = desc.columns = across;
    desc.spacing = {kSide, 0, kSide};
    desc.materials = &material;
    desc.material_count = 1;
    desc.triangle_materials = of.data();
  }

  std::vector<double> corners, heights = std::vector<double>((kCells + 1) * (kCells + 1), 0.0);
  std::vector<std::uint32_t> indices, of;
  PlumbMaterial material{};  ///< of triangles at x < 0; elsewhere the body's counts
  PlumbShapeDesc desc;
};

void triangle_material(Conformance& c, PlumbShapeType type) {
  c.require(PLUMB_CAP_TRIANGLE_MATERIAL, type, 0, "materials by triangle");
  HalvedSurface surface(type);
  surface.material.restitution = 0.8;  // and no friction
  Probe probe(c, kPlainNeeds | PLUMB_NEED_RESTITUTION);
  PlumbBodyDesc ground = body_desc(PLUMB_STATIC);
  ground.shape = probe.shape(surface.desc);
  ground.material.friction = 0.5;
  probe.body(ground);
  const PlumbShape cube = probe.box({0.25, 0.25, 0.25}), ball = probe.sphere(0.25);
  const PlumbBody on_ice = probe.dynamic(cube, {-6.5, 0.25, -6.5}, {1, 0, 0});
  const PlumbBody on_body = probe.dynamic(cube, {1.5, 0.25, -6.5}, {1, 0, 0});
  const PlumbBody bounces = probe.dynamic(ball, {-2, 0.499, -2}, {0, -5, 0});
  const PlumbBody lies = probe.dynamic(ball, {6, 0.499, -2}, {0, -5, 0});
  probe.step(24, 1.0 / 240);
  const double up = probe.velocity(bounces).y(), dead = probe.velocity(lies).y();
  c.expect(up > 3, "a ball of 5 m/s leaves triangles of restitution .8 with {:.3f} m/s", up);
  c.expect(std::abs(dead) < 0.3, "a ball of 5 m/s leaves triangles of the body's restitution 0 with {:.3f} m/s", dead);
  probe.seconds(1);
  c.expect(std::abs(probe.velocity(on_ice).x() - 1) < 0.05, "on triangles without friction a cube slowed to {:.3f} m/s",
           probe.velocity(on_ice).x());
  c.expect(std::abs(probe.velocity(on_body).x()) < 0.05,
           "on triangles of the body's friction a cube still slides at {:.3f} m/s", probe.velocity(on_body).x());
}
void mesh_material(Conformance& c) { triangle_material(c, PLUMB_TRIANGLE_MESH); }
void field_material(Conformance& c) { triangle_material(c, PLUMB_HEIGHT_FIELD); }

/// What cannot be is refused, and the world goes on.
void wrong_triangle_materials(Conformance& c) {
  c.require(PLUMB_CAP_TRIANGLE_MATERIAL, PLUMB_TRIANGLE_MESH, 0, "materials by triangle");
  Probe probe(c, kPlainNeeds);
  const auto is_refused = [&](PlumbResult expected, const char* what, auto&& spoil) {
    HalvedSurface surface(PLUMB_TRIANGLE_MESH);
    spoil(surface);
    PlumbShape shape = 0;
    const PlumbResult result = probe.world().create_shapes({&surface.desc, 1}, {&shape, 1});
    c.expect(result == expected, "{}: answered with {} instead of {}", what, result, expected);
  };
  is_refused(PLUMB_E_INVALID_ARGUMENT, "a row that is not there", [](HalvedSurface& s) { s.of[7] = 1; });
  is_refused(PLUMB_E_INVALID_ARGUMENT, "no rows", [](HalvedSurface& s) { s.desc.materials = nullptr; });
  is_refused(PLUMB_E_INVALID_ARGUMENT, "no numbers", [](HalvedSurface& s) { s.desc.triangle_materials = nullptr; });
  is_refused(PLUMB_E_INVALID_ARGUMENT, "friction below 0", [](HalvedSurface& s) { s.material.friction = -1; });
  is_refused(PLUMB_E_INVALID_ARGUMENT, "a triangle that runs", [](HalvedSurface& s) {
    s.material.surface_velocity = {1, 0, 0};
  });
  is_refused(PLUMB_E_NOT_DECLARED, "restitution without its need",
             [](HalvedSurface& s) { s.material.restitution = 0.5; });
  is_refused(PLUMB_OK, "none of them", [](HalvedSurface&) {});
}

}  // namespace

std::span<const Check> material_checks() {
  static constexpr Check checks[] = {
      {"materials.friction", "the pair's friction is sqrt(mu1 mu2)", &friction},
      {"materials.restitution", "the pair's restitution is max(e1, e2)", &restitution},
      {"materials.written", "a material changed while in contact", &written_material},
      {"materials.surface_velocity", "a conveyor belt", &surface_velocity},
      {"materials.rolling_friction", "a ball that rolls to a stop", &rolling_friction},
      {"materials.spinning_friction", "a ball that spins to a stop, and the larger of two frictions",
       &spinning_friction},
      {"materials.rolling_friction_written", "rolling friction changed while in contact", &written_rolling_friction},
      {"materials.children", "a compound's child with its own material", &child_material},
      {"materials.mesh", "a mesh whose triangles have their own material", &mesh_material},
      {"materials.height_field", "a height field whose triangles have their own material", &field_material},
      {"materials.refused", "materials by triangle that cannot be", &wrong_triangle_materials},
  };
  return checks;
}

}  // namespace plumb::harness::conform
