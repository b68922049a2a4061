// Events and contacts: complete, in order, and equal to what the geometry says.
#include <set>

#include "conform/probe.hpp"
#include "plumb/backend/touch_tracker.hpp"

namespace plumb::harness::conform {
namespace {

using Pair = std::pair<PlumbBody, PlumbBody>;

Pair ordered(PlumbBody a, PlumbBody b) { return slot_of(a) < slot_of(b) ? Pair{a, b} : Pair{b, a}; }

/// Begin and end alternate for every pair, in the stated order, and the pairs that are open have contacts.
void completeness(Conformance& c) {
  c.require(PLUMB_CAP_EVENT, PLUMB_EVENT_CONTACT_BEGIN, 0, "contact events");
  Probe probe(c, kPlainNeeds | PLUMB_NEED_EVENTS | PLUMB_NEED_CONTACTS);
  probe.ground();
  const PlumbShape shapes[2] = {probe.box({0.3, 0.3, 0.3}), probe.sphere(0.3)};
  std::vector<PlumbBody> bodies;
  for (int i = 0; i < 30; ++i)
    bodies.push_back(probe.dynamic(shapes[i % 2], {0.5 * (i % 3), 1 + 0.7 * (i / 3), 0.4 * (i % 2)}));
  std::set<Pair> open;
  for (int step = 0; step < 300; ++step) {
    if (step == 150) {
      probe.destroy(bodies.back());
      bodies.pop_back();
    }
    probe.step();
    std::vector<PlumbEvent> events = probe.events();
    std::vector<PlumbEvent> sorted = events;
    backend::sort_events(sorted);
    for (std::size_t i = 0; i < events.size(); ++i)
      c.expect(events[i].type == sorted[i].type && events[i].body_a == sorted[i].body_a &&
                   events[i].body_b == sorted[i].body_b,
               "step {}: event {} is out of order", step, i);
    for (const PlumbEvent& event : events) {
      if (event.type == PLUMB_EVENT_CONTACT_BEGIN)
        c.expect(open.insert(ordered(event.body_a, event.body_b)).second, "step {}: a contact began twice", step);
      if (event.type == PLUMB_EVENT_CONTACT_END)
        c.expect(open.erase(ordered(event.body_a, event.body_b)) == 1, "step {}: a contact ended that had not begun",
                 step);
    }
    for (const PlumbContact& contact : probe.contacts())
      if (contact.depth > 0)
        c.expect(open.contains(ordered(contact.body_a, contact.body_b)),
                 "step {}: bodies overlap by {:.4f} m, but no contact is open", step, contact.depth);
  }
  c.expect(!open.empty(), "a settled heap has no open contact");
  for (const Pair& pair : open) {
    const auto alive = probe.world().bodies();
    for (const PlumbBody body : {pair.first, pair.second})
      c.expect(std::find(alive.begin(), alive.end(), body) != alive.end(), "a contact of a destroyed body never ended");
  }
}

/// Contacts of a cube at rest: position, normal, depth, and impulses that carry its weight.
void contact_rows(Conformance& c) {
  const PlumbNeeds wanted = c.available(PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES);
  c.require_needs(kPlainNeeds | PLUMB_NEED_CONTACTS);
  Probe probe(c, kPlainNeeds | wanted);
  const PlumbBody floor = probe.ground();
  const PlumbBody cube = probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  const PlumbStepReport report = probe.seconds(3);
  const auto contacts = probe.contacts();
  c.expect(contacts.size() >= 3, "a cube at rest has {} contact points", contacts.size());
  c.expect(report.contacts == contacts.size(), "the report says {} contacts, {} can be read", report.contacts,
           contacts.size());
  double impulse = 0;
  for (const PlumbContact& contact : contacts) {
    const bool floor_first = contact.body_a == floor && contact.body_b == cube;
    c.expect(floor_first || (contact.body_a == cube && contact.body_b == floor), "a contact names other bodies");
    const Vec normal = (floor_first ? 1 : -1) * vec(contact.normal);
    c.expect((normal - Vec::UnitY()).norm() < 1e-3, "the normal from floor to cube is ({:.4f}, {:.4f}, {:.4f})",
             normal.x(), normal.y(), normal.z());
    c.expect(std::abs(contact.position.y) < 0.06 && std::abs(contact.position.x) < 0.56,
             "a contact point is at ({:.3f}, {:.3f}, {:.3f})", contact.position.x, contact.position.y,
             contact.position.z);
    c.expect(std::abs(contact.depth) < 0.05, "depth {:.4f} m of a cube at rest", contact.depth);
    impulse += contact.normal_impulse;
  }
  if ((wanted & PLUMB_NEED_CONTACT_IMPULSES) != 0) {
    const double weight = 1000 * 9.81 / 60;
    c.expect(std::abs(impulse - weight) < 0.03 * weight,
             "the floor gives {:.3f} N s a step to a cube that weighs {:.3f} N s", impulse, weight);
  }
}

/// Friction impulses of a sliding cube: mu times the normal ones, against the motion.
void tangent_impulses(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES;
  c.require_needs(needs);
  Probe probe(c, needs);
  probe.ground();
  const PlumbBody cube = probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  probe.seconds(0.5);
  probe.write(PLUMB_FIELD_VELOCITY, cube, {5, 0, 0, 0, 0, 0});
  const Vec before = probe.velocity(cube);
  probe.step(5);
  const Vec after = probe.velocity(cube);
  probe.step();
  Vec sum = Vec::Zero();
  for (const PlumbContact& contact : probe.contacts())
    sum += (contact.body_b == cube ? 1 : -1) * vec(contact.tangent_impulse);
  const double change = 1000 * (probe.velocity(cube).x() - after.x());
  c.expect(after.x() < before.x(), "friction does not slow a sliding cube");
  c.expect(std::abs(sum.x() - change) < 0.1 * std::abs(change) + 1e-6,
           "tangent impulses sum to {:.3f} N s, the cube's momentum changed by {:.3f}", sum.x(), change);
}

void sleeping(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SLEEPING | PLUMB_NEED_EVENTS;
  c.require_needs(needs);
  Probe probe(c, needs);
  const PlumbBody ground = probe.ground();
  const PlumbShape cube = probe.box({0.5, 0.5, 0.5});
  const PlumbBody body = probe.dynamic(cube, {0, 0.5, 0});
  int asleep_at = 0;
  for (int step = 1; step <= 900 && asleep_at == 0; ++step) {
    probe.step();
    for (const PlumbEvent& event : probe.events())
      if (event.type == PLUMB_EVENT_SLEEP && event.body_a == body) asleep_at = step;
  }
  c.expect(asleep_at != 0, "a cube at rest did not fall asleep in 15 s, or no event told");
  c.expect(probe.read(PLUMB_FIELD_AWAKE, body)[0] == 0, "the event says asleep, the field says awake");
  c.expect(probe.read(PLUMB_FIELD_AWAKE, ground)[0] == 1, "what is static never sleeps, and its field says asleep");
  c.expect(probe.step().awake == 0, "the report counts a sleeping body as awake");
  probe.dynamic(cube, {0.2, 3, 0});
  bool woke = false;
  for (int step = 0; step < 120 && !woke; ++step) {
    probe.step();
    for (const PlumbEvent& event : probe.events())
      woke = woke || (event.type == PLUMB_EVENT_WAKE && event.body_a == body);
  }
  c.expect(woke, "a cube that was hit in its sleep did not wake, or no event told");
}

void no_sleep_undeclared(Conformance& c) {
  Probe probe(c, kPlainNeeds);
  probe.ground();
  probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  const PlumbStepReport report = probe.seconds(10);
  c.expect(report.awake == 1, "sleeping was not declared, but {} of 1 bodies are awake after 10 s", report.awake);
}

/// A body that becomes not finite is counted, and harms no neighbour; or the engine gives the world up in words. Only
/// an engine can make one: an absurd impulse is tried.
void absurd_speeds(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_FORCES;
  Probe probe(c, needs);
  probe.ground();
  const PlumbShape cube = probe.box({0.5, 0.5, 0.5});
  const PlumbBody wild = probe.dynamic(cube, {0, 0.5, 0});
  const PlumbBody calm = probe.dynamic(cube, {50, 0.5, 0});
  probe.write(PLUMB_FIELD_IMPULSE, wild, {0, -1e10, 1e10});
  std::uint32_t reported = 0;
  try {
    for (int i = 0; i < 30; ++i) reported = std::max(reported, probe.step().nonfinite);
  } catch (const Error& error) {
    c.expect(error.code() == PLUMB_E_WORLD_LOST && *error.what() != '\0', "an absurd impulse: {}", error.what());
    return;
  }
  const bool finite = probe.position(wild).allFinite() && probe.velocity(wild).allFinite();
  c.expect(finite || reported > 0, "a body is not finite and no report said so");
  c.expect(probe.position(calm).allFinite() && std::abs(probe.position(calm).y() - 0.5) < 0.1,
           "a neighbour 50 m away came to harm");
}

}  // namespace

std::span<const Check> event_checks() {
  static constexpr Check checks[] = {
      {"events.contacts", "contact begin and end: complete, alternating, in order", &completeness},
      {"events.sleep", "sleep and wake", &sleeping},
      {"events.no_sleep", "nobody sleeps where sleeping was not declared", &no_sleep_undeclared},
      {"contacts.rows", "contacts of a cube at rest", &contact_rows},
      {"contacts.friction", "tangent impulses of a sliding cube", &tangent_impulses},
      {"report.nonfinite", "bodies that are not finite are told", &absurd_speeds},
  };
  return checks;
}

}  // namespace plumb::harness::conform
