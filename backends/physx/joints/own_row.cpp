#include "joints/own_row.hpp"

#include <numbers>
#include <tuple>

#include "joints/joint.hpp"
#include "plumb/backend/joint_coordinates.hpp"
#include "start.hpp"

namespace plumb::px {
namespace {

using Block = OwnRow::Block;
using Kind = OwnRow::Kind;

/// By which a body has turned about an axis.
float turned(const PxQuat& before, const PxQuat& now, const PxVec3& axis) {
  PxQuat turn = now * before.getConjugate();
  if (turn.w < 0) turn = -turn;
  return 2 * std::atan2(turn.getImaginaryPart().dot(axis), turn.w);
}

/// How far a rack's line is past its pinion's axis.
float passed(const PxTransform& a, const PxTransform& b) { return (b.p - a.p).dot(b.q.getBasisVector0()); }

/// C' = the turn of a about its axis and, times the ratio, that of b.
void put_gear(const Block& block, const PxTransform& a, const PxTransform& b, Px1DConstraint& row) {
  row.angular0 = a.q.getBasisVector0();
  row.angular1 = -block.ratio * b.q.getBasisVector0();
  row.geometricError = block.error;
  row.flags |= Px1DConstraintFlag::eANGULAR_CONSTRAINT;
}

/// C' = how fast the pinion turns more than the line goes past it. As PhysX's own rack it pushes both at their centres.
void put_rack(const Block& block, const PxTransform& a, const PxTransform& b, Px1DConstraint& row) {
  row.linear0 = row.linear1 = block.ratio * b.q.getBasisVector0();
  row.angular0 = a.q.getBasisVector0();
  row.geometricError = block.error;
}

/// PhysX pulls with -stiffness * error on the first body, as seen from the second. moment: of the pair about the axis,
/// where the row is of more than that; else 0.
void put_spring(const Block& block, float moment, Px1DConstraint& row) {
  const float share = block.by_mass && moment > 0 ? moment : 1;
  row.flags |= Px1DConstraintFlag::eSPRING;
  if (block.by_mass && moment == 0) row.flags |= Px1DConstraintFlag::eACCELERATION_SPRING;
  row.mods.spring.stiffness = share * block.stiffness;
  row.mods.spring.damping = share * block.damping;
}

/// The coordinate of an axis of turns, of b seen from a.
double turn_about(PlumbJointType type, const PlumbQuat& seen, std::size_t axis) {
  const PlumbVec3 turns = type == PLUMB_JOINT_SWING_TWIST ? backend::swing_twist(seen)
                                                          : backend::angles_xyz(backend::rotation_matrix(seen));
  return axis == 3 ? turns.x : axis == 4 ? turns.y : turns.z;
}

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

/// By how much the coordinate changes as b turns about the axes of a's frame.
PlumbVec3 change_of(PlumbJointType type, const PlumbQuat& seen, std::size_t axis) {
  constexpr double small = 1e-4;  // rad
  double change[3];
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](double half) {  // of the angle
      const PlumbQuat turn{k == 0 ? half : 0, k == 1 ? half : 0, k == 2 ? half : 0, 1};
      return turn_about(type, backend::multiply(backend::normalized(turn), seen), axis);
    };
    change[k] = wrapped(at(small / 2) - at(-small / 2)) / (2 * small);
  }
  return {change[0], change[1], change[2]};
}

PxMat33 cross_matrix(const PxVec3& v) { return {PxVec3(0, v.z, -v.y), PxVec3(-v.z, 0, v.x), PxVec3(v.y, -v.x, 0)}; }
PxMat33 inverse_inertia(const Block::Inverse& of, const PxTransform& mass) {
  const PxMat33 turn(mass.q);
  return turn * PxMat33::createDiagonal(of.inertia) * turn.getTranspose();
}

/// A turn about a joint that holds b's origin: with the force there that keeps it there. PhysX's few iterations would
/// not find it. Returns the moment of the pair about the axis, of bodies that turn about their centres; 0 where none
/// is.
float pin(const Block& block, const PxTransform& b, const PxTransform& mass_a, const PxTransform& mass_b,
          Px1DConstraint& row) {
  const PxVec3 arm_a = b.p - mass_a.p, arm_b = b.p - mass_b.p;
  const PxMat33 cross_a = cross_matrix(arm_a), cross_b = cross_matrix(arm_b);
  const PxMat33 turns_a = inverse_inertia(block.of_a, mass_a), turns_b = inverse_inertia(block.of_b, mass_b);
  PxMat33 gives = cross_a * turns_a * cross_a.getTranspose() + cross_b * turns_b * cross_b.getTranspose();
  for (PxU32 i = 0; i < 3; ++i) gives(i, i) += block.of_a.mass + block.of_b.mass;
  const float response = row.angular0.dot(turns_a * row.angular0) + row.angular1.dot(turns_b * row.angular1);
  const PxVec3 goes = (turns_a * row.angular0).cross(arm_a) + (turns_b * row.angular1).cross(arm_b);
  const PxVec3 force = gives.getInverse() * -goes;
  if (!force.isFinite() || response <= 0) return 0;
  row.linear0 = row.linear1 = force;
  row.angular0 += arm_a.cross(force);
  row.angular1 += arm_b.cross(force);
  return 1 / response;
}

