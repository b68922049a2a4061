#include "joints/axis_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plumb/backend/joint_coordinates.hpp"

namespace plumb::bullet {

btScalar Row::inverse_mass(const btRigidBody& a, const btRigidBody& b) const {
  return (a.getInvMass() + b.getInvMass()) * linear.length2() +
         angular_a.dot(a.getInvInertiaTensorWorld() * angular_a) +
         angular_b.dot(b.getInvInertiaTensorWorld() * angular_b);
}

btScalar Row::velocity(const btRigidBody& a, const btRigidBody& b, btScalar h) const {
  const auto linear_velocity = [h](const btRigidBody& body) {
    return body.getLinearVelocity() + body.getTotalForce() * (body.getInvMass() * h);
  };
  const auto angular_velocity = [h](const btRigidBody& body) {
    return body.getAngularVelocity() + body.getInvInertiaTensorWorld() * body.getTotalTorque() * h;
  };
  return linear.dot(linear_velocity(b) - linear_velocity(a)) + angular_a.dot(angular_velocity(a)) +
         angular_b.dot(angular_velocity(b));
}

void Row::write(btTypedConstraint::btConstraintInfo2& info) const {
  for (int i = 0; i < 3; ++i) {
    info.m_J1linearAxis[i] = -linear[i];
    info.m_J2linearAxis[i] = linear[i];
    info.m_J1angularAxis[i] = angular_a[i];
    info.m_J2angularAxis[i] = angular_b[i];
  }
}

namespace {

/// Of a spring by its frequency, no faster than one radian a sub-step.
btScalar impulse_by_frequency(const PlumbSpring& spring, btScalar x, btScalar v, btScalar inverse_mass, btScalar h) {
  const auto wanted = static_cast<btScalar>(2 * std::numbers::pi * spring.frequency);
  const btScalar omega = std::min(wanted, 1 / h);
  const btScalar damping = 2 * static_cast<btScalar>(spring.damping_ratio) * omega;
  return -h * (omega * omega * x + damping * v) / (inverse_mass * (1 + h * damping));
}

}  // namespace

void put_spring(const PlumbSpring& spring, btScalar x, const Row& row, const btRigidBody& a, const btRigidBody& b,
                btScalar h, btTypedConstraint::btConstraintInfo2& info, int index) {
  const btScalar inverse_mass = row.inverse_mass(a, b);
  btScalar impulse = 0;
  if (inverse_mass > 0 && spring.mode == PLUMB_SPRING_STIFFNESS) {
    const auto pull = h * static_cast<btScalar>(spring.frequency);
    const auto damping = h * static_cast<btScalar>(spring.damping_ratio);
    // Against the two bodies alone, than which no less moves, a force would overshoot from 2 on; and a soft row comes
    // to no end below 1, for Bullet leaves its constraint force mixing out of the diagonal.
    constexpr btScalar kStiff = btScalar(1.5);
    const btScalar drag = damping + h * pull;
    if (drag * inverse_mass > kStiff) {
      info.m_constraintError[index] = -pull * x / drag;
      info.cfm[index] = 1 / (drag * inverse_mass);
      return;
    }
    impulse = -(pull * x + damping * row.velocity(a, b, 0));
  } else if (inverse_mass > 0) {
    impulse = impulse_by_frequency(spring, x, row.velocity(a, b, h), inverse_mass, h);
  }
  info.m_lowerLimit[index] = info.m_upperLimit[index] = impulse;
}

DistanceConstraint::DistanceConstraint(btRigidBody& a, btRigidBody& b, const btVector3& point_a,
                                       const btVector3& point_b, const PlumbJointDesc& desc)
    : RowConstraint(D6_CONSTRAINT_TYPE, a, b),
      point_a_(point_a),
      point_b_(point_b),
      rest_(scalar(desc.rest_length, "rest_length")),
      lower_(rest_),
      upper_(rest_),
      spring_(desc.springs[0]) {
  if (desc.limits[0].enabled != 0) {
    lower_ = scalar(desc.limits[0].lower, "limits[0].lower");
    upper_ = scalar(desc.limits[0].upper, "limits[0].upper");
  } else if (spring_.enabled != 0) {
    lower_ = -SIMD_INFINITY;
    upper_ = SIMD_INFINITY;
  }
}

void DistanceConstraint::rest_at(btScalar length) {
  if (lower_ == upper_ && lower_ == rest_) lower_ = upper_ = length;
  rest_ = length;
}

void DistanceConstraint::getInfo1(btConstraintInfo1* info) {
  info->m_numConstraintRows = spring_.enabled != 0 && upper_ < SIMD_INFINITY ? 2 : 1;
  info->nub = 0;
}

void DistanceConstraint::getInfo2(btConstraintInfo2* info) {
  const btTransform &pose_a = m_rbA.getWorldTransform(), &pose_b = m_rbB.getWorldTransform();
  const btVector3 arm_a = pose_a.getBasis() * point_a_, arm_b = pose_b.getBasis() * point_b_;
  const btVector3 apart = (pose_b.getOrigin() + arm_b) - (pose_a.getOrigin() + arm_a);
  const btScalar distance = apart.length();
  const btVector3 along = distance > SIMD_EPSILON ? apart / distance : btVector3(0, 1, 0);
  const Row row{along, -arm_a.cross(along), arm_b.cross(along)};
  const btScalar h = 1 / info->fps;
  int at = 0;
  const auto next_row = [&] {
    btConstraintInfo2 shifted = *info;
    shifted.m_J1linearAxis += at;
    shifted.m_J2linearAxis += at;
    shifted.m_J1angularAxis += at;
    shifted.m_J2angularAxis += at;
    row.write(shifted);
    const int here = at;
    at += info->rowskip;
    return here;
  };
  if (spring_.enabled != 0) {
    const int here = next_row();
    put_spring(spring_, distance - rest_, row, m_rbA, m_rbB, h, *info, here);
    if (upper_ >= SIMD_INFINITY) return;
  }
  const int here = next_row();
  // Between the limits the row only forbids to pass the nearer one in this sub-step.
  const bool near_upper = distance - lower_ > upper_ - distance;
  const btScalar room = near_upper ? upper_ - distance : lower_ - distance;
  const bool violated = near_upper ? room < 0 : room > 0;
  info->m_constraintError[here] = info->fps * (violated ? info->erp : btScalar(1)) * room;
  if (lower_ == upper_) return;
  if (near_upper)
    info->m_upperLimit[here] = 0;
  else
    info->m_lowerLimit[here] = 0;
}

MeshConstraint::MeshConstraint(btRigidBody& a, btRigidBody& b, const btTransform& frame_a, const btTransform& frame_b,
                               const PlumbJointDesc& desc)
    : RowConstraint(D6_CONSTRAINT_TYPE, a, b),
      frame_a_(frame_a),
      frame_b_(frame_b),
      ratio_(scalar(desc.ratio, "ratio")),
      is_rack_(desc.type == PLUMB_JOINT_RACK_AND_PINION) {}

void MeshConstraint::getInfo1(btConstraintInfo1* info) {
  info->m_numConstraintRows = 1;
  info->nub = 0;
}

void MeshConstraint::getInfo2(btConstraintInfo2* info) {
  const btTransform a = m_rbA.getWorldTransform() * frame_a_, b = m_rbB.getWorldTransform() * frame_b_;
  const btVector3 axis = a.getBasis().getColumn(0), along = b.getBasis().getColumn(0);
  if (is_rack_) {
    const btVector3 meet = a.getOrigin() + along.cross(axis) / ratio_;
    const btVector3 arm_a = meet - m_rbA.getWorldTransform().getOrigin(),
                    arm_b = meet - m_rbB.getWorldTransform().getOrigin();
    Row{along, -arm_a.cross(along), arm_b.cross(along)}.write(*info);
  } else {
    Row{btVector3(0, 0, 0), axis, ratio_ * along}.write(*info);
  }
  info->m_constraintError[0] = 0;
}

namespace {

/// A coordinate of b's turn seen from a, and the direction about which turning b changes it.
struct Turn {
  btScalar coordinate;
  btVector3 direction;
};

/// x turns about a's x axis, z about b's z axis, y about what is square to both.
Turn turn_about(const btMatrix3x3& a, const btMatrix3x3& b, int axis) {
  const btVector3 x = a.getColumn(0), z = b.getColumn(2);
  return {angles_xyz(a.transposeTimes(b))[axis], axis == 0 ? x : axis == 2 ? z : z.cross(x).normalized()};
}

/// A twist turns about both x axes; a swing's vector along the meridian as b's x axis turns, along the parallel faster,
/// by the angle over its sine.
Turn swing_or_twist(const btMatrix3x3& a, const btMatrix3x3& b, int axis) {
  btQuaternion turn;
  a.transposeTimes(b).getRotation(turn);
  const PlumbVec3 numbers = backend::swing_twist({turn.x(), turn.y(), turn.z(), turn.w()});
  const btVector3 x_a = a.getColumn(0), x_b = b.getColumn(0), across = x_a.cross(x_b);
  const btScalar least = btScalar(0.01);  // of what becomes 0 where the x axes are opposite
  if (axis == 0) return {btScalar(numbers.x), (x_a + x_b) / std::max(1 + x_a.dot(x_b), least)};
  const btScalar sine = across.length(), angle = btScalar(std::hypot(numbers.y, numbers.z));
  const btVector3 about = sine > SIMD_EPSILON ? across / sine : a.getColumn(1);
  const btScalar by_sine = angle > least ? angle / std::max(sine, least) : 1;
  const btScalar y = about.dot(a.getColumn(1)), z = about.dot(a.getColumn(2));
  const btScalar own = axis == 1 ? y : z, other = axis == 1 ? -z : y;
  return {btScalar(axis == 1 ? numbers.y : numbers.z), own * about + (by_sine * other) * x_b.cross(about)};
}

}  // namespace

AxisSpring::AxisSpring(btRigidBody& a, btRigidBody& b, const btTransform& frame_a, const btTransform& frame_b, int axis,
                       const PlumbJointDesc& desc)
    : RowConstraint(D6_CONSTRAINT_TYPE, a, b),
      frame_a_(frame_a),
      frame_b_(frame_b),
      axis_(axis),
      type_(desc.type),
      spring_(desc.springs[axis]) {}

void AxisSpring::getInfo1(btConstraintInfo1* info) {
  info->m_numConstraintRows = 1;
  info->nub = 0;
}

void AxisSpring::getInfo2(btConstraintInfo2* info) {
  const btTransform at_a = m_rbA.getWorldTransform() * frame_a_, at_b = m_rbB.getWorldTransform() * frame_b_;
  Row row{btVector3(0, 0, 0), btVector3(0, 0, 0), btVector3(0, 0, 0)};
  btScalar coordinate = 0;
  if (axis_ < 3) {
    row.linear = at_a.getBasis().getColumn(axis_);
    // Both arms end in frame b: a's axis is carried along by a.
    row.angular_a = -(at_b.getOrigin() - m_rbA.getWorldTransform().getOrigin()).cross(row.linear);
    row.angular_b = (at_b.getOrigin() - m_rbB.getWorldTransform().getOrigin()).cross(row.linear);
    coordinate = row.linear.dot(at_b.getOrigin() - at_a.getOrigin());
  } else {
    const bool swings = type_ == PLUMB_JOINT_SWING_TWIST;
    const Turn turn = (swings ? swing_or_twist : turn_about)(at_a.getBasis(), at_b.getBasis(), axis_ - 3);
    coordinate = turn.coordinate;
    row.angular_b = turn.direction;
    row.angular_a = -turn.direction;
  }
  row.write(*info);
  const btScalar h = 1 / info->fps;
  const bool goes_round = axis_ == 3 || (axis_ > 3 && type_ != PLUMB_JOINT_SWING_TWIST);
  auto deviation = coordinate - static_cast<btScalar>(spring_.rest);
  if (goes_round) deviation = btNormalizeAngle(deviation);
  put_spring(spring_, deviation, row, m_rbA, m_rbB, h, *info, 0);
}

btVector3 angles_xyz(const btMatrix3x3& r) {
  const btScalar sine = std::clamp(r[0][2], btScalar(-1), btScalar(1));
  if (std::abs(sine) >= 1)  // x and z turn about the same axis: all of it is x's
    return {std::atan2(r[2][1], r[1][1]), std::asin(sine), 0};
  return {std::atan2(-r[1][2], r[2][2]), std::asin(sine), std::atan2(-r[0][1], r[0][0])};
}

}  // namespace plumb::bullet
