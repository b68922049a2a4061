// Bodies that become others while they live (plumb.modify/1): each member that can change does, and the rest stays.
#include "conform/probe.hpp"
#include "plumb/backend/modify.hpp"

namespace plumb::harness::conform {
namespace {

constexpr PlumbNeeds kMovedNeeds = kPlainNeeds | PLUMB_NEED_KINEMATIC;

/// Throws Skipped where the backend cannot change that.
void require_change(Conformance& c, std::uint32_t bit) {
  std::uint32_t index = 0;
  while ((bit >> index) != 1) ++index;
  const std::string what = std::string("changes of the ") + backend::modified_name(0, index);
  c.require(PLUMB_CAP_MODIFY, 0, index, what.c_str());
}

PlumbResult try_change(Probe& probe, const PlumbBodyChange& change) {
  IModify* modify = probe.world().modify();
  if (modify == nullptr) throw Skipped{"no " PLUMB_EXT_MODIFY};
  return modify->modify_bodies({&change, 1});
}

void change(Probe& probe, const PlumbBodyChange& what) { check(probe.world(), try_change(probe, what)); }

PlumbBodyChange to_motion(PlumbBody body, PlumbMotion motion) {
  PlumbBodyChange made = body_change(body);
  made.what = PLUMB_MODIFY_MOTION;
  made.motion = motion;
  return made;
}
PlumbBodyChange to_shape(PlumbBody body, PlumbShape shape) {
  PlumbBodyChange made = body_change(body);
  made.what = PLUMB_MODIFY_SHAPE;
  made.shape = shape;
  return made;
}
PlumbBodyChange to_flags(PlumbBody body, std::uint32_t flags) {
  PlumbBodyChange made = body_change(body);
  made.what = PLUMB_MODIFY_FLAGS;
  made.flags = flags;
  return made;
}

/// A cube that falls, is held in the air, carried, and let go as it was carried.
void changes_motion(Conformance& c) {
  c.require_needs(kMovedNeeds);
  require_change(c, PLUMB_MODIFY_MOTION);
  Probe probe(c, kMovedNeeds);
  const PlumbBody cube = probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 10, 0});
  const std::vector<double> mass = probe.read(PLUMB_FIELD_MASS, cube);
  probe.seconds(0.5);
  const double held_at = probe.position(cube).y();
  change(probe, to_motion(cube, PLUMB_STATIC));
  c.expect(probe.velocity(cube).norm() == 0, "a falling body that was made static has a velocity of {:.3f} m/s",
           probe.velocity(cube).norm());
  probe.seconds(0.5);
  c.expect(std::abs(probe.position(cube).y() - held_at) < 1e-6, "a body that was made static fell by {:.4f} m",
           held_at - probe.position(cube).y());
  c.expect(probe.read(PLUMB_FIELD_MASS, cube)[0] == 0, "a body that was made static says that it weighs {} kg",
           probe.read(PLUMB_FIELD_MASS, cube)[0]);

  change(probe, to_motion(cube, PLUMB_KINEMATIC));
  probe.write(PLUMB_FIELD_VELOCITY, cube, {3, 4, 0, 0, 0, 0});
  probe.step(6);
  const Vec let_go = probe.position(cube);
  c.expect((let_go - Vec(0.3, held_at + 0.4, 0)).norm() < 1e-3, "a body that was made kinematic does not go its way");
  change(probe, to_motion(cube, PLUMB_DYNAMIC));
  c.expect(probe.read(PLUMB_FIELD_MASS, cube) == mass, "a body that was made dynamic again has another mass");
  probe.seconds(0.5);
  const Vec flown = probe.position(cube) - let_go;
  c.expect((flown - Vec(1.5, 2 - 9.81 * 0.125, 0)).norm() < 0.06,
           "a body that was let go at 3, 4 m/s is {:.3f}, {:.3f} m further after .5 s instead of 1.5, .774", flown.x(),
           flown.y());
}

