// Swing-twist joints: what they tell of a turn, and the cone and the twist that bound it.
#include <array>
#include <cmath>
#include <numbers>

#include "conform/joints/joint_pair.hpp"

namespace plumb::harness::conform {
namespace {

void require_swing_twist(Conformance& c) {
  c.require_needs(kJointNeeds);
  c.require(PLUMB_CAP_JOINT, PLUMB_JOINT_SWING_TWIST, 0, "swing-twist joint");
}

void require_limits(Conformance& c) {
  require_swing_twist(c);
  c.require(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_SWING_TWIST, PLUMB_JOINT_HAS_LIMITS, "limits");
}

/// A cube is put down in turns that are made of a twist and a swing: the joint tells both.
void coordinates(Conformance& c) {
  require_swing_twist(c);
  for (const double twist : {-2.5, 0.0, 0.4}) {
    for (const std::array swing :
         {std::array{0.0, 0.0}, std::array{0.6, 0.0}, std::array{-0.9, 1.2}, std::array{0.3, -2.0}}) {
      JointPair pair(c, PLUMB_JOINT_SWING_TWIST, true, kJointNeeds);
      const Vec about(0, swing[0], swing[1]);
      const double angle = about.norm();
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, angle > 0 ? Vec(about / angle) : Vec::UnitY()) *
                                    Eigen::AngleAxisd(twist, Vec::UnitX()));
      const Vec at = Vec(0.5, 0, 0) + turn * Vec(0.5, 0, 0);
      pair.probe.write(PLUMB_FIELD_POSE, pair.b, {at.x(), at.y(), at.z(), turn.x(), turn.y(), turn.z(), turn.w()});
      const std::vector<double> row = pair.probe.read_joint(PLUMB_JOINT_COORDINATES, pair.probe.joint(pair.desc));
      c.expect(std::abs(row[3] - twist) + std::abs(row[4] - swing[0]) + std::abs(row[5] - swing[1]) < 1e-4,
               "twisted by {:.2f} and swung by ({:.2f}, {:.2f}) it says {:.4f} and ({:.4f}, {:.4f})", twist, swing[0],
               swing[1], row[3], row[4], row[5]);
    }
  }
}

/// A torque about x twists against either stop.
void twist_limits(Conformance& c) {
  require_limits(c);
  c.require_needs(kJointNeeds | PLUMB_NEED_FORCES);
  for (const double sign : {1.0, -1.0}) {
    JointPair pair(c, PLUMB_JOINT_SWING_TWIST, true, kJointNeeds | PLUMB_NEED_FORCES);
    pair.desc.limits[3] = {-0.3, 0.5, 1, 0};
    pair.probe.joint(pair.desc);
    for (int i = 0; i < 180; ++i) {
      pair.probe.write(PLUMB_FIELD_TORQUE, pair.b, {sign * 20, 0, 0});
      pair.probe.step();
    }
    const double stop = sign > 0 ? 0.5 : -0.3, at = pair.coordinate(3);
    c.expect(std::abs(at - stop) < 0.03, "twisted against its stop at {} it is at {:.4f}", stop, at);
  }
}

/// Gravity in many directions across its axis presses what hangs in a cone against it, where it stays.
void check_cone(Conformance& c, double half_y, double half_z) {
  for (int k = 0; k < 8; ++k) {
    const double way = 2 * std::numbers::pi * (k + 0.3) / 8;
    JointPair pair(c, PLUMB_JOINT_SWING_TWIST, true, kJointNeeds, {0, 5 * std::cos(way), 5 * std::sin(way)});
    pair.desc.limits[4] = {-half_y, half_y, 1, 0};
    pair.desc.limits[5] = {-half_z, half_z, 1, 0};
    pair.probe.joint(pair.desc);
    double beyond = 0;
    for (int i = 0; i < 180; ++i) {
      pair.probe.step();
      beyond = std::max(beyond, pair.error().limit_angle);
    }
    const double y = pair.coordinate(4), z = pair.coordinate(5);
    c.expect(beyond < 0.05, "swung against a cone of {} by {} rad it goes {:.4f} rad beyond", half_y, half_z, beyond);
    c.expect(std::abs(std::hypot(y / half_y, z / half_z) - 1) < 0.05,
             "pressed against a cone of {} by {} rad it is at ({:.4f}, {:.4f})", half_y, half_z, y, z);
  }
}

void round_cone(Conformance& c) {
  require_limits(c);
  check_cone(c, 0.6, 0.6);
}

void elliptic_cone(Conformance& c) {
  require_limits(c);
  if (c.backend().capability(PLUMB_CAP_JOINT, PLUMB_JOINT_SWING_TWIST) == PLUMB_APPROXIMATE)
    throw Skipped{"its elliptic cones are approximate, or there are none"};
  check_cone(c, 0.4, 0.9);
}

}  // namespace

std::span<const Check> swing_twist_checks() {
  static constexpr Check checks[] = {
      {"joints.swing_twist", "a joint tells a turn as a swing after a twist", &coordinates},
      {"joints.twist_limits", "stops of the twist of a swing-twist joint", &twist_limits},
      {"joints.cone", "what swings in a round cone stays in it", &round_cone},
      {"joints.elliptic_cone", "likewise in a cone that is wider one way than the other", &elliptic_cone},
  };
  return checks;
}

}  // namespace plumb::harness::conform
