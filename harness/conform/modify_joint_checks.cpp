// Joints that become others while they live (plumb.modify/1). The geometry is the referee's.
#include "conform/joints/joint_pair.hpp"
#include "plumb/backend/modify.hpp"

namespace plumb::harness::conform {
namespace {

constexpr std::size_t kTurn = 3;  ///< the free axis of a hinge

/// Throws Skipped where the backend cannot change that, or has no hinges.
void require_joint_change(Conformance& c, std::uint32_t bit) {
  c.require_needs(kJointNeeds);
  std::uint32_t index = 0;
  while ((bit >> index) != 1) ++index;
  const std::string what = std::string("changes of the ") + backend::modified_name(1, index);
  c.require(PLUMB_CAP_MODIFY, 1, index, what.c_str());
  c.require(PLUMB_CAP_JOINT, PLUMB_JOINT_HINGE, 0, "hinges");
}

void require_hinge_feature(Conformance& c, PlumbJointFeature feature, const char* what) {
  c.require(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_HINGE, feature, what);
}

/// A cube on a hinge about the world's z axis at its side, with what a check changes of it.
struct Door {
  Door(Conformance& c, PlumbNeeds needs, const Vec& gravity) : pair(c, PLUMB_JOINT_HINGE, true, needs, gravity) {
    const double half = std::sqrt(0.5);
    pair.desc.frame_a.orientation = pair.desc.frame_b.orientation = {0, -half, 0, half};  // its x axis is the world's z
    joint = pair.probe.joint(pair.desc);
  }
  void change(const PlumbJointChange& what) {
    IModify* modify = pair.probe.world().modify();
    if (modify == nullptr) throw Skipped{"no " PLUMB_EXT_MODIFY};
    check(pair.probe.world(), modify->modify_joints({&what, 1}));
  }
  [[nodiscard]] PlumbJointChange changed(std::uint32_t bit) const {
    PlumbJointChange made = joint_change(joint);
    made.what = bit;
    return made;
  }
  [[nodiscard]] double angle() { return pair.coordinate(kTurn); }
  /// About the hinge.
  void spin(double rate) {
    const Vec arm = pair.probe.position(pair.b) - Vec(0.5, 0, 0);
    pair.probe.write(PLUMB_FIELD_VELOCITY, pair.b, {-rate * arm.y(), rate * arm.x(), 0, 0, 0, rate});
  }

