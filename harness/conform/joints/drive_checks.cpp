// Joints that are driven to a pose: where springs rest is written between steps, and the swing of a swing-twist joint
// has springs and motors of its own.
#include <array>
#include <cmath>

#include "conform/joints/joint_pair.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace {

bool has_targets(Conformance& c, PlumbJointType type) {
  return c.backend().capability(PLUMB_CAP_JOINT, type) != PLUMB_NONE &&
         c.backend().capability(PLUMB_CAP_JOINT_FEATURE, type, PLUMB_JOINT_HAS_TARGETS) != PLUMB_NONE;
}

void write_rest(Probe& probe, PlumbJoint joint, std::size_t axis, double rest) {
  std::vector<double> row = probe.read_joint(PLUMB_JOINT_SPRING_REST, joint);
  row[axis] = rest;
  probe.write_joint(PLUMB_JOINT_SPRING_REST, joint, row);
}

/// A damped spring comes to rest where it was made to, and then where it is told to, once and again.
void targets(Conformance& c) {
  c.require_needs(kJointNeeds);
  bool any = false;
  for (const PlumbJointType type : {PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER, PLUMB_JOINT_DISTANCE}) {
    if (!has_targets(c, type)) continue;
    any = true;
    const std::size_t axis = type == PLUMB_JOINT_HINGE ? 3 : 0;
    JointPair pair(c, type, true, kJointNeeds);
    pair.desc.springs[axis] = {0.3, 1, 1, 1, PLUMB_SPRING_FREQUENCY};
    if (type == PLUMB_JOINT_DISTANCE) pair.desc.rest_length = 1.2;
    const PlumbJoint joint = pair.probe.joint(pair.desc);
    double rest = type == PLUMB_JOINT_DISTANCE ? 1.2 : 0.3;
    for (const double next : {0.7, 0.45}) {
      const double told = pair.probe.read_joint(PLUMB_JOINT_SPRING_REST, joint)[axis];
      c.expect(std::abs(told - rest) < 1e-6, "a {} joint's spring rests at {:.4f} and says {:.4f}",
               backend::joint_name(type), rest, told);
      rest = next;
      write_rest(pair.probe, joint, axis, rest);
      pair.probe.seconds(3);
      c.expect(std::abs(pair.coordinate(axis) - rest) < 0.02,
               "the spring of a {} joint that was told to rest at {:.2f} is at {:.4f} after 3 s",
               backend::joint_name(type), rest, pair.coordinate(axis));
    }
  }
  if (!any) c.require(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_HINGE, PLUMB_JOINT_HAS_TARGETS, "springs that are moved");
}

void require_drive(Conformance& c, PlumbJointFeature feature, const char* what) {
  c.require_needs(kJointNeeds);
  c.require(PLUMB_CAP_JOINT, PLUMB_JOINT_SWING_TWIST, 0, "swing-twist joint");
  c.require(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_SWING_TWIST, feature, what);
}

/// Springs about all three axes bring it to an orientation, and where they can be moved to another.
void swing_springs(Conformance& c) {
  require_drive(c, PLUMB_JOINT_HAS_SPRINGS, "springs");
  using Turns = std::array<double, 3>;
  JointPair pair(c, PLUMB_JOINT_SWING_TWIST, true, kJointNeeds);
  std::vector<Turns> poses{{0.4, 0.7, -0.5}};
  if (has_targets(c, PLUMB_JOINT_SWING_TWIST)) poses.insert(poses.end(), {{-0.6, -1.1, 0.8}, {0, 0, 0}});
  for (std::size_t k = 0; k < 3; ++k) pair.desc.springs[3 + k] = {poses[0][k], 1, 3, 1, PLUMB_SPRING_FREQUENCY};
  const PlumbJoint joint = pair.probe.joint(pair.desc);
  for (const Turns& pose : poses) {
    for (std::size_t k = 0; k < 3 && &pose != &poses.front(); ++k) write_rest(pair.probe, joint, 3 + k, pose[k]);
    pair.probe.seconds(10);
    const Turns at{pair.coordinate(3), pair.coordinate(4), pair.coordinate(5)};
    c.expect(std::hypot(at[0] - pose[0], at[1] - pose[1], at[2] - pose[2]) < 0.03,
             "springs that rest at a twist of {:.2f} and a swing of ({:.2f}, {:.2f}) bring it to {:.4f} and ({:.4f}, "
             "{:.4f}) in 10 s",
             pose[0], pose[1], pose[2], at[0], at[1], at[2]);
  }
}

