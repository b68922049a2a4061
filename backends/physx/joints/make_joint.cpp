// From a descriptor to PhysX's joints, and what they push with.
#include <algorithm>
#include <numbers>

#include "joints/joint.hpp"
#include "plumb/backend/names.hpp"
#include "plumb/backend/usual_capability.hpp"
#include "start.hpp"

namespace plumb::px {
namespace {

/// rad or m: limits that are nearer to each other are this far apart, for PhysX locks such elsewhere.
constexpr double kLeastRange = 1e-6;

bool stands(const PxRigidActor* actor) {
  const auto* body = actor == nullptr ? nullptr : actor->is<PxRigidDynamic>();
  return body == nullptr || body->getRigidBodyFlags().isSet(PxRigidBodyFlag::eKINEMATIC);
}

PxJoint* make_hinge(const PlumbJointDesc& desc, const Ends& ends) {
  PxRevoluteJoint* hinge = PxRevoluteJointCreate(physics(), ends.a, ends.frame_a, ends.b, ends.frame_b);
  const PlumbLimit& limit = desc.limits[3];
  constexpr double whole = std::numbers::pi;
  if (hinge == nullptr || limit.enabled == 0 || (limit.lower <= -whole && limit.upper >= whole)) return hinge;
  const double lower = std::max(limit.lower, -whole), upper = std::min(limit.upper, whole);
  hinge->setLimit(PxJointAngularLimitPair(number(lower), number(std::max(upper, lower + kLeastRange))));
  hinge->setRevoluteJointFlag(PxRevoluteJointFlag::eLIMIT_ENABLED, true);
  return hinge;
}

PxJoint* make_slider(const PlumbJointDesc& desc, const Ends& ends) {
  PxPrismaticJoint* slider = PxPrismaticJointCreate(physics(), ends.a, ends.frame_a, ends.b, ends.frame_b);
  const PlumbLimit& limit = desc.limits[0];
  if (slider == nullptr || limit.enabled == 0) return slider;
  PxJointLinearLimitPair pair(physics().getTolerancesScale(), number(limit.lower),
                              number(std::max(limit.upper, limit.lower + kLeastRange)));
  slider->setLimit(pair);
  slider->setPrismaticJointFlag(PxPrismaticJointFlag::eLIMIT_ENABLED, true);
  return slider;
}

/// Whether it holds its origins where they are: there PhysX's rod knows no direction.
bool is_point(const PlumbJointDesc& desc) {
  return (desc.limits[0].enabled != 0 ? desc.limits[0].upper : desc.rest_length) == 0;
}

/// Null where its spring is all.
PxJoint* make_rod(const PlumbJointDesc& desc, const Ends& ends) {
  const PlumbLimit& limit = desc.limits[0];
  const bool limited = limit.enabled != 0;
  if (!limited && desc.springs[0].enabled != 0) return nullptr;
  if (is_point(desc)) return PxSphericalJointCreate(physics(), ends.a, ends.frame_a, ends.b, ends.frame_b);
  PxDistanceJoint* rod = PxDistanceJointCreate(physics(), ends.a, ends.frame_a, ends.b, ends.frame_b);
  if (rod == nullptr) return rod;
  rod->setTolerance(0);
  rod->setMinDistance(number(limited ? limit.lower : desc.rest_length));
  rod->setMaxDistance(number(limited ? limit.upper : desc.rest_length));
  rod->setDistanceJointFlag(PxDistanceJointFlag::eMIN_DISTANCE_ENABLED, rod->getMinDistance() > 0);
  rod->setDistanceJointFlag(PxDistanceJointFlag::eMAX_DISTANCE_ENABLED, true);
  return rod;
}

PxJoint* make_main(const PlumbJointDesc& desc, const Ends& ends) {
  if (takes_six_axes(desc)) return make_six_axes(desc, ends);
  switch (desc.type) {
    case PLUMB_JOINT_BALL: return PxSphericalJointCreate(physics(), ends.a, ends.frame_a, ends.b, ends.frame_b);
    case PLUMB_JOINT_HINGE: return make_hinge(desc, ends);
    case PLUMB_JOINT_SLIDER: return make_slider(desc, ends);
    case PLUMB_JOINT_DISTANCE: return make_rod(desc, ends);
    default: return PxFixedJointCreate(physics(), ends.a, ends.frame_a, ends.b, ends.frame_b);
  }
}

/// Which of the adapter's own rows it has, in their order. Springs along axes are PhysX's.
std::vector<OwnRow::What> own_rows(const PlumbJointDesc& desc) {
  using Kind = OwnRow::Kind;
  if (desc.type == PLUMB_JOINT_GEAR) return {{Kind::gear}};
  if (desc.type == PLUMB_JOINT_RACK_AND_PINION) return {{Kind::rack}};
  std::vector<OwnRow::What> rows;
  if (desc.type == PLUMB_JOINT_DISTANCE) {
    if (desc.springs[0].enabled != 0) rows.push_back({Kind::distance_spring});
    return rows;
  }
  for (std::uint8_t axis = 0; axis < 6; ++axis) {
    if (axis >= 3 && desc.springs[axis].enabled != 0) rows.push_back({Kind::spring, axis});
    if (desc.motors[axis].enabled != 0) rows.push_back({Kind::motor, axis});
  }
  return rows;
}

void hold(PxJoint& native) { native.setConstraintFlag(PxConstraintFlag::eCOLLISION_ENABLED, true); }

void put(Joint::Native& to, PxJoint* made) {
  if (made == nullptr) throw Error(PLUMB_E_OUT_OF_MEMORY, "PhysX makes no such joint" + because());
  to.reset(made);
  hold(*made);
}

}  // namespace

void check_joint(const PlumbJointDesc& desc) {
  (void)transform(desc.frame_a, "frame_a");
  (void)transform(desc.frame_b, "frame_b");
  (void)number(desc.ratio);
  (void)number(desc.rest_length);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const PlumbSpring& spring = desc.springs[axis];
    (void)number(desc.limits[axis].lower);
    (void)number(desc.limits[axis].upper);
    (void)number(desc.motors[axis].target_velocity);
    (void)number(desc.motors[axis].max_force);
    (void)number(spring.rest);
    (void)number(40 * spring.frequency * spring.frequency);
    (void)number(13 * spring.frequency * spring.damping_ratio);
  }
}

