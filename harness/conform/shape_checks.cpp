// Shapes and pairs of shapes: every claim of the matrix is dropped, pushed and looked at.
#include "conform/probe.hpp"
#include "plumb/backend/names.hpp"
#include "referee/mass.hpp"

namespace plumb::harness::conform {
namespace {

using backend::motion_name;
using backend::shape_name;

/// Height of the standard shape's top above its origin.
double top_of(PlumbShapeType type) { return type == PLUMB_PLANE || type == PLUMB_HEIGHT_FIELD ? 0.0 : 0.5; }

/// Lays a capsule on its side: upright it would tip over.
Eigen::Quaterniond resting_orientation(PlumbShapeType type) {
  return type == PLUMB_CAPSULE ? Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vec::UnitZ()))
                               : Eigen::Quaterniond::Identity();
}
double resting_height(PlumbShapeType type) { return type == PLUMB_CAPSULE ? 0.25 : 0.5; }

bool has_flat_top(PlumbShapeType type) { return type != PLUMB_SPHERE && type != PLUMB_CAPSULE; }

void declared_shapes(Conformance& c) {
  for (PlumbShapeType type = 0; type < PLUMB_SHAPE_TYPE_COUNT; ++type)
    for (PlumbMotion motion = 0; motion < PLUMB_MOTION_COUNT; ++motion) {
      const PlumbDegree claim = c.backend().capability(PLUMB_CAP_SHAPE, type, motion);
      bool made = false;
      std::string why;
      try {
        const PlumbNeeds needs = c.available(kPlainNeeds | PLUMB_NEED_KINEMATIC);
        Probe probe(c, needs);
        PlumbBodyDesc desc = dynamic_desc(probe.standard(type), {0, 0, 0});
        desc.motion = motion;
        if ((needs & PLUMB_NEED_FRICTION) == 0) desc.material.friction = 0;
        if ((needs & PLUMB_NEED_ROTATION) == 0) desc.flags = PLUMB_BODY_NO_ROTATION;
        if (type == PLUMB_TRIANGLE_MESH || type == PLUMB_HEIGHT_FIELD) {
          desc.mass_mode = PLUMB_MASS_EXPLICIT;
          desc.mass = 1000;
          desc.inertia = {167, 167, 167};
        }
        (void)probe.body(desc);
        probe.step();
        made = true;
      } catch (const Error& error) {
        why = error.what();
      }
      c.expect(made == (claim != PLUMB_NONE), "{} {}: declared {}, but {} ({})", motion_name(motion), shape_name(type),
               claim, made ? "it can be made" : "it cannot be made", why);
    }
}

PlumbBodyDesc probe_body(Probe& probe, PlumbShapeType type, const Vec& position) {
  PlumbBodyDesc desc = dynamic_desc(probe.standard(type), position);
  const Eigen::Quaterniond q = resting_orientation(type);
  desc.pose.orientation = {q.x(), q.y(), q.z(), q.w()};
  return desc;
}

/// Drops a dynamic `a` from 2 cm onto a static `b`.
void drop_pair(Conformance& c, PlumbShapeType a, PlumbShapeType b) {
  const PlumbDegree claim = c.backend().capability(PLUMB_CAP_PAIR, a, b);
  Probe probe(c, kPlainNeeds);
  const double rest = top_of(b) + resting_height(a);
  PlumbBodyDesc under = body_desc(PLUMB_STATIC);
  under.shape = probe.standard(b);
  if (b == PLUMB_CAPSULE) {  // its side up, so that its top is at .25
    const Eigen::Quaterniond q = resting_orientation(b);
    under.pose.orientation = {q.x(), q.y(), q.z(), q.w()};
    under.pose.position.y = 0.25;
  }
  probe.body(under);
  const PlumbBody body = probe.body(probe_body(probe, a, {0, rest + 0.02, 0}));
  probe.seconds(0.4);  // in free fall it would be .79 m lower
  const double height = probe.position(body).y();
  const bool held = height > rest - 0.3;
  if (claim == PLUMB_NONE) {
    c.expect(!held, "dynamic {} on static {}: declared none, but they collide", shape_name(a), shape_name(b));
    return;
  }
  c.expect(held, "dynamic {} on static {}: declared {}, but it fell to {:.3f} m (rest would be {:.3f})", shape_name(a),
           shape_name(b), claim, height, rest);
  if (!held || claim == PLUMB_APPROXIMATE || !has_flat_top(b)) return;
  probe.seconds(1.6);
  const double settled = probe.position(body).y();
  c.expect(std::abs(settled - rest) < 0.05, "dynamic {} on static {}: rests at {:.3f} m instead of {:.3f}",
           shape_name(a), shape_name(b), settled, rest);
  c.expect(probe.velocity(body).norm() < 0.1, "dynamic {} on static {}: still moves at {:.3f} m/s after 2 s",
           shape_name(a), shape_name(b), probe.velocity(body).norm());
}

