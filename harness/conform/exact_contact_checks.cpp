// Closed forms at tight tolerances: friction, restitution, running surfaces, and what contacts say of themselves. Asked
// of what is claimed as native or emulated.
#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace exact {
namespace {

constexpr double kG = 9.81, kDt = 1.0 / 60;

/// How fast a sliding cube slows down, m/s2: between two steps of one slide, so that neither its beginning nor its end
/// counts. heading: of the slide, in the plane of the floor.
double deceleration(Conformance& c, double a, double b, const Vec& heading) {
  Probe probe(c, kPlainNeeds);
  PlumbBodyDesc floor = body_desc(PLUMB_STATIC);
  floor.shape = probe.box({100, 1, 100});
  floor.pose.position.y = -1;
  floor.material.friction = b;
  probe.body(floor);
  PlumbBodyDesc cube = dynamic_desc(probe.box({0.5, 0.25, 0.5}), {0, 0.25, 0});
  cube.material.friction = a;
  const PlumbBody body = probe.body(cube);
  probe.seconds(0.5);
  const Vec speed = 5 * heading;
  probe.write(PLUMB_FIELD_VELOCITY, body, {speed.x(), 0, speed.z(), 0, 0, 0});
  probe.step(6);
  const double first = probe.velocity(body).dot(heading);
  probe.step(24);
  return (first - probe.velocity(body).dot(heading)) / (24 * kDt);
}

void friction(Conformance& c) {
  c.require_needs(kPlainNeeds);
  c.require_exact(PLUMB_CAP_NEED, need_index(PLUMB_NEED_FRICTION), 0, "friction");
  for (const auto& [a, b, degrees] :
       {std::tuple{0.4, 0.4, 0.0}, {0.9, 0.1, 0.0}, {0.2, 0.8, 30.0}, {0.5, 0.5, 45.0}, {0.7, 0.7, 100.0}}) {
    const double angle = degrees * M_PI / 180, exact = std::sqrt(a * b) * kG,
                 got = deceleration(c, a, b, {std::cos(angle), 0, std::sin(angle)});
    c.expect(std::abs(got - exact) < 0.015 * exact,
             "friction {} on {}, heading {} degrees: slows down by {:.4f} m/s2 instead of {:.4f}", a, b, degrees, got,
             exact);
  }
}

/// Rebound over impact of a ball that meets a floor at 5 m/s, without gravity.
void restitution(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_RESTITUTION;
  c.require_needs(needs);
  c.require_exact(PLUMB_CAP_NEED, need_index(PLUMB_NEED_RESTITUTION), 0, "restitution");
  for (const auto& [a, b] : {std::pair{0.5, 0.1}, {0.3, 0.8}, {0.9, 0.0}, {1.0, 1.0}}) {
    Probe probe(c, needs, Vec::Zero());
    PlumbBodyDesc floor = body_desc(PLUMB_STATIC);
    floor.shape = probe.box({10, 1, 10});
    floor.pose.position.y = -1;
    floor.material.restitution = b;
    probe.body(floor);
    // As materials.restitution: it meets the floor 1 mm deep, so that neither speculation nor recovery has a part.
    PlumbBodyDesc ball = dynamic_desc(probe.sphere(0.5), {0, 0.999, 0}, {0, -5, 0});
    ball.material.restitution = a;
    const PlumbBody body = probe.body(ball);
    probe.step(18, 1.0 / 120);
    const double got = probe.velocity(body).y() / 5, exact = std::max(a, b);
    c.expect(std::abs(got - exact) < 0.015, "restitution {} on {}: rebounds with {:.4f} instead of {}", a, b, got,
             exact);
  }
}

/// The surface runs in the body's own axes.
void surface_velocity(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SURFACE_VELOCITY;
  c.require_needs(needs);
  c.require_exact(PLUMB_CAP_NEED, need_index(PLUMB_NEED_SURFACE_VELOCITY), 0, "surface velocity");
  Probe probe(c, needs);
  PlumbBodyDesc belt = body_desc(PLUMB_STATIC);
  belt.shape = probe.box({50, 1, 50});
  belt.pose.position.y = -1;
  const double angle = 0.6;
  belt.pose.orientation = {0, std::sin(angle / 2), 0, std::cos(angle / 2)};
  belt.material.surface_velocity = {2, 0, 0};
  probe.body(belt);
  const PlumbBody body = probe.dynamic(probe.box({0.5, 0.25, 0.5}), {0, 0.25, 0});
  probe.seconds(2);
  const Vec exact(2 * std::cos(angle), 0, -2 * std::sin(angle));
  c.expect((probe.velocity(body) - exact).norm() < 0.02,
           "on a turned belt of 2 m/s a cube moves at ({:.4f}, {:.4f}) instead of ({:.4f}, {:.4f}) m/s",
           probe.velocity(body).x(), probe.velocity(body).z(), exact.x(), exact.z());
}

/// One contact of a ball at rest: where it is, which way it points, and that it carries the weight.
void resting_ball(Conformance& c) {
  const PlumbNeeds impulses = PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES;
  c.require_needs(kPlainNeeds | impulses);
  c.require_exact(PLUMB_CAP_NEED, need_index(PLUMB_NEED_CONTACT_IMPULSES), 0, "contact impulses");
  c.require_exact(PLUMB_CAP_PAIR, PLUMB_SPHERE, PLUMB_BOX, "spheres on boxes");
  Probe probe(c, kPlainNeeds | impulses);
  const PlumbBody floor = probe.ground();
  const PlumbBody ball = probe.dynamic(probe.sphere(0.5), {0.3, 0.5, -0.2});
  probe.seconds(2);
  const double weight = 1000 * M_PI / 6 * kG * kDt;
  double impulse = 0;
  for (const PlumbContact& contact : probe.contacts()) {
    const double way = contact.body_a == floor && contact.body_b == ball ? 1 : -1;
    c.expect((way * vec(contact.normal) - Vec::UnitY()).norm() < 1e-3, "the normal under a ball leans by {:.5f}",
             (way * vec(contact.normal) - Vec::UnitY()).norm());
    const Vec off = vec(contact.position) - Vec(probe.position(ball).x(), 0, probe.position(ball).z());
    c.expect(std::hypot(off.x(), off.z()) < 2e-3 && std::abs(off.y()) < 0.02,
             "the contact under a ball is {:.5f} m beside its lowest point and {:.5f} m above the floor",
             std::hypot(off.x(), off.z()), off.y());
    impulse += contact.normal_impulse;
  }
  c.expect(std::abs(impulse - weight) < 0.005 * weight,
           "the floor gives {:.4f} N s a step to a ball that weighs {:.4f}", impulse, weight);
}

/// A ball that begins 1 cm deep in a floor: the geometry of the first step is that of its beginning.
void depth(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_CONTACTS;
  c.require_needs(needs);
  c.require_exact(PLUMB_CAP_NEED, need_index(PLUMB_NEED_CONTACTS), 0, "contacts");
  c.require_exact(PLUMB_CAP_PAIR, PLUMB_SPHERE, PLUMB_BOX, "spheres on boxes");
  Probe probe(c, needs, Vec::Zero());
  probe.ground();
  probe.dynamic(probe.sphere(0.5), {0, 0.49, 0});
  probe.step();
  const auto contacts = probe.contacts();
  c.expect(contacts.size() == 1, "a ball that is 1 cm deep in a floor has {} contacts", contacts.size());
  for (const PlumbContact& contact : contacts)
    c.expect(std::abs(contact.depth - 0.01) < 1e-3, "a ball that is 1 cm deep in a floor has a contact {:.5f} m deep",
             contact.depth);
}

/// What friction took from a sliding cube is what its contacts say.
void tangent_impulses(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES;
  c.require_needs(needs);
  c.require_exact(PLUMB_CAP_NEED, need_index(PLUMB_NEED_CONTACT_IMPULSES), 0, "contact impulses");
  Probe probe(c, needs);
  const PlumbBody floor = probe.ground();
  const PlumbBody cube = probe.dynamic(probe.box({0.5, 0.25, 0.5}), {0, 0.25, 0});
  const double mass = 500;
  probe.seconds(0.5);
  probe.write(PLUMB_FIELD_VELOCITY, cube, {4, 0, 3, 0, 0, 0});
  probe.step(6);
  Vec told = Vec::Zero();
  const Vec before = probe.velocity(cube);
  for (int i = 0; i < 12; ++i) {
    probe.step();
    for (const PlumbContact& contact : probe.contacts())
      told += (contact.body_a == floor ? 1 : -1) * vec(contact.tangent_impulse);
  }
  Vec change = mass * (probe.velocity(cube) - before);
  change.y() = told.y() = 0;
  c.expect((told - change).norm() < 0.01 * change.norm(),
           "the contacts of a sliding cube say {:.4f} N s of friction, its momentum changed by {:.4f}", told.norm(),
           change.norm());
}

}  // namespace
}  // namespace exact

std::span<const Check> exact_contact_checks() {
  static constexpr Check checks[] = {
      {"exact.friction", "sqrt(mu1 mu2) g within 1.5 %, whatever the heading", &exact::friction},
      {"exact.restitution", "max(e1, e2) within .015", &exact::restitution},
      {"exact.surface_velocity", "a belt runs in its own axes, within 1 %", &exact::surface_velocity},
      {"exact.contact", "a resting ball's contact: place, normal, and its weight within .5 %", &exact::resting_ball},
      {"exact.depth", "the depth of an overlap, with its sign", &exact::depth},
      {"exact.tangent_impulses", "a sliding cube's friction impulses within 1 %", &exact::tangent_impulses},
  };
  return checks;
}

}  // namespace plumb::harness::conform
