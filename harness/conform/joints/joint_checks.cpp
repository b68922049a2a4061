// Joints: each type holds what it locks, lets go what it frees, and its limits, motors, springs, breaking and reactions
// do what they say. The geometry is the referee's.
#include "conform/joints/joint_pair.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace {

using backend::joint_name;

void each_joint(Conformance& c, void (*check_one)(Conformance&, PlumbJointType, bool)) {
  c.require_needs(kJointNeeds);
  for (PlumbJointType type = 0; type < PLUMB_JOINT_TYPE_COUNT; ++type)
    if (c.backend().capability(PLUMB_CAP_JOINT, type) != PLUMB_NONE && !backend::is_meshing(type))
      for (const bool to_world : {false, true}) check_one(c, type, to_world);
}

/// Kicks in all directions must not open what is locked.
void holds(Conformance& c) {
  each_joint(c, [](Conformance& conformance, PlumbJointType type, bool to_world) {
    JointPair pair(conformance, type, to_world, kJointNeeds);
    pair.probe.joint(pair.desc);
    pair.probe.write(PLUMB_FIELD_VELOCITY, pair.b, {0.3, 0.5, -0.4, 0.6, -0.3, 0.5});
    double position = 0, angle = 0;
    for (int i = 0; i < 120; ++i) {
      pair.probe.step();
      if (i < 10) continue;  // the kick itself may open it for a moment
      position = std::max(position, pair.error().position);
      angle = std::max(angle, pair.error().angle);
    }
    const char* other = to_world ? "the world" : "a body";
    conformance.expect(position < 0.02, "{} joint to {}: opens by {:.4f} m", joint_name(type), other, position);
    conformance.expect(angle < 0.03, "{} joint to {}: turns by {:.4f} rad where it is locked", joint_name(type), other,
                       angle);
  });
}

/// Each free axis moves freely when pushed along it.
void frees(Conformance& c) {
  each_joint(c, [](Conformance& conformance, PlumbJointType type, bool to_world) {
    for (std::size_t axis = 0; axis < 6; ++axis) {
      if (((free_axes(type) >> axis) & 1) == 0 || type == PLUMB_JOINT_DISTANCE) continue;
      JointPair pair(conformance, type, to_world, kJointNeeds);
      pair.probe.joint(pair.desc);
      // A turn about the joint's axis moves the body's centre along a circle of radius .5 m about it.
      const Vec direction = Vec::Unit(axis % 3);
      const Vec omega = axis >= 3 ? direction : Vec::Zero();
      const Vec linear = axis >= 3 ? Vec(omega.cross(Vec(0.5, 0, 0))) : direction;
      pair.probe.write(PLUMB_FIELD_VELOCITY, pair.b,
                       {linear.x(), linear.y(), linear.z(), omega.x(), omega.y(), omega.z()});
      const double start = pair.coordinate(axis);
      pair.probe.step(30);
      const double moved = std::abs(pair.coordinate(axis) - start);
      conformance.expect(moved > 0.1, "{} joint to {}: free axis {} moved only {:.4f} in .5 s at 1 per second",
                         joint_name(type), to_world ? "the world" : "a body", axis, moved);
    }
  });
}

void require_feature(Conformance& c, PlumbJointType type, PlumbJointFeature feature, const char* what) {
  c.require_needs(kJointNeeds);
  c.require(PLUMB_CAP_JOINT, type, 0, joint_name(type));
  c.require(PLUMB_CAP_JOINT_FEATURE, type, feature, what);
}

/// The free axis of a hinge or slider.
std::size_t main_axis(PlumbJointType type) { return type == PLUMB_JOINT_HINGE ? 3 : 0; }

template <class CheckOne>
void hinge_and_slider(Conformance& c, PlumbJointFeature feature, const char* what, CheckOne&& check_one) {
  c.require_needs(kJointNeeds);
  bool any = false;
  for (const PlumbJointType type : {PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER}) {
    if (c.backend().capability(PLUMB_CAP_JOINT, type) == PLUMB_NONE ||
        c.backend().capability(PLUMB_CAP_JOINT_FEATURE, type, feature) == PLUMB_NONE)
      continue;
    any = true;
    check_one(static_cast<PlumbJointType>(type));
  }
  if (!any) require_feature(c, PLUMB_JOINT_HINGE, feature, what);
}