void static_pairs(Conformance& c) {
  c.require_needs(kPlainNeeds);
  for (PlumbShapeType a = 0; a < PLUMB_SHAPE_TYPE_COUNT; ++a)
    for (PlumbShapeType b = 0; b < PLUMB_SHAPE_TYPE_COUNT; ++b)
      if (c.backend().capability(PLUMB_CAP_SHAPE, a, PLUMB_DYNAMIC) != PLUMB_NONE &&
          c.backend().capability(PLUMB_CAP_SHAPE, b, PLUMB_STATIC) != PLUMB_NONE)
        drop_pair(c, a, b);
}

/// Sends a dynamic `a` at 2 m/s into a dynamic `b` at rest, in no gravity.
void push_pair(Conformance& c, PlumbShapeType a, PlumbShapeType b) {
  const PlumbDegree claim = c.backend().capability(PLUMB_CAP_PAIR, a, b);
  Probe probe(c, kPlainNeeds, Vec::Zero());
  const PlumbBody target = probe.body(probe_body(probe, b, {0, 0, 0}));
  PlumbBodyDesc desc = probe_body(probe, a, {-1.5, 0, 0});
  desc.linear_velocity.x = 2;
  const PlumbBody bullet = probe.body(desc);
  probe.seconds(2);
  const Vec pushed = probe.velocity(target);
  const bool touched = pushed.norm() > 0.1;
  c.expect(touched == (claim != PLUMB_NONE),
           "dynamic {} into dynamic {}: declared {}, but the target moves at {:.3f} m/s", shape_name(a), shape_name(b),
           claim, pushed.norm());
  if (touched && claim != PLUMB_NONE)
    c.expect(probe.position(bullet).x() < probe.position(target).x(), "dynamic {} into dynamic {}: it passed through",
             shape_name(a), shape_name(b));
}

void dynamic_pairs(Conformance& c) {
  c.require_needs(kPlainNeeds);
  for (PlumbShapeType a = 0; a < PLUMB_SHAPE_TYPE_COUNT; ++a)
    for (PlumbShapeType b = 0; b < PLUMB_SHAPE_TYPE_COUNT; ++b)
      if (c.backend().capability(PLUMB_CAP_SHAPE, a, PLUMB_DYNAMIC) != PLUMB_NONE &&
          c.backend().capability(PLUMB_CAP_SHAPE, b, PLUMB_DYNAMIC) != PLUMB_NONE)
        push_pair(c, a, b);
}

/// An angular impulse must turn each shape by its own inertia, which is also what the mass field says.
void inertia(Conformance& c) {
  c.require_needs(PLUMB_NEED_ROTATION | PLUMB_NEED_FORCES);
  for (const PlumbShapeType type :
       {PLUMB_SPHERE, PLUMB_BOX, PLUMB_CAPSULE, PLUMB_CYLINDER, PLUMB_CONVEX_HULL, PLUMB_COMPOUND}) {
    if (c.backend().capability(PLUMB_CAP_SHAPE, type, PLUMB_DYNAMIC) == PLUMB_NONE) continue;
    for (int axis = 0; axis < 3; ++axis) {
      Probe probe(c, PLUMB_NEED_ROTATION | PLUMB_NEED_FORCES, Vec::Zero());
      PlumbBodyDesc desc = dynamic_desc(probe.standard(type), {0, 0, 0});
      desc.material.friction = 0;
      const PlumbBody body = probe.body(desc);
      const std::vector<double> mass = probe.read(PLUMB_FIELD_MASS, body);
      const Eigen::Quaterniond principal(mass[10], mass[7], mass[8], mass[9]);
      const Eigen::Matrix3d tensor = principal * Eigen::DiagonalMatrix<double, 3>(mass[4], mass[5], mass[6]) *
                                     principal.conjugate().toRotationMatrix();
      const Vec impulse = 10 * Vec::Unit(axis);
      probe.write(PLUMB_FIELD_ANGULAR_IMPULSE, body, {impulse.x(), impulse.y(), impulse.z()});
      const Vec expected = tensor.inverse() * impulse;
      const Vec omega = probe.angular_velocity(body);
      c.expect((omega - expected).norm() < 1e-4 * expected.norm(),
               "{}: an impulse of 10 N m s about axis {} gives {:.6f} rad/s instead of {:.6f}", shape_name(type), axis,
               omega.norm(), expected.norm());
    }
  }
}

