// Pair exceptions: two bodies that do not touch, and nobody else is told apart.
#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace {

const Vec kHalf = {0.5, 0.5, 0.5};

void set(Probe& probe, PlumbBody a, PlumbBody b, bool touch) {
  const PlumbBodyPair pair = {a, b};
  check(probe.world(), probe.world().exceptions()->set_exceptions({&pair, 1}, touch));
}

std::vector<PlumbBodyPair> listed(Probe& probe) {
  std::span<const PlumbBodyPair> pairs;
  check(probe.world(), probe.world().exceptions()->list_exceptions(pairs));
  return {pairs.begin(), pairs.end()};
}

/// A wide box on the ground, and two cubes on it.
struct Table {
  Table(Conformance& c, PlumbNeeds needs) : probe(c, needs) {
    if (probe.world().exceptions() == nullptr) throw Skipped{"no " PLUMB_EXT_EXCEPTIONS};
    probe.ground();
    top = probe.dynamic(probe.box({2, 0.5, 1}), {0, 0.5, 0});
    cube = probe.box(kHalf);
    one = probe.dynamic(cube, {-1, 1.5, 0});
    other = probe.dynamic(cube, {1, 1.5, 0});
  }
  [[nodiscard]] double height(PlumbBody body) { return probe.position(body).y(); }
  /// How high a cube stands: 0.5 m on the ground, 1.5 m on the top.
  void expect_height(Conformance& c, PlumbBody body, double expected, const char* who, const char* when) {
    c.expect(std::abs(height(body) - expected) < 0.1, "{} is at {:.3f} m instead of {} m {}", who, height(body),
             expected, when);
  }
  int count(PlumbEventType type, PlumbBody a, PlumbBody b) {
    int found = 0;
    for (const PlumbEvent& event : probe.events())
      found +=
          event.type == type && ((event.body_a == a && event.body_b == b) || (event.body_a == b && event.body_b == a));
    return found;
  }

  Probe probe;
  PlumbShape cube;
  PlumbBody top, one, other;
};

void falls_through(Conformance& c) {
  Table table(c, kPlainNeeds);
  table.probe.seconds(0.5);
  set(table.probe, table.one, table.top, false);
  table.probe.seconds(1);
  table.expect_height(c, table.one, 0.5, "a cube", "after it was excepted from what it stood on");
  table.expect_height(c, table.other, 1.5, "a cube that has no exception", "after another was excepted");
  table.expect_height(c, table.top, 0.5, "what they stood on", "after a cube was excepted from it");
  table.probe.write_pose(PLUMB_FIELD_POSE, table.one, {-1, 2, 0});
  table.probe.write(PLUMB_FIELD_VELOCITY, table.one, {0, 0, 0, 0, 0, 0});
  set(table.probe, table.top, table.one, true);
  table.probe.seconds(1);
  table.expect_height(c, table.one, 1.5, "a cube", "after its exception was taken back");
}

void events(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_EVENTS | PLUMB_NEED_CONTACTS;
  c.require_needs(needs);
  Table table(c, needs);
  table.probe.seconds(0.5);
  set(table.probe, table.one, table.top, false);
  int ends_other = 0, begins = 0;
  for (int step = 0; step < 60; ++step) {
    table.probe.step();
    const int ends = table.count(PLUMB_EVENT_CONTACT_END, table.one, table.top);
    c.expect(ends == (step == 0 ? 1 : 0), "{} ends of the excepted pair's contact in step {} after it was excepted",
             ends, step + 1);
    ends_other += table.count(PLUMB_EVENT_CONTACT_END, table.other, table.top);
    begins += table.count(PLUMB_EVENT_CONTACT_BEGIN, table.one, table.top);
    for (const PlumbContact& contact : table.probe.contacts())
      c.expect(!(std::min(contact.body_a, contact.body_b) == std::min(table.one, table.top) &&
                 std::max(contact.body_a, contact.body_b) == std::max(table.one, table.top)),
               "step {}: the excepted pair has a contact", step + 1);
  }
  c.expect(begins == 0, "the excepted pair began to touch {} times", begins);
  c.expect(ends_other == 0, "the contact of a pair that is not excepted ended {} times", ends_other);
  table.probe.write_pose(PLUMB_FIELD_POSE, table.one, {-1, 1.6, 0});
  set(table.probe, table.one, table.top, true);
  for (int step = 0; step < 60; ++step) {
    table.probe.step();
    begins += table.count(PLUMB_EVENT_CONTACT_BEGIN, table.one, table.top);
  }
  c.expect(begins >= 1, "no contact began after the exception was taken back");
}

void sleepers(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SLEEPING;
  c.require_needs(needs);
  Table table(c, needs);
  for (int second = 0; second < 20 && table.probe.read(PLUMB_FIELD_AWAKE, table.one)[0] != 0; ++second)
    table.probe.seconds(1);
  c.expect(table.probe.read(PLUMB_FIELD_AWAKE, table.one)[0] == 0, "a cube at rest did not fall asleep in 20 s");
  set(table.probe, table.one, table.top, false);
  table.probe.seconds(1);
  table.expect_height(c, table.one, 0.5, "a cube that slept", "after it was excepted from what it stood on");
}

