#include "generate/random_joint.hpp"

#include <fmt/format.h>

#include <array>

namespace plumb::harness {
namespace {

using referee::Vec3;

std::string next_name(const Imported& imported, const char* what) {
  return fmt::format("{}{}", what, imported.scene.joints.size());
}

/// Of an axis that slides, or turns.
JointAxis random_axis(Chance& chance, const Features& features, bool slides) {
  JointAxis axis;
  if (slides) {
    axis.limits = {-chance.between(0.02, 0.2), chance.between(0.02, 0.2)};  // else it slides out of the world
  } else if (features.has(Feature::limits) && chance.happens(0.6)) {
    axis.limits = {-chance.between(0.05, 1.5), chance.between(0.05, 1.5)};
  }
  if (features.has(Feature::friction) && chance.happens(0.6))
    axis.friction = slides ? chance.by_ratio(0.5, 500) : chance.by_ratio(0.05, 50);
  if (features.has(Feature::springs) && chance.happens(0.5)) {
    axis.stiffness = slides ? chance.by_ratio(50, 5e4) : chance.by_ratio(1, 1000);
    axis.damping = axis.stiffness * chance.by_ratio(1e-3, 0.3);
  }
  return axis;
}

/// A motor in place of what resists: it does not stand still.
void drive(Imported& imported, Chance& chance, std::size_t axis) {
  PlumbMotor& motor = imported.scene.joints.back().desc.motors[axis];
  const bool slides = axis < 3;
  motor.enabled = 1;
  motor.target_velocity = slides ? chance.between(-0.5, 0.5) : chance.between(-3, 3);
  motor.max_force = slides ? chance.by_ratio(10, 1000) : chance.by_ratio(1, 200);
}

void add_generic(Imported& imported, Chance& chance, const JointPlace& place) {
  add_joint(imported, next_name(imported, "generic"), place, {});
  PlumbJointDesc& desc = imported.scene.joints.back().desc;
  const auto limit = [&](std::size_t axis, double most) {
    desc.axis_modes[axis] = PLUMB_AXIS_LIMITED;
    desc.limits[axis] = {-chance.between(0.1 * most, most), chance.between(0.1 * most, most), 1, 0};
  };
  for (std::size_t axis = 0; axis < 6; ++axis) desc.axis_modes[axis] = PLUMB_AXIS_LOCKED;
  if (chance.happens(0.4)) limit(chance.below(3), 0.2);
  for (std::size_t axis = 3; axis < 6; ++axis) {
    if (chance.happens(0.3)) limit(axis, 1);
  }
  if (chance.happens(0.5)) desc.axis_modes[3] = PLUMB_AXIS_FREE, desc.limits[3] = {};
}

void add_socket(Imported& imported, Chance& chance, const Features& features, JointPlace place) {
  place.type = PLUMB_JOINT_SWING_TWIST;
  std::vector<JointAxis> axes;
  for (int i = 0; i < 3; ++i) axes.push_back(random_axis(chance, features, false));
  // Always a cone: what swings as far as half a turn has no twist that stops or springs could hold.
  const double half_y = chance.between(0.1, 2.5), half_z = chance.happens(0.5) ? half_y : chance.between(0.1, 2.5);
  axes[1].limits = {-half_y, half_y};
  axes[2].limits = {-half_z, half_z};
  add_joint(imported, next_name(imported, "socket"), place, axes);
  if (features.has(Feature::motors) && chance.happens(0.4)) drive(imported, chance, 3 + chance.below(3));
}

}  // namespace

void add_random_joint(Imported& imported, Chance& chance, const Features& features, const JointSite& site) {
  struct Kind {
    PlumbJointType type;
    const char* name;
    std::size_t first, axes;  ///< those that move and can be more than free
    bool is_allowed;
  };
  const std::array kinds{Kind{PLUMB_JOINT_HINGE, "hinge", 3, 1, true},
                         Kind{PLUMB_JOINT_BALL, "ball", 3, 0, true},
                         Kind{PLUMB_JOINT_UNIVERSAL, "universal", 3, 2, true},
                         Kind{PLUMB_JOINT_FIXED, "fixed", 3, 0, true},
                         Kind{PLUMB_JOINT_SLIDER, "slider", 0, 1, features.has(Feature::limits)},
                         Kind{PLUMB_JOINT_GENERIC, "generic", 3, 0, features.has(Feature::generic)}};
  std::size_t which = chance.below(kinds.size());
  if (!kinds[which].is_allowed) which = 0;
  const Kind& kind = kinds[which];
  const JointPlace place{kind.type, site.body_a, site.body_b, frame_of(site.anchor, chance.direction()), kind.first};
  if (kind.type == PLUMB_JOINT_GENERIC) return add_generic(imported, chance, place);
  if (kind.type == PLUMB_JOINT_BALL && features.has(Feature::sockets))
    return add_socket(imported, chance, features, place);
  std::vector<JointAxis> axes;
  for (std::size_t i = 0; i < kind.axes; ++i) axes.push_back(random_axis(chance, features, kind.first == 0));
  add_joint(imported, next_name(imported, kind.name), place, axes);
  if (features.has(Feature::motors) && kind.axes > 0 && chance.happens(0.4)) drive(imported, chance, kind.first);
}

void add_loop(Imported& imported, Chance& chance, std::size_t body_a, std::size_t body_b) {
  const auto& bodies = imported.scene.bodies;
  const Vec3 a = referee::vec(bodies[body_a].desc.pose.position), b = referee::vec(bodies[body_b].desc.pose.position);
  const std::array types{PLUMB_JOINT_DISTANCE, PLUMB_JOINT_BALL, PLUMB_JOINT_FIXED};
  const PlumbJointType type = types[chance.below(types.size())];
  add_joint(imported, next_name(imported, "loop"), {type, body_a, body_b, frame_of((a + b) / 2, chance.direction())},
            {});
  if (type != PLUMB_JOINT_DISTANCE) return;
  PlumbJointDesc& rod = imported.scene.joints.back().desc;
  rod.frame_a = rod.frame_b = identity_pose();
  rod.rest_length = (b - a).norm();
  rod.collide_connected = 1;
}

}  // namespace plumb::harness