/// Mass, centre and inertia of a solid without symmetry, as a hull and as a closed mesh, against the referee's.
void mass_of_solids(Conformance& c) {
  c.require_needs(kPlainNeeds);
  c.require(PLUMB_CAP_FIELD_READ, PLUMB_FIELD_MASS, 0, "reading of masses");
  // A pyramid over a trapezoid, its tip to one side.
  static constexpr double kVertices[] = {-1, 0, -0.5, 1, 0, -0.5, 0.4, 0, 0.7, -0.6, 0, 0.7, 0.3, 1.2, 0.1};
  static constexpr std::uint32_t kTriangles[] = {0, 1, 2, 0, 2, 3, 1, 0, 4, 2, 1, 4, 3, 2, 4, 0, 3, 4};
  for (const PlumbShapeType type : {PLUMB_CONVEX_HULL, PLUMB_TRIANGLE_MESH}) {
    if (c.backend().capability(PLUMB_CAP_SHAPE, type, PLUMB_DYNAMIC) == PLUMB_NONE) continue;
    PlumbShapeDesc shape = shape_desc(type);
    shape.vertices = kVertices;
    shape.vertex_count = 5;
    shape.indices = kTriangles;
    shape.triangle_count = 6;
    const referee::ShapePtr known = referee::Shape::make(shape);
    for (const PlumbMassMode mode : {PLUMB_MASS_FROM_DENSITY, PLUMB_MASS_FROM_TOTAL}) {
      Probe probe(c, kPlainNeeds, Vec::Zero());
      PlumbBodyDesc desc = dynamic_desc(probe.shape(shape), {1, 2, 3});
      desc.mass_mode = mode;
      desc.density = 700;
      desc.mass = 25;
      const std::vector<double> row = probe.read(PLUMB_FIELD_MASS, probe.body(desc));
      const referee::Mass told = referee::mass_of_row(std::span<const double, 11>(row.data(), 11)),
                          truth = referee::mass_of(desc, known.get());
      c.expect(std::abs(told.mass - truth.mass) < 1e-5 * truth.mass, "{}: the mass is {:.6f} kg instead of {:.6f}",
               shape_name(type), told.mass, truth.mass);
      c.expect((told.centre - truth.centre).norm() < 1e-5,
               "{}: the centre of mass is {:.6f} m beside where it should be", shape_name(type),
               (told.centre - truth.centre).norm());
      c.expect((told.inertia - truth.inertia).norm() < 1e-4 * truth.inertia.norm(),
               "{}: the inertia differs by {:.6f} of itself", shape_name(type),
               (told.inertia - truth.inertia).norm() / truth.inertia.norm());
    }
  }
}

}  // namespace

std::span<const Check> shape_checks() {
  static constexpr Check checks[] = {
      {"shapes.declared", "a shape can be made exactly where the matrix says so", &declared_shapes},
      {"shapes.inertia", "angular impulses turn bodies by the inertia of their shape", &inertia},
      {"shapes.mass", "mass, centre and inertia of hulls and closed meshes against the referee", &mass_of_solids},
      {"pairs.static", "every dynamic shape dropped on every static one", &static_pairs},
      {"pairs.dynamic", "every dynamic shape pushed into every other", &dynamic_pairs},
  };
  return checks;
}

}  // namespace plumb::harness::conform