  JointPair pair;
  PlumbJoint joint;
};

/// The hinge moves to where the cube's other side is, and a metre up: the cube is pulled there.
void changes_frames(Conformance& c) {
  require_joint_change(c, PLUMB_MODIFY_FRAMES);
  Door door(c, kJointNeeds, Vec::Zero());
  door.pair.probe.step(10);
  PlumbJointChange made = door.changed(PLUMB_MODIFY_FRAMES);
  made.frame_a = door.pair.desc.frame_a;
  made.frame_b = door.pair.desc.frame_b;
  made.frame_a.position = {0.5, 0.2, 0};
  made.frame_b.position = {-0.3, 0, 0};
  door.change(made);
  backend::apply(made, door.pair.desc);
  door.pair.probe.seconds(2);
  const double gap = door.pair.error().position;
  c.expect(gap < 0.01, "the frames of a hinge that was moved are {:.4f} m apart after 2 s", gap);
}

void changes_limits(Conformance& c) {
  require_joint_change(c, PLUMB_MODIFY_LIMITS);
  require_hinge_feature(c, PLUMB_JOINT_HAS_LIMITS, "limits of hinges");
  Door door(c, kJointNeeds, Vec::Zero());
  PlumbJointChange made = door.changed(PLUMB_MODIFY_LIMITS);
  made.limits[kTurn] = {-0.2, 0.3, 1, 0};
  door.change(made);
  for (const double rate : {2.0, -2.0}) {
    door.spin(rate);
    double least = 0, most = 0;
    for (int step = 0; step < 60; ++step) {
      door.pair.probe.step();
      least = std::min(least, door.angle());
      most = std::max(most, door.angle());
    }
    c.expect(most < 0.35 && least > -0.25, "a hinge that got limits from -.2 to .3 turns from {:.3f} to {:.3f}", least,
             most);
  }
  made.limits[kTurn].enabled = 0;
  door.change(made);
  door.spin(2);
  door.pair.probe.seconds(0.5);
  c.expect(door.angle() > 0.5, "a hinge without limits any more turns to {:.3f} rad", door.angle());
}

void changes_motors(Conformance& c) {
  require_joint_change(c, PLUMB_MODIFY_MOTORS);
  require_hinge_feature(c, PLUMB_JOINT_HAS_MOTORS, "motors of hinges");
  Door door(c, kJointNeeds, Vec::Zero());
  PlumbJointChange made = door.changed(PLUMB_MODIFY_MOTORS);
  made.motors[kTurn] = {1.5, 1e5, 1, 0};
  door.change(made);
  door.pair.probe.seconds(0.5);
  const double rate = door.pair.probe.angular_velocity(door.pair.b).norm();
  c.expect(std::abs(rate - 1.5) < 0.02, "a hinge that got a motor of 1.5 rad/s turns with {:.4f}", rate);
  made.motors[kTurn] = {};
  door.change(made);
  door.spin(0.7);
  door.pair.probe.seconds(0.5);
  const double free = door.pair.probe.angular_velocity(door.pair.b).norm();
  c.expect(std::abs(free - 0.7) < 0.02, "a hinge without a motor any more turns with {:.4f} instead of .7 rad/s", free);
}

/// A spring's frequency is that of the cube's own moment; about the hinge at its side the moment is seven times that.
void changes_springs(Conformance& c) {
  require_joint_change(c, PLUMB_MODIFY_SPRINGS);
  require_hinge_feature(c, PLUMB_JOINT_HAS_SPRINGS, "springs of hinges");
  for (const double frequency : {1.0, 2.0}) {
    Door door(c, kJointNeeds, Vec::Zero());
    PlumbJointChange made = door.changed(PLUMB_MODIFY_SPRINGS);
    made.springs[kTurn] = {0, frequency, 0, 1, 0};
    door.change(made);
    door.spin(0.5);
    int steps = 0;
    do {
      door.pair.probe.step(1, 1.0 / 240);
      ++steps;
    } while (door.angle() > 0 && steps < 480);
    const double half_period = steps / 240.0;
    c.expect(std::abs(half_period * frequency / std::sqrt(7.0) - 0.5) < 0.02,
             "a spring of {} Hz that a hinge got swings back after {:.3f} s", frequency, half_period);
  }
}

void changes_strength(Conformance& c) {
  const PlumbNeeds needs = kJointNeeds | PLUMB_NEED_EVENTS;
  c.require_needs(needs);
  require_joint_change(c, PLUMB_MODIFY_STRENGTH);
  require_hinge_feature(c, PLUMB_JOINT_BREAKS, "hinges that break");
  Door door(c, needs, {0, -9.81, 0});
  door.pair.probe.seconds(0.5);
  PlumbJointChange made = door.changed(PLUMB_MODIFY_STRENGTH);
  made.break_force = 1;  // of a cube of 125 kg
  door.change(made);
  bool broken = false;
  for (int step = 0; step < 30; ++step) {
    door.pair.probe.step();
    for (const PlumbEvent& event : door.pair.probe.events())
      broken = broken || (event.type == PLUMB_EVENT_JOINT_BROKEN && event.joint == door.joint);
  }
  c.expect(broken, "a hinge that bears 1 N from now on does not break under 125 kg");
}

void changes_collide_connected(Conformance& c) {
  const PlumbNeeds needs = kJointNeeds | PLUMB_NEED_COLLISION;
  c.require_needs(needs);
  require_joint_change(c, PLUMB_MODIFY_COLLIDE_CONNECTED);
  c.require(PLUMB_CAP_JOINT, PLUMB_JOINT_DISTANCE, 0, "distance joints");
  c.require(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_DISTANCE, PLUMB_JOINT_HAS_LIMITS, "limits of distance joints");
  Probe probe(c, needs);
  probe.ground();
  const PlumbShape cube = probe.box({0.5, 0.5, 0.5});
  const PlumbBody below = probe.dynamic(cube, {0, 0.5, 0}), above = probe.dynamic(cube, {0, 1.5, 0});
  PlumbJointDesc rope = joint_desc(PLUMB_JOINT_DISTANCE);  // too long to matter
  rope.body_a = below;
  rope.body_b = above;
  rope.limits[0] = {0, 50, 1, 0};
  rope.collide_connected = 1;
  const PlumbJoint joint = probe.joint(rope);
  probe.seconds(0.5);
  c.expect(std::abs(probe.position(above).y() - 1.5) < 0.05, "joined cubes that collide do not");
  PlumbJointChange made = joint_change(joint);
  made.what = PLUMB_MODIFY_COLLIDE_CONNECTED;
  IModify* modify = probe.world().modify();
  if (modify == nullptr) throw Skipped{"no " PLUMB_EXT_MODIFY};
  check(probe.world(), modify->modify_joints({&made, 1}));
  probe.seconds(1);
  c.expect(std::abs(probe.position(above).y() - 0.5) < 0.05, "joined cubes that collide no more: one lies at {:.3f} m",
           probe.position(above).y());
}

/// A hinge that is not enabled lets go, and pulls again when it is.
void changes_enabled(Conformance& c) {
  require_joint_change(c, PLUMB_MODIFY_ENABLED);
  Door door(c, kJointNeeds, {0, -9.81, 0});
  PlumbJointChange made = door.changed(PLUMB_MODIFY_ENABLED);
  made.enabled = 0;
  door.change(made);
  const double from = door.pair.probe.position(door.pair.b).y();
  door.pair.probe.seconds(0.5);
  const double fallen = from - door.pair.probe.position(door.pair.b).y();
  c.expect(std::abs(fallen - 9.81 * 0.125) < 0.06, "a cube on a hinge that is not enabled fell by {:.3f} m in .5 s",
           fallen);
  made.enabled = 1;
  door.change(made);
  door.pair.probe.write_pose(PLUMB_FIELD_POSE, door.pair.b, {1, 0, 0});
  door.pair.probe.write(PLUMB_FIELD_VELOCITY, door.pair.b, {0, 0, 0, 0, 0, 0});
  door.pair.probe.seconds(1);
  const double gap = door.pair.error().position;
  c.expect(gap < 0.01, "a hinge that was enabled again opens by {:.4f} m", gap);
}

/// A ragdoll's limb that an animation carries: both bodies of a joint are kinematic for a while.
void changes_carried(Conformance& c) {
  const PlumbNeeds needs = kJointNeeds | PLUMB_NEED_KINEMATIC;
  c.require_needs(needs);
  require_joint_change(c, PLUMB_MODIFY_ENABLED);
  c.require(PLUMB_CAP_MODIFY, 0, 0, "changes of the motion");
  JointPair pair(c, PLUMB_JOINT_HINGE, false, needs, {0, -9.81, 0});
  pair.probe.joint(pair.desc);
  IModify* modify = pair.probe.world().modify();
  if (modify == nullptr) throw Skipped{"no " PLUMB_EXT_MODIFY};
  const auto both = [&](PlumbMotion motion) {
    PlumbBodyChange changes[] = {body_change(pair.a), body_change(pair.b)};
    for (PlumbBodyChange& made : changes) {
      made.what = PLUMB_MODIFY_MOTION;
      made.motion = motion;
    }
    check(pair.probe.world(), modify->modify_bodies(changes));
  };
  pair.probe.step(10);
  both(PLUMB_KINEMATIC);
  const Vec held = pair.probe.position(pair.b);
  pair.probe.write(PLUMB_FIELD_VELOCITY, pair.b, {0, 1, 0, 0, 0, 0});
  pair.probe.seconds(0.5);
  c.expect((pair.probe.position(pair.b) - held - Vec(0, 0.5, 0)).norm() < 1e-3,
           "a joint between two kinematic bodies moves one of them");
  both(PLUMB_DYNAMIC);
  pair.probe.seconds(2);
  const double gap = pair.error().position;
  c.expect(gap < 0.02, "a hinge whose bodies are dynamic again is {:.4f} m apart after 2 s", gap);
}

}  // namespace

std::span<const Check> modify_joint_checks() {
  static constexpr Check checks[] = {
      {"modify.frames", "a joint pulls its bodies to where it is moved", &changes_frames},
      {"modify.limits", "a joint gets limits, and loses them", &changes_limits},
      {"modify.motors", "a joint gets a motor, and loses it", &changes_motors},
      {"modify.springs", "a joint gets a spring of that frequency", &changes_springs},
      {"modify.strength", "a joint breaks of what it bore before", &changes_strength},
      {"modify.collide_connected", "joined bodies cease to touch", &changes_collide_connected},
      {"modify.enabled", "a joint lets go, and holds again", &changes_enabled},
      {"modify.carried", "a joint waits while nothing can move its bodies", &changes_carried},
  };
  return checks;
}

}  // namespace plumb::harness::conform