void make_native(Joint& joint, const Ends& ends) {
  const PlumbJointDesc& desc = joint.desc;
  drop_native(joint);
  if (!joint.enabled || (stands(ends.a) && stands(ends.b))) return;
  (void)complaint();
  const bool spring_is_all =
      desc.type == PLUMB_JOINT_DISTANCE && desc.limits[0].enabled == 0 && desc.springs[0].enabled != 0;
  if (!backend::is_meshing(desc.type) && !spring_is_all) put(joint.main, make_main(desc, ends));
  for (const OwnRow::What what : own_rows(desc)) joint.rows.push_back(std::make_unique<OwnRow>(what, desc, ends));
  (void)drive(joint);
}

void drop_native(Joint& joint) {
  joint.rows.clear();
  joint.main.reset();
}

bool drive(Joint& joint) {
  const PlumbJointDesc& desc = joint.desc;
  if (joint.main == nullptr && joint.rows.empty()) return false;
  if (own_rows(desc).size() != joint.rows.size()) return false;
  auto* axes = joint.main == nullptr ? nullptr : joint.main->is<PxD6Joint>();
  if (joint.main != nullptr && takes_six_axes(desc) != (axes != nullptr)) return false;
  if (axes != nullptr) drive_six_axes(*axes, desc);
  for (const auto& row : joint.rows) row->drive(desc);
  if (desc.type != PLUMB_JOINT_DISTANCE || joint.main == nullptr || desc.limits[0].enabled != 0) return true;
  auto* rod = joint.main->is<PxDistanceJoint>();
  if (rod == nullptr || is_point(desc)) return rod == nullptr && is_point(desc);
  rod->setMinDistance(number(desc.rest_length));
  rod->setMaxDistance(number(desc.rest_length));
  return true;
}

/// PhysX tells what acts on its first body, about the second's frame.
Reaction reaction(const Joint& joint) {
  Reaction sum;
  const auto add = [&](const PxConstraint& constraint, double sign) {
    PxVec3 force, torque;
    constraint.getForce(force, torque);
    sum.force = backend::add(sum.force, backend::scale(sign, to_plumb(force)));
    sum.torque = backend::add(sum.torque, backend::scale(sign, to_plumb(torque)));
  };
  const bool swapped = takes_six_axes(joint.desc) && is_swapped(joint.desc);
  if (joint.main != nullptr) add(*joint.main->getConstraint(), swapped ? 1 : -1);
  for (const auto& row : joint.rows) add(row->constraint(), -1);
  return sum;
}

}  // namespace plumb::px
