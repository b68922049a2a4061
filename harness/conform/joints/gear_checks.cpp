// Gears and racks: what two bodies on joints of their own do keeps its ratio, and a blow upon one moves both as one.
#include <array>
#include <cmath>

#include "conform/joints/joint_pair.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace {

void require_meshing(Conformance& c, PlumbJointType type, PlumbJointType of_b) {
  c.require_needs(kJointNeeds);
  for (const PlumbJointType needed : {type, PlumbJointType{PLUMB_JOINT_HINGE}, of_b})
    c.require(PLUMB_CAP_JOINT, needed, 0, backend::joint_name(needed));
}

/// Of b on a joint to the world, which holds it where it is.
PlumbJointDesc hold(PlumbJointType type, PlumbBody body, const Vec& at) {
  PlumbJointDesc desc = joint_desc(type);
  desc.body_b = body;
  desc.frame_a.position = vec3(at);
  return desc;
}

/// Angle by which a body has turned about x since it was put down, whole turns counted; to be asked at every step.
class TurnAboutX {
 public:
  double at(const Eigen::Quaterniond& orientation) {
    const double angle = 2 * std::atan2(orientation.x(), orientation.w());
    turned_ += std::remainder(angle - last_, 2 * std::numbers::pi);
    last_ = angle;
    return turned_;
  }

 private:
  double turned_ = 0, last_ = 0;
};

/// Two cubes turn about x side by side. A blow turns the first: what it gets of it is what it gets where the other's
/// moment counts by the square of the ratio. Then a torque turns both to and fro, and their turns keep the ratio.
void gear(Conformance& c) {
  require_meshing(c, PLUMB_JOINT_GEAR, PLUMB_JOINT_HINGE);
  const PlumbNeeds needs = kJointNeeds | c.available(PLUMB_NEED_FORCES);
  for (const double ratio : {2.0, -0.5}) {
    JointPair pair(c, PLUMB_JOINT_GEAR, false, needs);
    pair.probe.joint(hold(PLUMB_JOINT_HINGE, pair.a, {0, 0, 0}));
    pair.probe.joint(hold(PLUMB_JOINT_HINGE, pair.b, {1, 0, 0}));
    pair.desc.ratio = ratio;
    pair.probe.joint(pair.desc);
    pair.probe.write(PLUMB_FIELD_VELOCITY, pair.a, {0, 0, 0, 3, 0, 0});
    pair.probe.step(2);
    const double a = pair.probe.angular_velocity(pair.a).x(), b = pair.probe.angular_velocity(pair.b).x();
    const double wanted = 3 * ratio * ratio / (1 + ratio * ratio);
    c.expect(std::abs(a - wanted) < 0.03 && std::abs(b + wanted / ratio) < 0.03,
             "a gear of {} shares 3 rad/s as {:.4f} and {:.4f} rad/s instead of {:.4f} and {:.4f}", ratio, a, b, wanted,
             -wanted / ratio);
    if (!pair.probe.declares(PLUMB_NEED_FORCES)) continue;
    TurnAboutX turn_a, turn_b;
    const double start = turn_a.at(pair.probe.orientation(pair.a)) + ratio * turn_b.at(pair.probe.orientation(pair.b));
    double slip = 0;
    for (int i = 0; i < 300; ++i) {
      pair.probe.write(PLUMB_FIELD_TORQUE, pair.a, {i % 100 < 50 ? 20.0 : -20.0, 0, 0});
      pair.probe.step();
      const double sum = turn_a.at(pair.probe.orientation(pair.a)) + ratio * turn_b.at(pair.probe.orientation(pair.b));
      slip = std::max(slip, std::abs(sum - start));
    }
    c.expect(slip < 0.02, "wheels with a gear of {} slip by {:.4f} rad within 5 s", ratio, slip);
  }
}

/// A cube slides along x on a slider and turns another, which is in the way of nothing, about z.
void rack(Conformance& c) {
  require_meshing(c, PLUMB_JOINT_RACK_AND_PINION, PLUMB_JOINT_SLIDER);
  for (const double ratio : {4.0, -1.5}) {
    JointPair pair(c, PLUMB_JOINT_RACK_AND_PINION, false, kJointNeeds);
    const double half = std::sqrt(0.5);
    const PlumbQuat x_to_z{0, -half, 0, half};
    PlumbJointDesc axle = hold(PLUMB_JOINT_HINGE, pair.a, {0, 0, 0});
    axle.frame_a.orientation = axle.frame_b.orientation = x_to_z;
    pair.probe.joint(axle);
    pair.probe.joint(hold(PLUMB_JOINT_SLIDER, pair.b, {1, 0, 0}));
    pair.desc.ratio = ratio;
    pair.desc.frame_a = {{0, 0, 0}, x_to_z};
    pair.desc.frame_b = {{0, 0, 0}, {0, 0, 0, 1}};
    pair.probe.joint(pair.desc);
    pair.probe.write(PLUMB_FIELD_VELOCITY, pair.b, {1, 0, 0, 0, 0, 0});
    pair.probe.step(2);
    // A cube's moment is m s^2 / 6, with s = .5 m.
    const double wanted = 1 / (1 + ratio * ratio * 0.25 / 6);
    const double way = pair.probe.velocity(pair.b).x(), turn = pair.probe.angular_velocity(pair.a).z();
    c.expect(std::abs(way - wanted) < 0.01 && std::abs(turn - ratio * wanted) < 0.01 * std::abs(ratio),
             "a rack of {} rad/m shares 1 m/s as {:.4f} m/s and {:.4f} rad/s instead of {:.4f} and {:.4f}", ratio, way,
             turn, wanted, ratio * wanted);
    pair.probe.step(120);
    const double moved = pair.probe.position(pair.b).x() - 1;
    TurnAboutX about;
    const Eigen::Quaterniond seen = pair.probe.orientation(pair.a);
    const double turned = about.at(Eigen::Quaterniond(seen.w(), seen.z(), 0, 0));
    const double off = std::remainder(turned - ratio * moved, 2 * std::numbers::pi);
    c.expect(std::abs(off) < 0.02, "after {:.3f} m a rack of {} rad/m is {:.4f} rad off", moved, ratio, off);
  }
}

}  // namespace

std::span<const Check> gear_checks() {
  static constexpr Check checks[] = {
      {"joints.gear", "two wheels turn as their teeth demand", &gear},
      {"joints.rack", "a rack turns its pinion", &rack},
  };
  return checks;
}

}  // namespace plumb::harness::conform
