// A contact constraint while it is being solved: no approach along the normal (lambda >= 0), Coulomb friction in the
// plane across it.
//
// Velocity constraint J V = 0 with J = [-n, -(ra x n), n, rb x n], solved by sequential impulses: accumulated impulses
// are clamped (Catto, "Iterative Dynamics with Temporal Coherence", 2005). A contact's numbers are brought in whole
// before any is worked with: what a GPU waits for then comes at once, and nothing that is written stands in its way.
//
// Points are counted from their mean. What acts along one normal is then one push at the mean and one torque for all
// points, whatever their number.
#pragma once

#include "body.hpp"
#include "constraints/contact_rows.hpp"
#include "step_parameters.hpp"

namespace plumb::impulse {

/// A body, or kLanes of them, while a constraint is being solved.
template <class N>
struct SolverBody {
  Vec3<N> linear, angular;
  N inverse_mass;
  Sym33<N> inverse_inertia;
  Vec3<N> moved;     ///< Displacement::linear
  Quat4<N> rotated;  ///< Displacement::rotation
};

template <class N>
PLUMB_HD Vec3<N> velocity_at(const SolverBody<N>& body, const Vec3<N>& arm) {
  return body.linear + cross(body.angular, arm);
}
template <class N>
PLUMB_HD void push(SolverBody<N>& body, const Vec3<N>& arm, const Vec3<N>& impulse) {
  body.linear += body.inverse_mass * impulse;
  body.angular += body.inverse_inertia * cross(arm, impulse);
}
/// By how much a turn changes a vector.
template <class N>
PLUMB_HD Vec3<N> change_by_turn(const Quat4<N>& turn, const Vec3<N>& v) {
  const Vec3<N> u = vector_part(turn);
  const Vec3<N> t = cross(u, v);
  const Vec3<N> s = t + t;
  return turn.w * s + cross(u, s);
}
/// How far the end of an arm has moved since the step began: the body's own way and the turn of the arm.
template <class N>
PLUMB_HD Vec3<N> displacement_at(const SolverBody<N>& body, const Vec3<N>& arm) {
  return body.moved + change_by_turn(body.rotated, arm);
}

/// Numbers of a point; see PointField. impulse: along normal, tangent and bitangent.
template <class N>
struct ContactPoint {
  Vec3<N> arm;
  N separation, normal_mass, normal_give, open;
  N tangent_mass[3], tangent_step;
  N impulse[3];
  N impact_speed;
};

/// A manifold, or kLanes of them. Points beyond the last one have no mass and no impulse.
template <class N>
struct Contact {
  Vec3<N> normal, tangent;
  Vec3<N> centre_a, centre_b;
  N friction, restitution, pull;
  ContactPoint<N> points[kManifoldPoints];
  N coupling[kCouplingFields];
  N block_inverse[kBlockFields];

  PLUMB_HD Vec3<N> arm_a(int p) const { return centre_a + points[p].arm; }
  PLUMB_HD Vec3<N> arm_b(int p) const { return centre_b + points[p].arm; }
};

/// Reads a contact. points: the largest number among the lanes. A GPU reads all points, because it would have to wait
/// for their number.
template <class N>
PLUMB_HD Contact<N> load_contact(const RowAccess<N>& row, int points) {
  Contact<N> contact;
  N quad[4];
  const auto get_vector = [&](std::uint32_t field, Vec3<N>& v) {
    row.get_quad(field, quad);
    v = {quad[0], quad[1], quad[2]};
    return quad[3];
  };
  contact.friction = get_vector(kNormal, contact.normal);
  contact.restitution = get_vector(kTangent, contact.tangent);
  contact.pull = get_vector(kCentreA, contact.centre_a);
  get_vector(kCentreB, contact.centre_b);
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    const N zero = N(0);
    ContactPoint<N>& point = contact.points[p];
    point = {{zero, zero, zero}, zero, zero, zero, zero, {zero, zero, zero}, zero, {zero, zero, zero}, zero};
    if (kLanes > 1 && p >= points) continue;
    point.separation = get_vector(point_field(p, kArm), point.arm);
    row.get_quad(point_field(p, kNormalMass), quad);
    point.normal_mass = quad[0];
    point.normal_give = quad[1];
    point.tangent_step = quad[2];
    point.impact_speed = quad[3];
    row.get_quad(point_field(p, kTangentMass), quad);
    for (int i = 0; i < 3; ++i) point.tangent_mass[i] = quad[i];
    row.get_quad(point_field(p, kNormalImpulse), quad);
    for (int i = 0; i < 3; ++i) point.impulse[i] = quad[i];
    point.open = quad[3];
  }
  N matrix[kCouplingFields + kBlockFields];
  PLUMB_UNROLL
  for (std::uint32_t i = 0; i < kCouplingFields + kBlockFields; i += 4) {
    row.get_quad(kCoupling + i, quad);
    for (std::uint32_t j = 0; j < 4; ++j) matrix[i + j] = quad[j];
  }
  PLUMB_UNROLL
  for (std::uint32_t i = 0; i < kCouplingFields; ++i) contact.coupling[i] = matrix[i];
  PLUMB_UNROLL
  for (std::uint32_t i = 0; i < kBlockFields; ++i) contact.block_inverse[i] = matrix[kCouplingFields + i];
  return contact;
}

/// Writes back the impulses, and what may approach.
template <int P, class N>
PLUMB_HD void store_impulses(const RowAccess<N>& row, const Contact<N>& contact) {
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    const ContactPoint<N>& point = contact.points[p];
    row.put_quad(point_field(p, kNormalImpulse), point.impulse[0], point.impulse[1], point.impulse[2], point.open);
  }
}
template <int P, class N>
PLUMB_HD void store_impact_speeds(const RowAccess<N>& row, const Contact<N>& contact) {
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) row.put(point_field(p, kImpactSpeed), contact.points[p].impact_speed);
}
/// Adds the impulses of a sub-step that is done to those of the step.
template <int P, class N>
PLUMB_HD void add_up_impulses(const RowAccess<N>& row, const Contact<N>& contact) {
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) PLUMB_UNROLL
  for (std::uint32_t i = 0; i < 3; ++i) row.add_to_sum(p, i, contact.points[p].impulse[i]);
}

/// Applies the impulses that the last step ended with (warm starting).
template <int P, class N>
PLUMB_HD void warm_start_contact(const Contact<N>& contact, SolverBody<N>& a, SolverBody<N>& b) {
  const Vec3<N> n = contact.normal, t1 = contact.tangent;
  const Vec3<N> t2 = cross(n, t1);
  Vec3<N> sum = {N(0), N(0), N(0)}, torque = sum;
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    const ContactPoint<N>& point = contact.points[p];
    const Vec3<N> impulse = point.impulse[0] * n + point.impulse[1] * t1 + point.impulse[2] * t2;
    sum += impulse;
    torque += cross(point.arm, impulse);
  }
  a.linear -= a.inverse_mass * sum;
  a.angular -= a.inverse_inertia * (cross(contact.centre_a, sum) + torque);
  b.linear += b.inverse_mass * sum;
  b.angular += b.inverse_inertia * (cross(contact.centre_b, sum) + torque);
}

}  // namespace plumb::impulse