/// One made static becomes dynamic: it needs a mass, and takes part like any other.
void changes_first_mass(Conformance& c) {
  require_change(c, PLUMB_MODIFY_MOTION);
  require_change(c, PLUMB_MODIFY_MASS);
  Probe probe(c, kPlainNeeds);
  probe.ground();
  const PlumbBody cube = probe.fixed(probe.box({0.5, 0.5, 0.5}), {0, 1, 0});
  PlumbBodyChange made = to_motion(cube, PLUMB_DYNAMIC);
  c.expect(try_change(probe, made) == PLUMB_E_INVALID_ARGUMENT, "a body becomes dynamic that never had a mass");
  made.what |= PLUMB_MODIFY_MASS;
  made.mass_mode = PLUMB_MASS_FROM_TOTAL;
  made.mass = 3;
  change(probe, made);
  const std::vector<double> mass = probe.read(PLUMB_FIELD_MASS, cube);
  c.expect(std::abs(mass[0] - 3) < 1e-9 && std::abs(mass[4] - 0.5) < 1e-9,
           "a cube of 3 kg that was static before has a mass of {} kg and moments of {} kg m2 instead of .5", mass[0],
           mass[4]);
  probe.seconds(1.5);
  c.expect(std::abs(probe.position(cube).y() - 0.5) < 0.02, "it lies at {:.3f} m instead of .5",
           probe.position(cube).y());
}

/// A box on the ground crouches to a ball, and loses its shape altogether.
void changes_shape(Conformance& c) {
  require_change(c, PLUMB_MODIFY_SHAPE);
  Probe probe(c, kPlainNeeds);
  probe.ground();
  const PlumbShape box = probe.box({0.5, 1, 0.5}), ball = probe.sphere(0.25);
  const PlumbBody body = probe.dynamic(box, {0, 1, 0});
  const std::vector<double> mass = probe.read(PLUMB_FIELD_MASS, body);
  probe.seconds(0.5);
  change(probe, to_shape(body, ball));
  c.expect(probe.read(PLUMB_FIELD_MASS, body) == mass, "a change of the shape alone changes the mass");
  c.expect(probe.world().destroy_shapes({&ball, 1}) == PLUMB_E_IN_USE, "a shape that a body has become is not in use");
  c.expect(probe.world().destroy_shapes({&box, 1}) == PLUMB_OK, "a shape that no body has any more is in use: {}",
           probe.world().error_text());
  probe.seconds(1.5);
  c.expect(std::abs(probe.position(body).y() - 0.25) < 0.02, "a box that became a ball of .25 m lies at {:.3f} m",
           probe.position(body).y());
  change(probe, to_shape(body, 0));
  probe.seconds(0.5);
  c.expect(probe.position(body).y() < -0.5, "a body without a shape any more still lies at {:.3f} m",
           probe.position(body).y());
}

/// The centre of mass moves within a body that spins: the body goes on as it moved, and then about its new centre.
void changes_mass(Conformance& c) {
  c.require_needs(PLUMB_NEED_ROTATION | PLUMB_NEED_FORCES);
  require_change(c, PLUMB_MODIFY_MASS);
  Probe probe(c, PLUMB_NEED_ROTATION | PLUMB_NEED_FORCES, Vec::Zero());
  const PlumbBody body = probe.dynamic(probe.sphere(0.5), {0, 0, 0}, {1, 0, 0});
  probe.write(PLUMB_FIELD_VELOCITY, body, {1, 0, 0, 0, 0, 2});
  PlumbBodyChange made = body_change(body);
  made.what = PLUMB_MODIFY_MASS;
  made.mass_mode = PLUMB_MASS_EXPLICIT;
  made.mass = 4;
  made.inertia = {0.8, 0.8, 0.8};
  made.centre_of_mass = {0.5, 0, 0};
  change(probe, made);
  const Vec velocity = probe.velocity(body);
  c.expect(
      (velocity - Vec(1, 1, 0)).norm() < 1e-5,
      "the centre of mass moved by .5 m in a body that turns with 2 rad/s: it goes with {:.4f}, {:.4f} m/s instead "
      "of 1, 1",
      velocity.x(), velocity.y());
  c.expect(probe.position(body).norm() < 1e-6, "the body's frame jumped by {:.4f} m", probe.position(body).norm());
  probe.write(PLUMB_FIELD_IMPULSE, body, {-4, -4, 8});
  const Vec struck = probe.velocity(body);
  c.expect((struck - Vec(0, 0, 2)).norm() < 1e-5, "a body of 4 kg has {:.4f} m/s along z after 8 N s", struck.z());
  probe.seconds(0.5);
  const Vec centre = probe.position(body) + probe.orientation(body) * Vec(0.5, 0, 0);
  c.expect((centre - Vec(0.5, 0, 1)).norm() < 0.02, "it does not turn about its new centre of mass");
}