void list(Conformance& c) {
  Table table(c, kPlainNeeds);
  Probe& probe = table.probe;
  IExceptions& exceptions = *probe.world().exceptions();
  const PlumbBody first = std::min(table.top, table.one), second = std::max(table.top, table.one);
  c.expect(listed(probe).empty(), "a world without exceptions lists {}", listed(probe).size());
  const PlumbBodyPair pairs[] = {{table.other, table.one}, {table.one, table.top}, {table.top, table.one}};
  check(probe.world(), exceptions.set_exceptions(pairs, false));
  set(probe, table.one, table.top, false);
  std::vector<PlumbBodyPair> found = listed(probe);
  c.expect(found.size() == 2, "{} exceptions are listed instead of 2", found.size());
  if (found.size() == 2)
    c.expect(
        found[0].body_a == first && found[0].body_b == second && slot_of(found[1].body_a) < slot_of(found[1].body_b),
        "the list is not in the order of the slots");
  const PlumbBodyPair with_itself[] = {{table.other, table.top}, {table.one, table.one}};
  c.expect(exceptions.set_exceptions(with_itself, false) == PLUMB_E_INVALID_ARGUMENT,
           "a body is excepted from itself without a word");
  const PlumbBody gone = probe.dynamic(table.cube, {0, 10, 0});
  probe.destroy(gone);
  const PlumbBodyPair stale[] = {{table.other, table.top}, {table.one, gone}};
  c.expect(exceptions.set_exceptions(stale, false) == PLUMB_E_STALE_HANDLE, "an exception of a body that is gone");
  c.expect(listed(probe).size() == 2, "a call that failed has changed the list");
  set(probe, table.other, table.top, true);
  set(probe, table.top, table.one, true);
  found = listed(probe);
  c.expect(found.size() == 1 && found[0].body_a == std::min(table.one, table.other),
           "{} exceptions are listed instead of the 1 that was not taken back", found.size());
}

void slots(Conformance& c) {
  Table table(c, kPlainNeeds);
  set(table.probe, table.one, table.top, false);
  table.probe.seconds(0.5);
  table.probe.destroy(table.one);
  c.expect(listed(table.probe).empty(), "an exception outlives one of its bodies in the list");
  const PlumbBody heir = table.probe.dynamic(table.cube, {-1, 1.6, 0});
  if (slot_of(heir) != slot_of(table.one)) throw Skipped{"slots are not used again"};
  table.probe.seconds(1);
  table.expect_height(c, heir, 1.5, "a cube in the slot of one that had an exception", "after 1 s");
  c.expect(listed(table.probe).empty(), "a body inherits an exception from its slot");
}

void excepted_sensors(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SENSORS;
  c.require_needs(needs);
  Table table(c, needs | c.available(PLUMB_NEED_QUERIES));
  PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
  desc.shape = table.probe.box({3, 3, 3});
  desc.flags = PLUMB_BODY_SENSOR;
  const PlumbBody sensor = table.probe.body(desc);
  table.probe.step();
  c.expect(table.count(PLUMB_EVENT_SENSOR_ENTER, sensor, table.one) == 1, "a sensor does not see a cube in it");
  set(table.probe, table.one, sensor, false);
  table.probe.step();
  c.expect(table.count(PLUMB_EVENT_SENSOR_LEAVE, sensor, table.one) == 1,
           "a cube does not leave a sensor from which it was excepted");
  c.expect(table.count(PLUMB_EVENT_SENSOR_LEAVE, sensor, table.other) == 0, "another cube leaves the sensor");
  table.probe.seconds(0.5);
  c.expect(table.count(PLUMB_EVENT_SENSOR_ENTER, sensor, table.one) == 0, "a sensor sees a cube that was excepted");
  if (table.probe.world().queries() != nullptr &&
      c.backend().capability(PLUMB_CAP_QUERY, PLUMB_QUERY_RAY) != PLUMB_NONE) {
    const PlumbRay down = {{-1, 10, 0}, {0, -20, 0}, {1, 0xffffffffu, 0, 0}};
    const Hits hits = table.probe.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, {&down, 1});
    c.expect(hits.result >= 0 && hits.hits.size() == 1 && hits.hits[0].body == table.one,
             "a ray does not see a cube that has an exception");
  }
  set(table.probe, sensor, table.one, true);
  table.probe.step();
  c.expect(table.count(PLUMB_EVENT_SENSOR_ENTER, sensor, table.one) == 1,
           "a sensor does not see a cube whose exception was taken back");
}

