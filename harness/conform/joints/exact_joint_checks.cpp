// Closed forms at tight tolerances: motors, limits, springs, reactions and gaps of joints. Asked of what is claimed as
// native or emulated.
#include "conform/joints/joint_pair.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace exact {
namespace {

using backend::joint_name;

/// Calls check_one for hinge and slider where the feature is claimed as more than an approximation.
template <class CheckOne>
void hinge_and_slider(Conformance& c, PlumbNeeds needs, PlumbJointFeature feature, const char* what,
                      CheckOne&& check_one) {
  c.require_needs(needs);
  bool any = false;
  for (const PlumbJointType type : {PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER}) {
    if (!c.is_exact(PLUMB_CAP_JOINT, type) || !c.is_exact(PLUMB_CAP_JOINT_FEATURE, type, feature)) continue;
    any = true;
    check_one(type, type == PLUMB_JOINT_HINGE ? std::size_t{3} : std::size_t{0});
  }
  if (!any) c.require_exact(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_HINGE, feature, what);
}

void motors(Conformance& c) {
  hinge_and_slider(c, kJointNeeds, PLUMB_JOINT_HAS_MOTORS, "motors", [&](PlumbJointType type, std::size_t axis) {
    JointPair fast(c, type, true, kJointNeeds);
    fast.desc.motors[axis] = {0.8, 1e5, 1, 0};
    fast.probe.joint(fast.desc);
    fast.probe.step(30);
    const double before = fast.coordinate(axis);
    fast.probe.step(60);
    const double speed = fast.coordinate(axis) - before;
    c.expect(std::abs(speed - 0.8) < 0.005, "a {} motor of .8 a second runs at {:.5f}", joint_name(type), speed);

    JointPair weak(c, type, true, kJointNeeds);
    const std::vector<double> mass = weak.probe.read(PLUMB_FIELD_MASS, weak.b);
    const double resistance =
        type == PLUMB_JOINT_HINGE ? mass[4] : mass[0];     // the axis goes through the centre of mass
    weak.desc.motors[axis] = {100, 2 * resistance, 1, 0};  // 2 per second squared
    weak.probe.joint(weak.desc);
    weak.probe.step(30);
    const double first = weak.coordinate(axis);
    weak.probe.step(1);
    const double rate = (weak.coordinate(axis) - first) * 60;  // after 30.5 or 31 steps, by the integrator
    c.expect(std::abs(rate - 2 * 30.75 / 60) < 0.02,
             "a {} motor of bounded force runs at {:.5f} after .5 s instead of "
             "{:.5f}",
             joint_name(type), rate, 2 * 30.75 / 60);
  });
}

void limits(Conformance& c) {
  hinge_and_slider(c, kJointNeeds | PLUMB_NEED_FORCES, PLUMB_JOINT_HAS_LIMITS, "limits",
                   [&](PlumbJointType type, std::size_t axis) {
                     for (const double sign : {1.0, -1.0}) {
                       JointPair pair(c, type, true, kJointNeeds | PLUMB_NEED_FORCES);
                       pair.desc.limits[axis] = {-0.25, 0.35, 1, 0};
                       pair.probe.joint(pair.desc);
                       for (int i = 0; i < 240; ++i) {
                         pair.probe.write(type == PLUMB_JOINT_HINGE ? PLUMB_FIELD_TORQUE : PLUMB_FIELD_FORCE, pair.b,
                                          {sign * 10, 0, 0});
                         pair.probe.step();
                       }
                       const double stop = sign > 0 ? 0.35 : -0.25;
                       c.expect(std::abs(pair.coordinate(axis) - stop) < 0.004,
                                "a {} joint pressed against its stop at {} is at {:.5f}", joint_name(type), stop,
                                pair.coordinate(axis));
                     }
                   });
}

/// A spring of 1 Hz and a fifth of critical damping: the time between its passes, and how each swing shrinks.
void springs(Conformance& c) {
  hinge_and_slider(c, kJointNeeds, PLUMB_JOINT_HAS_SPRINGS, "springs", [&](PlumbJointType type, std::size_t axis) {
    constexpr double kRatio = 0.2, kRest = 0.3, kShort = 1.0 / 240;
    JointPair pair(c, type, true, kJointNeeds);
    pair.desc.springs[axis] = {kRest, 1, kRatio, 1, 0};
    pair.probe.joint(pair.desc);
    double before = pair.coordinate(axis) - kRest, low = before, high = before, first = 0, last = 0;
    int passes = 0;
    for (int i = 1; i <= 480; ++i) {
      pair.probe.step(1, kShort);
      const double now = pair.coordinate(axis) - kRest;
      if (before * now < 0) {
        last = (i - 1 + before / (before - now)) * kShort;
        if (passes++ == 0) first = last;
      }
      if (i <= 180) high = std::max(high, now);
      if (i > 180 && i <= 300) low = i == 181 ? now : std::min(low, now);
      before = now;
    }
    const double damped = std::sqrt(1 - kRatio * kRatio), rate = passes < 2 ? 0 : (passes - 1) / (2 * (last - first));
    c.expect(std::abs(rate / damped - 1) < 0.01,
             "a {} spring of 1 Hz, damped by {}, swings at {:.5f} Hz instead of "
             "{:.5f}",
             joint_name(type), kRatio, rate, damped);
    // From one extreme to the next it shrinks by exp(-pi ratio / sqrt(1 - ratio^2)).
    const double ratio = std::log(high / -low) * damped / M_PI;
    c.expect(std::abs(ratio - kRatio) < 0.025, "a {} spring damped by {} of critical swings as with {:.4f}",
             joint_name(type), kRatio, ratio);
  });
}

/// Of a hinge or slider with a spring by stiffness k and damping c: how b moves, mass m or moment I about the axis.
struct StiffPair : JointPair {
  double inertia = 0;
  std::size_t axis;