/// A cube becomes a sensor, and turns no more.
void changes_flags(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SENSORS;
  c.require_needs(needs);
  require_change(c, PLUMB_MODIFY_FLAGS);
  Probe probe(c, needs);
  probe.ground();
  const PlumbBody cube = probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  probe.seconds(0.5);
  change(probe, to_flags(cube, PLUMB_BODY_SENSOR));
  probe.seconds(0.5);
  c.expect(probe.position(cube).y() < -0.5, "a cube that became a sensor still lies at {:.3f} m",
           probe.position(cube).y());
  change(probe, to_flags(cube, 0));
  probe.write_pose(PLUMB_FIELD_POSE, cube, {0, 0.6, 0});
  probe.write(PLUMB_FIELD_VELOCITY, cube, {0, 0, 0, 0, 0, 3});
  change(probe, to_flags(cube, PLUMB_BODY_NO_ROTATION));
  probe.seconds(1);
  c.expect(std::abs(probe.position(cube).y() - 0.5) < 0.02, "what is no sensor any more lies at {:.3f} m",
           probe.position(cube).y());
  c.expect(probe.orientation(cube).angularDistance(Eigen::Quaterniond::Identity()) < 1e-4,
           "a body that became a particle turns");
  c.expect(try_change(probe, to_flags(cube, 0)) == PLUMB_E_INVALID_ARGUMENT,
           "a particle may turn, and has no inertia to turn with");
  c.expect(try_change(probe, to_flags(cube, PLUMB_BODY_NO_ROTATION | PLUMB_BODY_ASLEEP)) == PLUMB_E_INVALID_ARGUMENT,
           "PLUMB_BODY_ASLEEP is taken without a word");
}

void changes_locks(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_AXIS_LOCKS;
  c.require_needs(needs);
  require_change(c, PLUMB_MODIFY_LOCKS);
  Probe probe(c, needs);
  const PlumbBody cube = probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 5, 0}, {1, 0, 0});
  probe.seconds(0.25);
  const Vec from = probe.position(cube);
  PlumbBodyChange made = body_change(cube);
  made.what = PLUMB_MODIFY_LOCKS;
  made.locks = PLUMB_LOCK_LINEAR_Y;
  change(probe, made);
  probe.seconds(0.5);
  c.expect(std::abs(probe.position(cube).y() - from.y()) < 1e-3, "a body that was locked along y fell by {:.4f} m",
           from.y() - probe.position(cube).y());
  c.expect(std::abs(probe.position(cube).x() - from.x() - 0.5) < 1e-2, "a lock along y stops it along x");
  made.locks = 0;
  change(probe, made);
  probe.seconds(0.5);
  c.expect(probe.position(cube).y() < from.y() - 1, "a body that was unlocked does not fall");
}

/// What stood on a body that goes must fall, asleep or not; and the change of one that sleeps wakes it.
void changes_sleepers(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SLEEPING;
  c.require_needs(needs);
  require_change(c, PLUMB_MODIFY_SHAPE);
  Probe probe(c, needs);
  probe.ground();
  const PlumbShape cube = probe.box({0.5, 0.5, 0.5});
  const PlumbBody below = probe.dynamic(cube, {0, 0.5, 0}), above = probe.dynamic(cube, {0, 1.5, 0});
  const auto awake = [&](PlumbBody body) { return probe.read(PLUMB_FIELD_AWAKE, body)[0] != 0; };
  for (int second = 0; second < 20 && (awake(below) || awake(above)); ++second) probe.seconds(1);
  c.expect(!awake(below) && !awake(above), "two cubes at rest did not fall asleep in 20 s");
  change(probe, to_shape(below, probe.box({0.5, 0.1, 0.5})));
  probe.seconds(1);
  c.expect(probe.position(below).y() < 0.2, "a sleeping cube that became a plate lies at {:.3f} m",
           probe.position(below).y());
  c.expect(probe.position(above).y() < 0.8, "a cube that slept on it still lies at {:.3f} m",
           probe.position(above).y());
}

/// A body that is still touched has nothing to tell; one that has gone ends its contact once.
void changes_events(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_EVENTS;
  c.require_needs(needs);
  require_change(c, PLUMB_MODIFY_SHAPE);
  Probe probe(c, needs);
  probe.ground();
  const PlumbBody cube = probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 0.499, 0});
  probe.seconds(0.5);
  const auto count = [&](PlumbEventType type) {
    int found = 0;
    for (const PlumbEvent& event : probe.events()) found += event.type == type ? 1 : 0;
    return found;
  };
  change(probe, to_shape(cube, probe.box({0.4, 0.5, 0.4})));
  probe.step();
  c.expect(count(PLUMB_EVENT_CONTACT_BEGIN) + count(PLUMB_EVENT_CONTACT_END) == 0,
           "a cube that became narrower begins or ends its contact with what it lies on");
  change(probe, to_shape(cube, probe.sphere(0.1)));
  int ends = 0;
  for (int step = 0; step < 6; ++step) {
    probe.step();
    ends += count(PLUMB_EVENT_CONTACT_END);
  }
  c.expect(ends == 1, "a cube that became too small to touch ends its contact {} times", ends);
}

