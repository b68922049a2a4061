// What is on the free axes of joints of every type, and the torques of joints.
#include <array>
#include <numbers>

#include "conform/joints/joint_pair.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace {

using backend::joint_name;

bool claims(Conformance& c, PlumbJointType type, PlumbJointFeature feature) {
  return c.backend().capability(PLUMB_CAP_JOINT, type) != PLUMB_NONE &&
         c.backend().capability(PLUMB_CAP_JOINT_FEATURE, type, feature) != PLUMB_NONE;
}

/// Each free axis of each type, one at a time, driven against its stops; harder where an engine says that it brakes
/// slow bodies.
void all_limits(Conformance& c) {
  c.require_needs(kJointNeeds | PLUMB_NEED_FORCES);
  bool any = false;
  for (const PlumbJointType type :
       {PLUMB_JOINT_BALL, PLUMB_JOINT_DISTANCE, PLUMB_JOINT_UNIVERSAL, PLUMB_JOINT_GENERIC}) {
    if (!claims(c, type, PLUMB_JOINT_HAS_LIMITS)) continue;
    any = true;
    const bool generic = type == PLUMB_JOINT_GENERIC, distance = type == PLUMB_JOINT_DISTANCE;
    for (std::size_t axis = 0; axis < (distance ? 1 : 6); ++axis) {
      if (!generic && (free_axes(type) >> axis & 1) == 0) continue;
      for (const double sign : {1.0, -1.0}) {
        JointPair pair(c, type, true, kJointNeeds | PLUMB_NEED_FORCES);
        const double start = distance ? 1 : 0, stop = start + (sign > 0 ? 0.4 : -0.3);
        pair.desc.axis_modes[axis] = PLUMB_AXIS_LIMITED;
        pair.desc.limits[axis] = {start - 0.3, start + 0.4, 1, 0};
        pair.probe.joint(pair.desc);
        std::array<double, 3> push{};
        push[axis % 3] = sign * (c.is_exact(PLUMB_CAP_JOINT_FEATURE, type, PLUMB_JOINT_HAS_LIMITS) ? 20 : 200);
        for (int i = 0; i < 180; ++i) {
          pair.probe.write(axis >= 3 ? PLUMB_FIELD_TORQUE : PLUMB_FIELD_FORCE, pair.b, push);
          pair.probe.step();
        }
        const double at = pair.coordinate(axis);
        c.expect(std::abs(at - stop) < 0.03, "{} joint pushed on axis {} against its stop at {}: it is at {:.4f}",
                 joint_name(type), axis, stop, at);
      }
    }
  }
  if (!any) throw Skipped{"no limits of ball, distance, universal and generic joints"};
}

/// Springs without damping: from the first passage through rest to the last.
void spring_period(Conformance& c) {
  c.require_needs(kJointNeeds);
  bool any = false;
  for (const PlumbJointType type : {PLUMB_JOINT_SLIDER, PLUMB_JOINT_DISTANCE, PLUMB_JOINT_GENERIC}) {
    if (!claims(c, type, PLUMB_JOINT_HAS_SPRINGS)) continue;
    any = true;
    JointPair pair(c, type, false, kJointNeeds);
    const double rest = type == PLUMB_JOINT_DISTANCE ? 1.2 : 0.2, frequency = 1;
    pair.desc.axis_modes[0] = PLUMB_AXIS_FREE;
    pair.desc.springs[0] = {rest, frequency, 0, 1, 0};
    pair.desc.rest_length = rest;
    pair.probe.joint(pair.desc);
    double before = pair.coordinate(0) - rest, first = 0, last = 0;
    int passes = 0;
    for (int i = 1; i <= 240; ++i) {
      pair.probe.step();
      const double now = pair.coordinate(0) - rest;
      if (before * now < 0) {
        last = (i - 1 + before / (before - now)) / 60;
        if (passes++ == 0) first = last;
      }
      before = now;
    }
    const double found = passes < 2 ? 0 : (passes - 1) / (2 * (last - first));
    c.expect(std::abs(found - frequency) < 0.02 * frequency, "{} joint with a spring of {} Hz swings at {:.4f} Hz",
             joint_name(type), frequency, found);
  }
  if (!any) throw Skipped{"no springs of slider, distance and generic joints"};
}

/// A cube held out level by a fixed joint at its side: its weight times its arm.
void torques(Conformance& c) {
  const PlumbNeeds needs = kJointNeeds | PLUMB_NEED_JOINT_REACTIONS;
  c.require_needs(needs);
  c.require(PLUMB_CAP_JOINT, PLUMB_JOINT_FIXED, 0, "fixed joint");
  c.require(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_FIXED, PLUMB_JOINT_HAS_REACTION, "reactions");
  JointPair pair(c, PLUMB_JOINT_FIXED, true, needs, {0, -9.81, 0});
  const PlumbJoint joint = pair.probe.joint(pair.desc);
  pair.probe.seconds(2);
  const std::vector<double> row = pair.probe.read_joint(PLUMB_JOINT_REACTION, joint);
  const double moment = 125 * 9.81 * 0.5;
  c.expect(std::abs(row[5] - moment) < 0.03 * moment && std::abs(row[3]) + std::abs(row[4]) < 0.03 * moment,
           "fixed joint with a weight on an arm of half a metre: torque ({:.2f}, {:.2f}, {:.2f}) instead of {:.2f} N m "
           "about z",
           row[3], row[4], row[5], moment);
}

}  // namespace

std::span<const Check> joint_axis_checks() {
  static constexpr Check checks[] = {
      {"joints.all_limits", "stops on each free axis of ball, distance, universal and generic joints", &all_limits},
      {"joints.spring_period", "springs swing at their frequency", &spring_period},
      {"joints.torques", "the reaction's torque carries a weight on an arm", &torques},
  };
  return checks;
}

}  // namespace plumb::harness::conform