/// A torque or force drives the axis against its upper and lower stop.
void limits(Conformance& c) {
  hinge_and_slider(c, PLUMB_JOINT_HAS_LIMITS, "limits", [&](PlumbJointType type) {
    // An engine that brakes slow bodies, and says so, is pushed harder than it brakes.
    const double push = c.is_exact(PLUMB_CAP_JOINT_FEATURE, type, PLUMB_JOINT_HAS_LIMITS) ? 20 : 200;
    for (const double sign : {1.0, -1.0}) {
      const std::size_t axis = main_axis(type);
      JointPair pair(c, type, true, kJointNeeds | PLUMB_NEED_FORCES);
      pair.desc.limits[axis] = {-0.4, 0.6, 1, 0};
      pair.probe.joint(pair.desc);
      for (int i = 0; i < 180; ++i) {
        pair.probe.write(type == PLUMB_JOINT_HINGE ? PLUMB_FIELD_TORQUE : PLUMB_FIELD_FORCE, pair.b,
                         {sign * push, 0, 0});
        pair.probe.step();
      }
      const double stop = sign > 0 ? 0.6 : -0.4;
      c.expect(std::abs(pair.coordinate(axis) - stop) < 0.03, "{} joint pushed against its stop at {}: it is at {:.4f}",
               joint_name(type), stop, pair.coordinate(axis));
    }
  });
}

void motors(Conformance& c) {
  hinge_and_slider(c, PLUMB_JOINT_HAS_MOTORS, "motors", [&](PlumbJointType type) {
    const std::size_t axis = main_axis(type);
    JointPair pair(c, type, true, kJointNeeds);
    pair.desc.motors[axis] = {0.8, 1000, 1, 0};
    const PlumbJoint joint = pair.probe.joint(pair.desc);
    pair.probe.step(30);
    const double start = pair.coordinate(axis);
    pair.probe.step(60);
    c.expect(std::abs(pair.coordinate(axis) - start - 0.8) < 0.03, "{} motor of .8 per second moved {:.4f} in 1 s",
             joint_name(type), pair.coordinate(axis) - start);
    std::vector<double> row = pair.probe.read_joint(PLUMB_JOINT_MOTOR, joint);
    row[2 * axis] = 0;
    pair.probe.write_joint(PLUMB_JOINT_MOTOR, joint, row);
    pair.probe.step(10);
    const double stopped = pair.coordinate(axis);
    pair.probe.step(60);
    c.expect(std::abs(pair.coordinate(axis) - stopped) < 0.01, "{} motor set to 0 moved on by {:.4f}", joint_name(type),
             pair.coordinate(axis) - stopped);
  });
}

/// A motor's force is bounded: a weak one accelerates the body by F / m.
void motor_force(Conformance& c) {
  hinge_and_slider(c, PLUMB_JOINT_HAS_MOTORS, "motors", [&](PlumbJointType type) {
    const std::size_t axis = main_axis(type);
    JointPair pair(c, type, true, kJointNeeds);
    const std::vector<double> mass = pair.probe.read(PLUMB_FIELD_MASS, pair.b);
    const double resistance = type == PLUMB_JOINT_HINGE ? mass[4] : mass[0];
    pair.desc.motors[axis] = {100, resistance, 1, 0};  // 1 per second squared
    pair.probe.joint(pair.desc);
    pair.probe.step(60);
    const double off = c.is_exact(PLUMB_CAP_JOINT_FEATURE, type, PLUMB_JOINT_HAS_MOTORS) ? 0.03 : 0.05;
    c.expect(std::abs(pair.coordinate(axis) - 0.5) < off, "{} motor of bounded force moved {:.4f} in 1 s instead of .5",
             joint_name(type), pair.coordinate(axis));
  });
}

/// A spring of 1 Hz swings with its period; strongly damped it comes to rest at its rest coordinate.
void springs(Conformance& c) {
  hinge_and_slider(c, PLUMB_JOINT_HAS_SPRINGS, "springs", [&](PlumbJointType type) {
    const std::size_t axis = main_axis(type);
    JointPair pair(c, type, true, kJointNeeds);
    pair.desc.springs[axis] = {0.3, 1, 1, 1, 0};
    pair.probe.joint(pair.desc);
    pair.probe.seconds(3);
    c.expect(std::abs(pair.coordinate(axis) - 0.3) < 0.02, "{} spring rests at {:.4f} instead of .3", joint_name(type),
             pair.coordinate(axis));
  });
}