/// A swing's spring by stiffness k gives way to a weight on a lever l by s: k s = m g l cos s. Likewise askew.
void swing_stiffness(Conformance& c) {
  require_drive(c, PLUMB_JOINT_HAS_STIFFNESS, "springs by stiffness");
  constexpr double kGravity = 10, kLever = 0.5, kGives = 0.5;  // m/s2, m, rad
  for (const double way : {0.0, 0.5, 1.0, 1.5, 2.3}) {
    JointPair pair(c, PLUMB_JOINT_SWING_TWIST, true, kJointNeeds,
                   {0, kGravity * std::sin(way), -kGravity * std::cos(way)});
    const double mass = pair.probe.read(PLUMB_FIELD_MASS, pair.b)[0];
    const double stiffness = mass * kGravity * kLever * std::cos(kGives) / kGives;
    for (std::size_t axis = 3; axis < 6; ++axis)
      pair.desc.springs[axis] = {0, stiffness, 0.4 * stiffness, 1, PLUMB_SPRING_STIFFNESS};
    pair.probe.joint(pair.desc);
    pair.probe.seconds(5);
    const double y = kGives * std::cos(way), z = kGives * std::sin(way);
    c.expect(std::hypot(pair.coordinate(4) - y, pair.coordinate(5) - z) < 0.01,
             "a swing's springs that should give way to a weight by ({:.4f}, {:.4f}) are at ({:.4f}, {:.4f})", y, z,
             pair.coordinate(4), pair.coordinate(5));
  }
}

/// Motors about both axes of a swing turn it at their speeds, whatever the twist, and stand when they are told to.
void swing_motors(Conformance& c) {
  require_drive(c, PLUMB_JOINT_HAS_MOTORS, "motors");
  constexpr std::array kSpeeds{0.0, 0.5, -0.3};
  JointPair pair(c, PLUMB_JOINT_SWING_TWIST, true, kJointNeeds);
  for (std::size_t k = 0; k < 3; ++k) pair.desc.motors[3 + k] = {kSpeeds[k], 1000, 1, 0};
  const PlumbJoint joint = pair.probe.joint(pair.desc);
  pair.probe.step(30);
  const std::array start{pair.coordinate(3), pair.coordinate(4), pair.coordinate(5)};
  pair.probe.step(60);
  for (std::size_t k = 0; k < 3; ++k) {
    const double moved = pair.coordinate(3 + k) - start[k];
    c.expect(std::abs(moved - kSpeeds[k]) < 0.02, "a motor of {:.1f} rad/s about axis {} moved {:.4f} in 1 s",
             kSpeeds[k], 3 + k, moved);
  }
  std::vector<double> row = pair.probe.read_joint(PLUMB_JOINT_MOTOR, joint);
  row[8] = row[10] = 0;
  pair.probe.write_joint(PLUMB_JOINT_MOTOR, joint, row);
  pair.probe.step(10);
  const double y = pair.coordinate(4), z = pair.coordinate(5);
  pair.probe.step(60);
  const double moved = std::hypot(pair.coordinate(4) - y, pair.coordinate(5) - z);
  c.expect(moved < 0.01, "motors of a swing that were set to 0 moved it on by {:.4f}", moved);
}

}  // namespace

std::span<const Check> drive_checks() {
  static constexpr Check checks[] = {
      {"joints.targets", "a spring comes to rest where it is told to between steps", &targets},
      {"joints.swing_springs", "springs bring a swing and its twist to an orientation", &swing_springs},
      {"joints.swing_stiffness", "a swing's springs by stiffness give way to a weight as they should",
       &swing_stiffness},
      {"joints.swing_motors", "motors turn a swing at their speeds", &swing_motors},
  };
  return checks;
}

}  // namespace plumb::harness::conform