  StiffPair(Conformance& c, PlumbJointType type, std::size_t driven)
      : JointPair(c, type, true, kJointNeeds), axis(driven) {
    const std::vector<double> mass = probe.read(PLUMB_FIELD_MASS, b);
    inertia = type == PLUMB_JOINT_HINGE ? mass[4] : mass[0];  // the axis goes through the centre of mass
  }
  void spring(double rest, double rate, double decay) {
    desc.springs[axis] = {rest, inertia * rate * rate, inertia * decay, 1, PLUMB_SPRING_STIFFNESS};
    probe.joint(desc);
  }
};

/// x'' + c x' + k (x - rest) = 0 per mass: a damper brakes exp(-c t), a spring swings with sqrt(k).
void stiffness(Conformance& c) {
  constexpr double kShort = 1.0 / 240;
  hinge_and_slider(
      c, kJointNeeds, PLUMB_JOINT_HAS_STIFFNESS, "springs by stiffness", [&](PlumbJointType type, std::size_t axis) {
        StiffPair damper(c, type, axis);
        damper.probe.write(
            PLUMB_FIELD_VELOCITY, damper.b,
            type == PLUMB_JOINT_HINGE ? std::vector<double>{0, 0, 0, 2, 0, 0} : std::vector<double>{2, 0, 0, 0, 0, 0});
        damper.spring(0, 0, 1.5);
        damper.probe.step(240, kShort);
        const double gone = 2 / 1.5 * (1 - std::exp(-1.5));
        c.expect(std::abs(damper.coordinate(axis) / gone - 1) < 0.01,
                 "a {} joint with a damper goes {:.5f} in a second instead of {:.5f}", joint_name(type),
                 damper.coordinate(axis), gone);

        StiffPair spring(c, type, axis);
        constexpr double kRest = 0.3, kRate = 2 * M_PI;
        spring.spring(kRest, kRate, 0);
        spring.probe.step(300, kShort);  // a period and a quarter: it passes its rest
        const double before = spring.coordinate(axis) - kRest;
        spring.probe.step(1, kShort);
        const double speed = (spring.coordinate(axis) - kRest - before) / kShort;
        c.expect(std::abs(before) < 0.02 && std::abs(speed / (kRest * kRate) - 1) < 0.12,
                 "a {} spring of 1 Hz by stiffness is {:.5f} from its rest after 1.25 s, at {:.5f} a second",
                 joint_name(type), before, speed);
      });
}

/// A weight that hangs: the reaction is its weight and nothing else, and the frames lie on each other.
void hanging(Conformance& c) {
  const PlumbNeeds needs = kJointNeeds | PLUMB_NEED_JOINT_REACTIONS;
  c.require_needs(needs);
  c.require_exact(PLUMB_CAP_JOINT, PLUMB_JOINT_BALL, 0, "ball joints");
  c.require_exact(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_BALL, PLUMB_JOINT_HAS_REACTION, "reactions");
  for (const PlumbJointType type : {PLUMB_JOINT_BALL, PLUMB_JOINT_HINGE}) {
    if (!c.is_exact(PLUMB_CAP_JOINT, type)) continue;
    JointPair pair(c, type, true, needs, {0, -9.81, 0});
    pair.desc.frame_a.position = {1, 0.5, 0};
    pair.desc.frame_b.position = {0, 0.5, 0};
    const PlumbJoint joint = pair.probe.joint(pair.desc);
    pair.probe.seconds(2);
    const std::vector<double> row = pair.probe.read_joint(PLUMB_JOINT_REACTION, joint);
    const double weight = 125 * 9.81;
    c.expect((Vec(row[0], row[1], row[2]) - Vec(0, weight, 0)).norm() < 0.005 * weight,
             "a {} joint that carries {:.3f} N says ({:.3f}, {:.3f}, {:.3f})", joint_name(type), weight, row[0], row[1],
             row[2]);
    c.expect(pair.error().position < 1e-3, "a {} joint with a weight at rest gapes by {:.6f} m", joint_name(type),
             pair.error().position);
  }
}

/// A weight on a rod without mass hangs at the rod's length.
void distance(Conformance& c) {
  c.require_needs(kJointNeeds);
  c.require_exact(PLUMB_CAP_JOINT, PLUMB_JOINT_DISTANCE, 0, "distance joints");
  JointPair pair(c, PLUMB_JOINT_DISTANCE, true, kJointNeeds, {0, -9.81, 0});
  pair.desc.frame_a.position = {1, 0.75, 0};
  pair.desc.rest_length = 0.75;
  pair.probe.joint(pair.desc);
  pair.probe.seconds(2);
  const double length = (pair.probe.position(pair.b) - Vec(1, 0.75, 0)).norm();
  c.expect(std::abs(length - 0.75) < 1e-3, "a rod of .75 m holds a weight at {:.6f} m", length);
}

/// It holds four fifths of what breaks it and lets go of five fourths.
void breaking(Conformance& c) {
  const PlumbNeeds needs = kJointNeeds | PLUMB_NEED_EVENTS;
  c.require_needs(needs);
  c.require_exact(PLUMB_CAP_JOINT, PLUMB_JOINT_BALL, 0, "ball joints");
  c.require_exact(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_BALL, PLUMB_JOINT_BREAKS, "break force");
  for (const double factor : {0.8, 1.25}) {
    JointPair pair(c, PLUMB_JOINT_BALL, true, needs, {0, -9.81, 0});
    pair.desc.frame_a.position = {1, 0, 0};
    pair.desc.frame_b.position = {0, 0, 0};
    pair.desc.break_force = factor * 125 * 9.81;
    pair.probe.joint(pair.desc);
    pair.probe.seconds(1);
    const bool broken = pair.probe.position(pair.b).y() < -1;
    c.expect(broken == (factor < 1), "a joint that breaks at {} times its load {}", factor, broken ? "broke" : "held");
  }
}

}  // namespace
}  // namespace exact

std::span<const Check> exact_joint_checks() {
  static constexpr Check checks[] = {
      {"exact.motors", "speed within .6 %, and the acceleration of a bounded force", &exact::motors},
      {"exact.limits", "pressed against a stop: within 4 mm or mrad", &exact::limits},
      {"exact.springs", "frequency within 1 %, damping within .025", &exact::springs},
      {"exact.stiffness", "springs by stiffness: a damper and a period within 1 %", &exact::stiffness},
      {"exact.reactions", "a hanging weight within .5 %, without a gap", &exact::hanging},
      {"exact.distance", "the length of a loaded rod", &exact::distance},
      {"exact.break", "holds at .8 of its break force, breaks at 1.25", &exact::breaking},
  };
  return checks;
}

}  // namespace plumb::harness::conform
