// Joints for which Jolt has a constraint of its own: ball, hinge, slider, distance, fixed.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Constraints/DistanceConstraint.h>
#include <Jolt/Physics/Constraints/FixedConstraint.h>
#include <Jolt/Physics/Constraints/HingeConstraint.h>
#include <Jolt/Physics/Constraints/PointConstraint.h>
#include <Jolt/Physics/Constraints/SliderConstraint.h>

#include <algorithm>
#include <numbers>

#include "joints/joint.hpp"

namespace plumb::jolt {
namespace {

using Made = JPH::Ref<JPH::TwoBodyConstraint>;
constexpr auto kLocal = JPH::EConstraintSpace::LocalToBodyCOM;

Made make_ball(const Ends& ends) {
  JPH::PointConstraintSettings settings;
  settings.mSpace = kLocal;
  settings.mPoint1 = JPH::RVec3(Frame(ends.frame_a).origin);
  settings.mPoint2 = JPH::RVec3(Frame(ends.frame_b).origin);
  return settings.Create(ends.a, ends.b);
}

Made make_hinge(const PlumbJointDesc& desc, const Ends& ends) {
  const double half = zero_of(desc.limits[3]) / 2;
  const PlumbQuat turn{std::sin(half), 0, 0, std::cos(half)};
  const Frame a({ends.frame_a.position, backend::multiply(ends.frame_a.orientation, turn)}), b(ends.frame_b);
  JPH::HingeConstraintSettings settings;
  settings.mSpace = kLocal;
  settings.mPoint1 = JPH::RVec3(a.origin);
  settings.mPoint2 = JPH::RVec3(b.origin);
  settings.mHingeAxis1 = a.x;
  settings.mHingeAxis2 = b.x;
  settings.mNormalAxis1 = a.y;
  settings.mNormalAxis2 = b.y;
  const AxisLimits limits = hinge_limits(desc);
  settings.mLimitsMin = limits.lower;
  settings.mLimitsMax = limits.upper;
  return settings.Create(ends.a, ends.b);
}

Made make_slider(const PlumbJointDesc& desc, const Ends& ends) {
  const Frame a(backend::compose(ends.frame_a, {{zero_of(desc.limits[0]), 0, 0}, {0, 0, 0, 1}})), b(ends.frame_b);
  JPH::SliderConstraintSettings settings;
  settings.mSpace = kLocal;
  settings.mPoint1 = JPH::RVec3(a.origin);
  settings.mPoint2 = JPH::RVec3(b.origin);
  settings.mSliderAxis1 = a.x;
  settings.mSliderAxis2 = b.x;
  settings.mNormalAxis1 = a.y;
  settings.mNormalAxis2 = b.y;
  const AxisLimits limits = slider_limits(desc);
  settings.mLimitsMin = limits.lower;
  settings.mLimitsMax = limits.upper;
  return settings.Create(ends.a, ends.b);
}

Made make_rod(const Ends& ends, double least, double most, const JPH::SpringSettings& spring) {
  JPH::DistanceConstraintSettings settings;
  settings.mSpace = kLocal;
  settings.mPoint1 = JPH::RVec3(Frame(ends.frame_a).origin);
  settings.mPoint2 = JPH::RVec3(Frame(ends.frame_b).origin);
  settings.mMinDistance = number(least);
  settings.mMaxDistance = number(most);
  settings.mLimitsSpringSettings = spring;
  return settings.Create(ends.a, ends.b);
}

Made make_fixed(const Ends& ends) {
  const Frame a(ends.frame_a), b(ends.frame_b);
  JPH::FixedConstraintSettings settings;
  settings.mSpace = kLocal;
  settings.mPoint1 = JPH::RVec3(a.origin);
  settings.mPoint2 = JPH::RVec3(b.origin);
  settings.mAxisX1 = a.x;
  settings.mAxisX2 = b.x;
  settings.mAxisY1 = a.y;
  settings.mAxisY2 = b.y;
  return settings.Create(ends.a, ends.b);
}

}  // namespace

double zero_of(const PlumbLimit& limit) {
  const bool without = limit.enabled != 0 && (limit.lower > 0 || limit.upper < 0);
  return without ? 0.5 * (limit.lower + limit.upper) : 0;
}

AxisLimits hinge_limits(const PlumbJointDesc& desc) {
  const PlumbLimit& limit = desc.limits[3];
  const double zero = zero_of(limit), most = std::numbers::pi;
  if (limit.enabled == 0) return {-JPH::JPH_PI, JPH::JPH_PI};
  return {std::max(number(std::max(limit.lower - zero, -most)), -JPH::JPH_PI),
          std::min(number(std::min(limit.upper - zero, most)), JPH::JPH_PI)};
}

AxisLimits slider_limits(const PlumbJointDesc& desc) {
  const PlumbLimit& limit = desc.limits[0];
  if (limit.enabled == 0) return {-FLT_MAX, FLT_MAX};
  const double zero = zero_of(limit);
  return {number(limit.lower - zero), number(limit.upper - zero)};
}

JPH::SpringSettings spring_settings(const PlumbSpring& spring) {
  const bool stiff = spring.mode == PLUMB_SPRING_STIFFNESS;
  return {stiff ? JPH::ESpringMode::StiffnessAndDamping : JPH::ESpringMode::FrequencyAndDamping,
          number(spring.frequency), number(spring.damping_ratio)};
}

/// One without stiffness is rigid to Jolt: a damper has a little of it.
Made make_distance_spring(const PlumbJointDesc& desc, const Ends& ends) {
  JPH::SpringSettings spring = spring_settings(desc.springs[0]);
  spring.mFrequency = std::max(spring.mFrequency, 1e-6f);
  return make_rod(ends, desc.rest_length, desc.rest_length, spring);
}

Made make_axis_joint(const PlumbJointDesc& desc, const Ends& ends) {
  const bool limited = desc.limits[0].enabled != 0;
  switch (desc.type) {
    case PLUMB_JOINT_BALL: return make_ball(ends);
    case PLUMB_JOINT_HINGE: return make_hinge(desc, ends);
    case PLUMB_JOINT_SLIDER: return make_slider(desc, ends);
    case PLUMB_JOINT_DISTANCE:
      if (limited) return make_rod(ends, desc.limits[0].lower, desc.limits[0].upper, {});
      if (desc.springs[0].enabled != 0) return make_distance_spring(desc, ends);
      return make_rod(ends, desc.rest_length, desc.rest_length, {});
    default: return make_fixed(ends);
  }
}

}  // namespace plumb::jolt