/// Beside a limit, as robots have it: a spring by stiffness sinks under a force by force / stiffness.
void stiffness(Conformance& c) {
  c.require_needs(PLUMB_NEED_FORCES);
  hinge_and_slider(c, PLUMB_JOINT_HAS_STIFFNESS, "springs by stiffness", [&](PlumbJointType type) {
    const std::size_t axis = main_axis(type);
    const PlumbNeeds needs = kJointNeeds | PLUMB_NEED_FORCES;
    for (const bool limited : {false, true}) {
      JointPair pair(c, type, true, needs);
      const std::vector<double> mass = pair.probe.read(PLUMB_FIELD_MASS, pair.b);
      const double resistance = type == PLUMB_JOINT_HINGE ? mass[4] : mass[0];
      if (limited) pair.desc.limits[axis] = {-1, 1, 1, 0};
      pair.desc.springs[axis] = {0.1, 40 * resistance, 12 * resistance, 1, PLUMB_SPRING_STIFFNESS};
      pair.probe.joint(pair.desc);
      for (int i = 0; i < 180; ++i) {
        pair.probe.write(type == PLUMB_JOINT_HINGE ? PLUMB_FIELD_TORQUE : PLUMB_FIELD_FORCE, pair.b,
                         {8 * resistance, 0, 0});
        pair.probe.step();
      }
      c.expect(std::abs(pair.coordinate(axis) - 0.3) < 0.01,
               "a {} joint{} with a spring by stiffness is at {:.4f} instead of .3 under a force", joint_name(type),
               limited ? " with limits" : "", pair.coordinate(axis));
    }
  });
}

/// A hanging weight: the joint's reaction carries it.
void reactions(Conformance& c) {
  const PlumbNeeds needs = kJointNeeds | PLUMB_NEED_JOINT_REACTIONS;
  c.require_needs(needs);
  for (const PlumbJointType type : {PLUMB_JOINT_BALL, PLUMB_JOINT_HINGE, PLUMB_JOINT_FIXED}) {
    if (c.backend().capability(PLUMB_CAP_JOINT, type) == PLUMB_NONE ||
        c.backend().capability(PLUMB_CAP_JOINT_FEATURE, type, PLUMB_JOINT_HAS_REACTION) == PLUMB_NONE)
      continue;
    JointPair pair(c, type, true, needs, {0, -9.81, 0});
    pair.desc.frame_a.position = {1, 0.5, 0};
    pair.desc.frame_b.position = {0, 0.5, 0};
    const PlumbJoint joint = pair.probe.joint(pair.desc);
    pair.probe.seconds(2);
    const std::vector<double> row = pair.probe.read_joint(PLUMB_JOINT_REACTION, joint);
    const double weight = 125 * 9.81;
    c.expect(std::abs(row[1] - weight) < 0.02 * weight && std::abs(row[0]) + std::abs(row[2]) < 0.02 * weight,
             "{} joint with a weight of {:.2f} N below: reaction ({:.2f}, {:.2f}, {:.2f}) N", joint_name(type), weight,
             row[0], row[1], row[2]);
  }
}

void breaking(Conformance& c) {
  const PlumbNeeds needs = kJointNeeds | PLUMB_NEED_EVENTS;
  c.require_needs(needs);
  bool any = false;
  for (PlumbJointType type = 0; type < PLUMB_JOINT_TYPE_COUNT; ++type) {
    if (type == PLUMB_JOINT_DISTANCE || type == PLUMB_JOINT_SLIDER || backend::is_meshing(type) ||
        c.backend().capability(PLUMB_CAP_JOINT, type) == PLUMB_NONE ||
        c.backend().capability(PLUMB_CAP_JOINT_FEATURE, type, PLUMB_JOINT_BREAKS) == PLUMB_NONE)
      continue;
    any = true;
    const double weight = 125 * 9.81;
    for (const double factor : {0.5, 3.0}) {
      JointPair pair(c, type, true, needs, {0, -9.81, 0});
      pair.desc.frame_a.position = {1, 0, 0};
      pair.desc.frame_b.position = {0, 0, 0};
      pair.desc.break_force = factor * weight;
      const PlumbJoint joint = pair.probe.joint(pair.desc);
      int told = 0;
      PlumbStepReport report{};
      for (int i = 0; i < 60; ++i) {
        report = pair.probe.step();
        for (const PlumbEvent& event : pair.probe.events())
          told += event.type == PLUMB_EVENT_JOINT_BROKEN && event.joint == joint;
      }
      const bool broken = pair.probe.position(pair.b).y() < -1;
      c.expect(broken == (factor < 1) && told == (broken ? 1 : 0) && report.joints == (broken ? 0u : 1u),
               "{} joint that breaks at {} times the load: {}, {} events, {} joints left", joint_name(type), factor,
               broken ? "it broke" : "it held", told, report.joints);
    }
  }
  if (!any) require_feature(c, PLUMB_JOINT_BALL, PLUMB_JOINT_BREAKS, "break force");
}

