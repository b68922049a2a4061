// Joints by PhysX's D6, which takes turns apart into a twist about x and, after it, a swing.
#include <algorithm>
#include <numbers>

#include "joints/joint.hpp"
#include "plumb/backend/usual_capability.hpp"
#include "start.hpp"

namespace plumb::px {
namespace {

constexpr double kLeastRange = 1e-6;
/// rad: PhysX's limits of swings stay below half a turn.
constexpr double kMostSwing = std::numbers::pi - 0.01;

PlumbAxisMode mode_of(const PlumbJointDesc& desc, std::size_t axis) {
  if (desc.type == PLUMB_JOINT_GENERIC) return desc.axis_modes[axis];
  if ((backend::free_axes(desc.type) >> axis & 1) == 0) return PLUMB_AXIS_LOCKED;
  return desc.limits[axis].enabled != 0 ? PLUMB_AXIS_LIMITED : PLUMB_AXIS_FREE;
}

struct Range {
  double lower, upper;
};

/// As PhysX's first body sees it.
Range range_of(const PlumbJointDesc& desc, std::size_t axis, double most) {
  if (mode_of(desc, axis) == PLUMB_AXIS_FREE) return {-most, most};
  const PlumbLimit& limit = desc.limits[axis];
  const Range seen = is_swapped(desc) ? Range{-limit.upper, -limit.lower} : Range{limit.lower, limit.upper};
  const double lower = std::clamp(seen.lower, -most, most - kLeastRange);
  return {lower, std::clamp(seen.upper, lower + kLeastRange, most)};
}

PxD6Joint* create(const PlumbJointDesc& desc, const Ends& ends) {
  PxD6Joint* made = is_swapped(desc) ? PxD6JointCreate(physics(), ends.b, ends.frame_b, ends.a, ends.frame_a)
                                     : PxD6JointCreate(physics(), ends.a, ends.frame_a, ends.b, ends.frame_b);
  if (made == nullptr) throw Error(PLUMB_E_OUT_OF_MEMORY, "PhysX makes no joint of six axes" + because());
  return made;
}

/// Where one swing has limits and the other is free, PhysX wants limits of both.
void limit_swings(PxD6Joint& native, const PlumbJointDesc& desc) {
  const PlumbAxisMode y = mode_of(desc, 4), z = mode_of(desc, 5);
  if (y != PLUMB_AXIS_LIMITED && z != PLUMB_AXIS_LIMITED) return;
  if (desc.type == PLUMB_JOINT_SWING_TWIST) {
    native.setSwingLimit(PxJointLimitCone(number(std::min(desc.limits[4].upper, kMostSwing)),
                                          number(std::min(desc.limits[5].upper, kMostSwing))));
  } else {
    const Range about_y = range_of(desc, 4, kMostSwing), about_z = range_of(desc, 5, kMostSwing);
    native.setPyramidSwingLimit(PxJointLimitPyramid(number(about_y.lower), number(about_y.upper), number(about_z.lower),
                                                    number(about_z.upper)));
  }
  if (y != PLUMB_AXIS_LOCKED) native.setMotion(PxD6Axis::eSWING1, PxD6Motion::eLIMITED);
  if (z != PLUMB_AXIS_LOCKED) native.setMotion(PxD6Axis::eSWING2, PxD6Motion::eLIMITED);
}

PxD6JointDrive drive_of(const PlumbSpring& spring) {
  const double circular = 2 * std::numbers::pi * spring.frequency;
  PxD6JointDrive drive(number(circular * circular), number(2 * spring.damping_ratio * circular), PX_MAX_F32, true);
  if (spring.mode == PLUMB_SPRING_STIFFNESS)
    drive = {number(spring.frequency), number(spring.damping_ratio), PX_MAX_F32, false};
  drive.flags |= PxD6JointDriveFlag::eOUTPUT_FORCE;
  return drive;
}

}  // namespace

bool takes_six_axes(const PlumbJointDesc& desc) {
  switch (desc.type) {
    case PLUMB_JOINT_BALL:
      return std::any_of(desc.limits + 3, desc.limits + 6, [](const PlumbLimit& limit) { return limit.enabled != 0; });
    case PLUMB_JOINT_SLIDER: return desc.springs[0].enabled != 0;
    case PLUMB_JOINT_UNIVERSAL:
    case PLUMB_JOINT_GENERIC:
    case PLUMB_JOINT_SWING_TWIST: return true;
    default: return false;
  }
}

/// Ways are along the axes of our first body, and it comes first. Turns of ours are about x first, as of PhysX's if it
/// sees them the other way.
bool is_swapped(const PlumbJointDesc& desc) {
  if (desc.type == PLUMB_JOINT_SWING_TWIST || backend::is_meshing(desc.type) || desc.type == PLUMB_JOINT_DISTANCE)
    return false;
  return mode_of(desc, 0) == PLUMB_AXIS_LOCKED && mode_of(desc, 1) == PLUMB_AXIS_LOCKED &&
         mode_of(desc, 2) == PLUMB_AXIS_LOCKED;
}

PxD6Joint* make_six_axes(const PlumbJointDesc& desc, const Ends& ends) {
  PxD6Joint& made = *create(desc, ends);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const auto at = static_cast<PxD6Axis::Enum>(axis);
    const PlumbAxisMode mode = mode_of(desc, axis);
    made.setMotion(at, mode == PLUMB_AXIS_LOCKED    ? PxD6Motion::eLOCKED
                       : mode == PLUMB_AXIS_LIMITED ? PxD6Motion::eLIMITED
                                                    : PxD6Motion::eFREE);
    if (mode != PLUMB_AXIS_LIMITED) continue;
    if (axis < 3) {
      const Range range = range_of(desc, axis, 1e30);
      made.setLinearLimit(
          at, PxJointLinearLimitPair(physics().getTolerancesScale(), number(range.lower), number(range.upper)));
    } else if (axis == 3) {
      const Range range = range_of(desc, axis, std::numbers::pi);
      made.setTwistLimit(PxJointAngularLimitPair(number(range.lower), number(range.upper)));
    }
  }
  limit_swings(made, desc);
  return &made;
}

void drive_six_axes(PxD6Joint& native, const PlumbJointDesc& desc) {
  constexpr PxD6Drive::Enum drives[3] = {PxD6Drive::eX, PxD6Drive::eY, PxD6Drive::eZ};
  PxTransform rest(PxIdentity);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool held = desc.springs[axis].enabled != 0;
    native.setDrive(drives[axis], held ? drive_of(desc.springs[axis]) : PxD6JointDrive());
    if (held) rest.p[static_cast<PxU32>(axis)] = number(desc.springs[axis].rest);
  }
  native.setDrivePosition(rest);
}

}  // namespace plumb::px
