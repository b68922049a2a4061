// What a joint has pushed with: Jolt's multipliers along the axes that the last step began with.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Constraints/DistanceConstraint.h>
#include <Jolt/Physics/Constraints/FixedConstraint.h>
#include <Jolt/Physics/Constraints/HingeConstraint.h>
#include <Jolt/Physics/Constraints/PointConstraint.h>
#include <Jolt/Physics/Constraints/SliderConstraint.h>

#include "joints/joint.hpp"
#include "plumb/backend/joint_coordinates.hpp"

namespace plumb::jolt {
namespace {

PlumbVec3 axis_of(const PlumbPose& frame, std::size_t axis) {
  return backend::rotate(frame.orientation, {axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0});
}

void add(PlumbVec3& sum, double share, const PlumbVec3& of) { sum = backend::add(sum, backend::scale(share, of)); }

double multiplier(float of) { return static_cast<double>(of); }

JPH::Vec3 as_jolt(const PlumbVec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Across two axes that are square to b's and to a's, as HingeRotationConstraintPart has them.
Impulse of_hinge(const JPH::HingeConstraint& hinge, const Joint& joint) {
  const JPH::Vec3 a = as_jolt(axis_of(joint.at_a, 0)), b = as_jolt(axis_of(joint.at_b, 0));
  const JPH::Vec3 along = b.GetNormalizedPerpendicular(), across = b.Cross(along);
  const JPH::Vector<2> held = hinge.GetTotalLambdaRotation();
  Impulse impulse{to_plumb(hinge.GetTotalLambdaPosition()),
                  to_plumb(held[0] * along.Cross(a) + held[1] * across.Cross(a))};
  add(impulse.torque, multiplier(hinge.GetTotalLambdaRotationLimits() + hinge.GetTotalLambdaMotor()),
      axis_of(joint.at_a, 0));
  return impulse;
}

Impulse of_slider(const JPH::SliderConstraint& slider, const Joint& joint) {
  const JPH::Vector<2> held = slider.GetTotalLambdaPosition();
  Impulse impulse{{}, to_plumb(slider.GetTotalLambdaRotation())};
  add(impulse.force, multiplier(slider.GetTotalLambdaPositionLimits() + slider.GetTotalLambdaMotor()),
      axis_of(joint.at_a, 0));
  add(impulse.force, multiplier(held[0]), axis_of(joint.at_a, 1));
  add(impulse.force, multiplier(held[1]), axis_of(joint.at_a, 2));
  return impulse;
}

Impulse of_distance(const JPH::DistanceConstraint& rod, const Joint& joint) {
  const PlumbVec3 between = backend::sub(joint.at_b.position, joint.at_a.position);
  const double length = backend::length(between);
  Impulse impulse;
  if (length > 0) add(impulse.force, multiplier(rod.GetTotalLambdaPosition()) / length, between);
  return impulse;
}

/// Jolt's limits of turns push one way only, about an axis that points the other way where the lower one is met.
double sign_of_limit(double at, float lower, float upper) {
  const double middle = 0.5 * (static_cast<double>(lower) + static_cast<double>(upper));
  return at < middle ? -1 : 1;
}

/// first, second: frames of Jolt's bodies.
PlumbVec3 held_turns(const JPH::SixDOFConstraint& axes, const PlumbPose& first, const PlumbPose& second) {
  using Axis = JPH::SixDOFConstraintSettings;
  const JPH::Vec3 held = axes.GetTotalLambdaRotation();
  if (axes.IsFixedAxis(Axis::RotationX) && axes.IsFixedAxis(Axis::RotationY) && axes.IsFixedAxis(Axis::RotationZ))
    return to_plumb(held);
  const PlumbQuat seen = backend::multiply(backend::conjugate(first.orientation), second.orientation);
  const PlumbVec3 turns = backend::swing_twist(seen);
  const PlumbPose swung{{}, backend::multiply(first.orientation, backend::turn_of_swing_twist({0, turns.y, turns.z}))};
  const double at[3] = {turns.x, turns.y, turns.z};
  PlumbVec3 torque{};
  const bool one_swing = axes.IsFixedAxis(Axis::RotationY) || axes.IsFixedAxis(Axis::RotationZ);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Axis::EAxis>(Axis::RotationX + k);
    const double share = multiplier(held[static_cast<JPH::uint>(k)]);
    if (k != 0 && !one_swing) continue;
    const double sign =
        axes.IsFixedAxis(axis) ? 1 : sign_of_limit(at[k], axes.GetLimitsMin(axis), axes.GetLimitsMax(axis));
    add(torque, sign * share, axis_of(swung, k));
  }
  const PlumbVec3 swing{0, turns.y, turns.z};
  if (!one_swing && backend::length(swing) > 0)
    add(torque, multiplier(held.GetY()), backend::rotate(first.orientation, backend::normalized(swing)));
  return torque;
}

Impulse of_six_axes(const JPH::SixDOFConstraint& axes, const Joint& joint) {
  using Axis = JPH::SixDOFConstraintSettings;
  const bool swapped = is_swapped(joint.desc);
  const PlumbPose &first = swapped ? joint.at_b : joint.at_a, &second = swapped ? joint.at_a : joint.at_b;
  const JPH::Vec3 held = axes.GetTotalLambdaPosition(), moved = axes.GetTotalLambdaMotorTranslation(),
                  turned = axes.GetTotalLambdaMotorRotation();
  const bool at_a_point = axes.IsFixedAxis(Axis::TranslationX) && axes.IsFixedAxis(Axis::TranslationY) &&
                          axes.IsFixedAxis(Axis::TranslationZ);
  Impulse impulse{at_a_point ? to_plumb(held) : PlumbVec3{}, held_turns(axes, first, second)};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<JPH::uint>(k);
    add(impulse.force, multiplier(moved[i]) + (at_a_point ? 0 : multiplier(held[i])), axis_of(first, k));
    add(impulse.torque, multiplier(turned[i]), axis_of(second, k));
  }
  if (!swapped) return impulse;
  return {backend::scale(-1, impulse.force), backend::scale(-1, impulse.torque)};
}

/// From b's centre of mass to its frame's origin.
Impulse of_meshing(const JPH::TwoBodyConstraint& constraint, const Joint& joint) {
  Impulse impulse = meshing_impulse(constraint);
  const JPH::Body& b = *constraint.GetBody2();
  const PlumbVec3 arm = backend::sub(to_plumb(b.GetCenterOfMassPosition()), joint.at_b.position);
  impulse.torque = backend::add(impulse.torque, backend::cross(arm, impulse.force));
  return impulse;
}

Impulse of(const JPH::TwoBodyConstraint& constraint, const Joint& joint) {
  switch (constraint.GetSubType()) {
    case JPH::EConstraintSubType::Point:
      return {to_plumb(static_cast<const JPH::PointConstraint&>(constraint).GetTotalLambdaPosition()), {}};
    case JPH::EConstraintSubType::Hinge: return of_hinge(static_cast<const JPH::HingeConstraint&>(constraint), joint);
    case JPH::EConstraintSubType::Slider:
      return of_slider(static_cast<const JPH::SliderConstraint&>(constraint), joint);
    case JPH::EConstraintSubType::Distance:
      return of_distance(static_cast<const JPH::DistanceConstraint&>(constraint), joint);
    case JPH::EConstraintSubType::SixDOF:
      return of_six_axes(static_cast<const JPH::SixDOFConstraint&>(constraint), joint);
    case JPH::EConstraintSubType::Fixed: {
      const auto& fixed = static_cast<const JPH::FixedConstraint&>(constraint);
      return {to_plumb(fixed.GetTotalLambdaPosition()), to_plumb(fixed.GetTotalLambdaRotation())};
    }
    default: return of_meshing(constraint, joint);
  }
}

}  // namespace

Impulse reaction(const Joint& joint) {
  if (!joint.enabled) return {};
  Impulse sum = of(*joint.main, joint);
  if (joint.helper == nullptr) return sum;
  const Impulse more = of(*joint.helper, joint);
  return {backend::add(sum.force, more.force), backend::add(sum.torque, more.torque)};
}

}  // namespace plumb::jolt