/// Jointed bodies that overlap push each other apart only when collide_connected says so.
void collide_connected(Conformance& c) {
  c.require(PLUMB_CAP_JOINT, PLUMB_JOINT_SLIDER, 0, "slider joint");
  for (const std::uint32_t wanted : {0u, 1u}) {
    Probe probe(c, kJointNeeds | PLUMB_NEED_COLLISION, Vec::Zero());
    PlumbBodyDesc cube = dynamic_desc(probe.box({0.5, 0.5, 0.5}), {0, 0, 0});
    cube.material.friction = 0;
    const PlumbBody a = probe.body(cube);
    cube.pose.position.x = 0.9;
    const PlumbBody b = probe.body(cube);
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SLIDER);
    desc.body_a = a;
    desc.body_b = b;
    desc.frame_b.position.x = -0.9;
    desc.collide_connected = wanted;
    probe.joint(desc);
    probe.seconds(1);
    const double distance = (probe.position(a) - probe.position(b)).norm();
    c.expect((distance > 0.92) == (wanted != 0),
             "collide_connected {}: overlapping bodies ended {:.4f} m apart (from .9)", wanted, distance);
  }
}

void generic_axes(Conformance& c) {
  c.require(PLUMB_CAP_JOINT, PLUMB_JOINT_GENERIC, 0, "generic joint");
  for (std::size_t axis = 0; axis < 6; ++axis) {
    JointPair pair(c, PLUMB_JOINT_GENERIC, true, kJointNeeds);
    pair.desc.axis_modes[axis] = PLUMB_AXIS_FREE;
    pair.probe.joint(pair.desc);
    const Vec direction = Vec::Unit(static_cast<Eigen::Index>(axis % 3));
    const Vec omega = axis >= 3 ? direction : Vec::Zero();
    const Vec linear = axis >= 3 ? Vec(omega.cross(Vec(0.5, 0, 0))) : direction;
    pair.probe.write(PLUMB_FIELD_VELOCITY, pair.b,
                     {linear.x(), linear.y(), linear.z(), omega.x(), omega.y(), omega.z()});
    pair.probe.step(30);
    c.expect(std::abs(pair.coordinate(axis)) > 0.3, "generic joint with axis {} free: it moved {:.4f} in .5 s", axis,
             pair.coordinate(axis));
    for (std::size_t other = 0; other < 6; ++other)
      if (other != axis)
        c.expect(std::abs(pair.coordinate(other)) < 0.03,
                 "generic joint with axis {} free: locked axis {} moved {:.4f}", axis, other, pair.coordinate(other));
  }
}

void removal(Conformance& c) {
  c.require_needs(kJointNeeds);
  c.require(PLUMB_CAP_JOINT, PLUMB_JOINT_BALL, 0, "ball joint");
  JointPair pair(c, PLUMB_JOINT_BALL, true, kJointNeeds, {0, -9.81, 0});
  const PlumbJoint joint = pair.probe.joint(pair.desc);
  pair.probe.step(30);
  check(pair.probe.world(), pair.probe.world().joints()->destroy_joints({&joint, 1}));
  pair.probe.step(120);
  c.expect(pair.probe.position(pair.b).y() < -10, "a body whose joint was destroyed does not fall: y = {:.3f}",
           pair.probe.position(pair.b).y());
  c.expect(pair.probe.world().joints()->destroy_joints({&joint, 1}) == PLUMB_E_STALE_HANDLE,
           "a destroyed joint's handle is not stale");
}

}  // namespace

std::span<const Check> joint_checks() {
  static constexpr Check checks[] = {
      {"joints.hold", "locked axes stay closed under kicks", &holds},
      {"joints.free", "free axes move freely", &frees},
      {"joints.generic", "the generic joint, one free axis at a time", &generic_axes},
      {"joints.limits", "stops of hinge and slider", &limits},
      {"joints.motors", "motors reach their speed and can be changed", &motors},
      {"joints.motor_force", "motors are no stronger than they may be", &motor_force},
      {"joints.springs", "springs of hinge and slider come to rest where they should", &springs},
      {"joints.stiffness", "springs by stiffness give way by force over stiffness, beside limits too", &stiffness},
      {"joints.reactions", "the reaction carries a hanging weight", &reactions},
      {"joints.break", "joints break above their force, with an event", &breaking},
      {"joints.collide_connected", "jointed bodies touch only by choice", &collide_connected},
      {"joints.destroy", "a destroyed joint lets go", &removal},
  };
  return checks;
}

}  // namespace plumb::harness::conform