struct Axis {
  double coordinate;  ///< m or rad
  float moment = 0;   ///< as put_spring() takes it
};

/// C' = how fast the coordinate becomes less. Along an axis of translation it is that of b's origin.
Axis put_axis(const Block& block, const PxTransform& a, const PxTransform& b, const PxTransform& mass_a,
              const PxTransform& mass_b, Px1DConstraint& row) {
  const std::size_t axis = block.what.axis;
  if (axis < 3) {
    row.linear0 = row.linear1 = a.q.rotate(PxVec3(axis == 0, axis == 1, axis == 2));
    row.angular0 = (b.p - mass_a.p).cross(row.linear0);
    row.angular1 = (b.p - mass_b.p).cross(row.linear1);
    return {static_cast<double>((b.p - a.p).dot(row.linear0))};
  }
  const PlumbQuat seen = to_plumb(PxTransform(a.q.getConjugate() * b.q)).orientation;
  const PlumbVec3 change = change_of(block.type, seen, axis);
  row.angular0 = row.angular1 =
      a.q.rotate(PxVec3(static_cast<float>(change.x), static_cast<float>(change.y), static_cast<float>(change.z)));
  Axis turned{turn_about(block.type, seen, axis)};
  if (block.pinned) turned.moment = pin(block, b, mass_a, mass_b, row);
  if (turned.moment == 0) row.flags |= Px1DConstraintFlag::eANGULAR_CONSTRAINT;
  return turned;
}

void put_motor(const Block& block, Px1DConstraint& row) {
  row.velocityTarget = -block.speed;
  row.minImpulse = -block.most_force;
  row.maxImpulse = block.most_force;
  row.flags |= Px1DConstraintFlag::eHAS_DRIVE_LIMIT;
}

void put_distance_spring(const Block& block, const PxTransform& a, const PxTransform& b, const PxTransform& mass_a,
                         const PxTransform& mass_b, Px1DConstraint& row) {
  PxVec3 away = a.p - b.p;
  const float distance = away.normalize();
  if (distance < 1e-6f) away = PxVec3(1, 0, 0);
  row.linear0 = row.linear1 = away;
  row.angular0 = (a.p - mass_a.p).cross(away);
  row.angular1 = (b.p - mass_b.p).cross(away);
  row.geometricError = distance - block.rest;
  put_spring(block, 0, row);
}

/// rest: whether limits are beyond a turn, which own rows have none of, and where the joint is seen from both bodies.
template <class... Rest>
PxU32 prepare(Px1DConstraint* rows, PxVec3p& offset, PxU32 /*most*/, PxConstraintInvMassScale& scale,
              const void* constants, const PxTransform& mass_a, const PxTransform& mass_b, Rest... rest) {
  const auto& block = *static_cast<const Block*>(constants);
  const PxTransform a = mass_a * block.in_a, b = mass_b * block.in_b;
  scale = PxConstraintInvMassScale(1, 1, 1, 1);
  offset = b.p - mass_a.p;
  const std::tuple<Rest...> given(rest...);
  std::get<1>(given) = std::get<2>(given) = b.p;
  Px1DConstraint& row = *rows;
  row.linear0 = row.linear1 = row.angular0 = row.angular1 = PxVec3(0);
  row.minImpulse = -PX_MAX_F32;
  row.maxImpulse = PX_MAX_F32;
  row.velocityTarget = 0;
  row.solveHint = PxConstraintSolveHint::eNONE;
  row.flags = Px1DConstraintFlag::eOUTPUT_FORCE;
  row.mods.bounce.restitution = row.mods.bounce.velocityThreshold = 0;
  switch (block.what.kind) {
    case Kind::gear: put_gear(block, a, b, row); break;
    case Kind::rack: put_rack(block, a, b, row); break;
    case Kind::distance_spring: put_distance_spring(block, a, b, mass_a, mass_b, row); break;
    case Kind::spring: {
      const Axis at = put_axis(block, a, b, mass_a, mass_b, row);
      const double stretched = at.coordinate - static_cast<double>(block.rest);
      row.geometricError = -static_cast<float>(block.what.axis < 3 ? stretched : wrapped(stretched));
      put_spring(block, at.moment, row);
      break;
    }
    case Kind::motor:
      (void)put_axis(block, a, b, mass_a, mass_b, row);
      put_motor(block, row);
      break;
  }
  return 1;
}

PxTransform centre_of(const PxRigidActor* actor) {
  const auto* body = actor == nullptr ? nullptr : actor->is<PxRigidBody>();
  return body == nullptr ? PxTransform(PxIdentity) : body->getCMassLocalPose();
}