void snapshots(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SNAPSHOT;
  c.require_needs(needs);
  const PlumbDegree degree = c.require(PLUMB_CAP_SNAPSHOT, 0, 0, "snapshots");
  Table table(c, needs);
  table.probe.seconds(0.5);
  set(table.probe, table.one, table.top, false);
  std::span<const std::byte> saved;
  check(table.probe.world(), table.probe.world().snapshot()->save(saved));
  const std::vector<std::byte> bytes(saved.begin(), saved.end());
  table.probe.seconds(1);
  const std::uint64_t first = table.probe.hash();
  set(table.probe, table.one, table.top, true);
  set(table.probe, table.other, table.top, false);
  table.probe.seconds(0.5);
  check(table.probe.world(), table.probe.world().snapshot()->restore(bytes));
  const std::vector<PlumbBodyPair> found = listed(table.probe);
  c.expect(found.size() == 1 && std::max(found[0].body_a, found[0].body_b) == std::max(table.one, table.top),
           "{} exceptions are listed after restoring, 1 was saved", found.size());
  table.probe.seconds(1);
  table.expect_height(c, table.one, 0.5, "a cube that was excepted when the world was saved", "1 s after restoring");
  table.expect_height(c, table.other, 1.5, "a cube that was excepted after the world was saved", "1 s after restoring");
  if (degree >= PLUMB_EMULATED) c.expect(table.probe.hash() == first, "1 s after restoring the state differs");
}

void fast_bodies(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_CCD;
  c.require_needs(needs);
  Probe probe(c, needs, Vec::Zero());
  if (probe.world().exceptions() == nullptr) throw Skipped{"no " PLUMB_EXT_EXCEPTIONS};
  const PlumbBody wall = probe.fixed(probe.box({0.05, 5, 5}), {0, 0, 0});
  const PlumbShape ball = probe.sphere(0.1);
  PlumbBody bullets[2];
  for (int i = 0; i < 2; ++i) {
    PlumbBodyDesc desc = dynamic_desc(ball, {-3.03, 2.0 * i, 0}, {120, 0, 0});
    desc.flags |= PLUMB_BODY_CCD;
    bullets[i] = probe.body(desc);
  }
  set(probe, wall, bullets[0], false);
  probe.step(6);
  const double through = probe.position(bullets[0]).x(), held = probe.position(bullets[1]).x();
  c.expect(std::abs(through - (-3.03 + 12)) < 0.01, "a bullet that is excepted from a wall is at x = {:.3f} m",
           through);
  c.expect(held < 0, "a bullet that has no exception went through the wall, to x = {:.3f} m", held);
}

void joined(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_JOINTS;
  c.require_needs(needs);
  c.require(PLUMB_CAP_JOINT, PLUMB_JOINT_DISTANCE, 0, "distance joints");
  c.require(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_DISTANCE, PLUMB_JOINT_HAS_LIMITS, "limits of distance joints");
  Table table(c, needs);
  PlumbJointDesc rope = joint_desc(PLUMB_JOINT_DISTANCE);  // too long to matter
  rope.body_a = table.top;
  rope.body_b = table.one;
  rope.limits[0] = {0, 50, 1, 0};
  const PlumbJoint joint = table.probe.joint(rope);
  set(table.probe, table.one, table.top, false);
  set(table.probe, table.one, table.top, true);
  table.probe.seconds(1);
  table.expect_height(c, table.one, 0.5, "a cube that a joint keeps apart", "after an exception was taken back");
  set(table.probe, table.one, table.top, false);
  check(table.probe.world(), table.probe.world().joints()->destroy_joints({&joint, 1}));
  table.probe.write_pose(PLUMB_FIELD_POSE, table.one, {-1, 1.6, 0});
  table.probe.write(PLUMB_FIELD_VELOCITY, table.one, {0, 0, 0, 0, 0, 0});
  table.probe.seconds(1);
  table.expect_height(c, table.one, 0.5, "a cube that is excepted", "after the joint of the pair was destroyed");
  table.probe.write_pose(PLUMB_FIELD_POSE, table.one, {-1, 1.6, 0});
  table.probe.write(PLUMB_FIELD_VELOCITY, table.one, {0, 0, 0, 0, 0, 0});
  set(table.probe, table.one, table.top, true);
  table.probe.seconds(1);
  table.expect_height(c, table.one, 1.5, "a cube", "when neither joint nor exception is left");
}

}  // namespace

std::span<const Check> exception_checks() {
  static constexpr Check checks[] = {
      {"exceptions.fall", "two that are excepted fall through each other, others do not", &falls_through},
      {"exceptions.events", "their contact ends once, with the next step", &events},
      {"exceptions.sleep", "a pair that sleeps wakes", &sleepers},
      {"exceptions.list", "the list is what was set, and a failed call changes nothing", &list},
      {"exceptions.slots", "a body does not inherit the exceptions of its slot", &slots},
      {"exceptions.sensors", "sensors obey them, rays do not", &excepted_sensors},
      {"exceptions.snapshot", "snapshots hold them", &snapshots},
      {"exceptions.ccd", "a fast body passes what it is excepted from", &fast_bodies},
      {"exceptions.joints", "joints and exceptions keep a pair apart independently", &joined},
  };
  return checks;
}

}  // namespace plumb::harness::conform