/// All or nothing, and what is wrong is named.
void changes_refusals(Conformance& c) {
  require_change(c, PLUMB_MODIFY_SHAPE);
  Probe probe(c, kPlainNeeds);
  const PlumbShape cube = probe.box({0.5, 0.5, 0.5}), plate = probe.box({1, 0.1, 1});
  const PlumbBody one = probe.dynamic(cube, {0, 5, 0}), other = probe.dynamic(cube, {3, 5, 0});
  IModify* modify = probe.world().modify();
  if (modify == nullptr) throw Skipped{"no " PLUMB_EXT_MODIFY};
  const auto result = [&](const PlumbBodyChange& second) {
    const PlumbBodyChange both[] = {to_shape(one, plate), second};
    return modify->modify_bodies(both);
  };
  const PlumbBody gone = probe.dynamic(cube, {9, 5, 0});
  probe.destroy(gone);
  PlumbBodyChange nothing = body_change(other), unknown = body_change(other);
  unknown.what = 1u << 31;
  c.expect(result(to_shape(gone, plate)) == PLUMB_E_STALE_HANDLE, "a body that is gone is changed");
  c.expect(result(to_shape(one, cube)) == PLUMB_E_INVALID_ARGUMENT, "a body is changed twice in a call");
  c.expect(result(to_shape(other, 12345)) == PLUMB_E_STALE_HANDLE, "a body takes a shape that there is not");
  c.expect(result(to_motion(other, 7)) == PLUMB_E_INVALID_ARGUMENT, "a body takes a motion that there is not");
  c.expect(result(nothing) == PLUMB_E_INVALID_ARGUMENT, "a change of nothing is taken");
  c.expect(result(unknown) == PLUMB_E_INVALID_ARGUMENT, "a change of what there is not is taken");
  c.expect(probe.world().destroy_shapes({&plate, 1}) == PLUMB_OK, "a call that failed has changed the first body: {}",
           probe.world().error_text());
}

/// A snapshot is of bodies as they were made of then.
void changes_snapshots(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SNAPSHOT;
  c.require_needs(needs);
  c.require(PLUMB_CAP_SNAPSHOT, 0, 0, "snapshots");
  require_change(c, PLUMB_MODIFY_SHAPE);
  Probe probe(c, needs);
  probe.ground();
  const PlumbShape cube = probe.box({0.5, 0.5, 0.5}), ball = probe.sphere(0.3);
  const PlumbBody body = probe.dynamic(cube, {0, 2, 0});
  probe.seconds(0.2);
  const auto save = [&] {
    std::span<const std::byte> saved;
    check(probe.world(), probe.world().snapshot()->save(saved));
    return std::vector<std::byte>(saved.begin(), saved.end());
  };
  const std::vector<std::byte> before = save();
  const Vec at = probe.position(body);
  change(probe, to_shape(body, ball));
  c.expect(probe.world().snapshot()->restore(before) == PLUMB_E_CORRUPT,
           "a snapshot of a cube is restored into a ball");
  probe.seconds(2);
  c.expect(std::abs(probe.position(body).y() - 0.3) < 0.02, "the ball lies at {:.3f} m", probe.position(body).y());
  check(probe.world(), probe.world().snapshot()->restore(save()));
  change(probe, to_shape(body, cube));
  check(probe.world(), probe.world().snapshot()->restore(before));
  c.expect((probe.position(body) - at).norm() < 1e-6, "a snapshot is not restored when the body is a cube again");
}

}  // namespace

std::span<const Check> modify_checks() {
  static constexpr Check checks[] = {
      {"modify.motion", "a body is held, carried and let go as it was carried", &changes_motion},
      {"modify.first_mass", "a body that was static takes a mass", &changes_first_mass},
      {"modify.shape", "a body rests on its new shape, or on none", &changes_shape},
      {"modify.mass", "a body goes on as it moved, about its new centre of mass", &changes_mass},
      {"modify.flags", "a body becomes a sensor, or a particle, and back", &changes_flags},
      {"modify.locks", "a body is locked and let go", &changes_locks},
      {"modify.sleep", "what sleeps on a body that changes wakes", &changes_sleepers},
      {"modify.events", "a contact that a change ends is told once", &changes_events},
      {"modify.bad", "what cannot be is refused, and nothing has changed", &changes_refusals},
      {"modify.snapshot", "a snapshot of another shape is refused until it is as it was", &changes_snapshots},
  };
  return checks;
}

}  // namespace plumb::harness::conform