/// PhysX takes those that stand as the world.
bool is_world(const PxRigidActor* actor) { return actor == nullptr || actor->is<PxRigidStatic>() != nullptr; }

/// Of what stands: none. Of bodies with locked axes the solver knows more than is told here.
Block::Inverse inverse_of(const PxRigidActor* actor) {
  const auto* body = actor == nullptr ? nullptr : actor->is<PxRigidDynamic>();
  if (body == nullptr || body->getRigidBodyFlags().isSet(PxRigidBodyFlag::eKINEMATIC)) return {0, PxVec3(0)};
  return {body->getInvMass(), body->getMassSpaceInvInertiaTensor()};
}
bool has_locks(const PxRigidActor* actor) {
  const auto* body = actor == nullptr ? nullptr : actor->is<PxRigidDynamic>();
  return body != nullptr && body->getRigidDynamicLockFlags() != PxRigidDynamicLockFlags(0);
}

constexpr PxConstraintSolverPrep kPrepare = prepare<bool, PxVec3p&, PxVec3p&>;

PxConstraintShaderTable shaders() {
  return {kPrepare, [](auto&, auto, auto&, auto&, auto) {}, PxConstraintFlag::Enum(0)};
}

PxTransform placed(const PxRigidActor* actor, const PxTransform& frame) {
  return actor == nullptr ? frame : actor->getGlobalPose() * frame;
}

}  // namespace

OwnRow::OwnRow(What what, const PlumbJointDesc& desc, const Ends& ends)
    : a_(ends.a), b_(ends.b), at_a_(ends.frame_a), at_b_(ends.frame_b) {
  block_.what = what;
  block_.type = desc.type;
  block_.pinned = is_swapped(desc) || desc.type == PLUMB_JOINT_SWING_TWIST;
  if (has_locks(a_) || has_locks(b_)) block_.pinned = false;
  block_.of_a = inverse_of(a_);
  block_.of_b = inverse_of(b_);
  block_.ratio = number(desc.ratio);
  drive(desc);
  place();
  was_a_ = frame_a();
  was_b_ = frame_b();
  const PxConstraintShaderTable table = shaders();
  constraint_ = physics().createConstraint(a_, b_, *this, table, sizeof(Block));
  if (constraint_ == nullptr) throw Error(PLUMB_E_OUT_OF_MEMORY, "PhysX has no room for more joints" + because());
  constraint_->setFlag(PxConstraintFlag::eCOLLISION_ENABLED, true);
  constraint_->setFlag(PxConstraintFlag::eDRIVE_LIMITS_ARE_FORCES, true);
}

OwnRow::~OwnRow() {
  if (constraint_ != nullptr) constraint_->release();
}

PxTransform OwnRow::frame_a() const { return placed(a_, at_a_); }
PxTransform OwnRow::frame_b() const { return placed(b_, at_b_); }

void OwnRow::place() {
  block_.in_a = is_world(a_) ? frame_a() : centre_of(a_).transformInv(at_a_);
  block_.in_b = is_world(b_) ? frame_b() : centre_of(b_).transformInv(at_b_);
  if (constraint_ != nullptr) constraint_->markDirty();
}

void OwnRow::drive(const PlumbJointDesc& desc) {
  const std::size_t axis = block_.what.axis;
  const PlumbSpring& spring = desc.springs[axis];
  const double circular = 2 * std::numbers::pi * spring.frequency;
  block_.by_mass = spring.mode == PLUMB_SPRING_FREQUENCY;
  block_.rest = number(block_.what.kind == Kind::distance_spring ? desc.rest_length : spring.rest);
  block_.stiffness = number(block_.by_mass ? circular * circular : spring.frequency);
  block_.damping = number(block_.by_mass ? 2 * spring.damping_ratio * circular : spring.damping_ratio);
  block_.speed = number(desc.motors[axis].target_velocity);
  block_.most_force = number(desc.motors[axis].max_force);
  if (constraint_ != nullptr) constraint_->markDirty();
}

void OwnRow::remember_turns() {
  if (!counts_turns()) return;
  const PxTransform a = frame_a(), b = frame_b();
  block_.error += turned(was_a_.q, a.q, a.q.getBasisVector0());
  block_.error += block_.what.kind == Kind::rack ? -block_.ratio * (passed(a, b) - passed(was_a_, was_b_))
                                                 : block_.ratio * turned(was_b_.q, b.q, b.q.getBasisVector0());
  was_a_ = a;
  was_b_ = b;
  constraint_->markDirty();
}

void* OwnRow::getExternalReference(PxU32& type) {
  type = PxConstraintExtIDs::eNEXT_FREE_ID;
  return this;
}

PxConstraintSolverPrep OwnRow::getPrep() const { return kPrepare; }

}  // namespace plumb::px
