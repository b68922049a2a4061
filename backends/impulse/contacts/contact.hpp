// A contact constraint while it is being solved: no approach along the normal (lambda >= 0), Coulomb friction in the
// plane across it.
//
// Velocity constraint J V = 0 with J = [-n, -(ra x n), n, rb x n], solved by sequential impulses: accumulated impulses
// are clamped (Catto, "Iterative Dynamics with Temporal Coherence", 2005). A contact's numbers are brought in whole
// before any is worked with: what a GPU waits for then comes at once, and nothing that is written stands in its way.
//
// It is solved in its own frame (contact_frame.hpp): what the points do is one wrench, whatever their number, and the
// bodies are pushed once.
#pragma once

#include "bodies/body.hpp"
#include "bodies/step_parameters.hpp"
#include "contacts/contact_frame.hpp"
#include "contacts/contact_rows.hpp"

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
/// How far the end of an arm has moved since the step began: the body's own way and the turn of the arm.
template <class N>
PLUMB_HD Vec3<N> displacement_at(const SolverBody<N>& body, const Vec3<N>& arm) {
  return body.moved + change_by_turn(body.rotated, arm);
}

/// Moves a body by what its change of velocity since `before` makes in h seconds; one that tumbles about axes that
/// swing with it (bodies/swung_frame.hpp), which are the world's to first order.
template <class N, class H>
PLUMB_HD void displace(SolverBody<N>& body, const Vec3<N>& linear_before, const Vec3<N>& angular_before, const H& h) {
  body.moved += N(h) * (body.linear - linear_before);
  const Vec3<N> half = N(h / H(2)) * (body.angular - angular_before);
  const Quat4<N> q = body.rotated, by = Quat4<N>{half.x, half.y, half.z, N(0)} * q;
  body.rotated = normalized(Quat4<N>{q.x + by.x, q.y + by.y, q.z + by.z, q.w + by.w});
}

/// A manifold, or kLanes of them. Points beyond the last one have no mass and no impulse.
template <int P, class N>
struct Contact {
  Vec3<N> normal, tangent;
  Vec3<N> centre_a, centre_b;
  N friction, restitution, pull, tangent_step;
  N count;              ///< of points
  N rolling_radius[2];  ///< of a and b (rolling.hpp)
  ContactDelassus<N> delassus;

  PlanePoint<PerPoint<P, N>> place;
  PerPoint<P, N> separation, noted, allowed_approach;
  PerPoint<P, N> impulse[3];  ///< along normal, tangent and bitangent
  PerPoint<P, N> block_inverse[P];

  PLUMB_HD Vec3<N> bitangent() const { return cross(normal, tangent); }
  /// The points that there are.
  PLUMB_HD PointMask<P, N> there() const {
    PerPoint<P, N> index;
    PLUMB_UNROLL
    for (int i = 0; i < kHeld<P>; ++i) index.at[i] = N(point_of(i));
    return index < count;
  }
};

template <int P, class N>
PLUMB_HD Contact<P, N> load_contact(const RowAccess<N>& row) {
  Contact<P, N> contact;
  N quad[4];
  const auto get_vector = [&](std::uint32_t field, Vec3<N>& v) {
    row.get_quad(field, quad);
    v = {quad[0], quad[1], quad[2]};
    return quad[3];
  };
  contact.friction = get_vector(kNormal, contact.normal);
  contact.restitution = get_vector(kTangent, contact.tangent);
  contact.pull = get_vector(kCentreA, contact.centre_a);
  contact.tangent_step = get_vector(kCentreB, contact.centre_b);
  PLUMB_UNROLL
  for (int i = 0; i < kHeld<P>; ++i) {
    const int p = point_of(i);
    row.get_quad(point_field(p, kPlace), quad);
    contact.place.x.at[i] = quad[0];
    contact.place.y.at[i] = quad[1];
    contact.separation.at[i] = quad[2];
    contact.noted.at[i] = quad[3];
    row.get_quad(point_field(p, kNormalImpulse), quad);
    for (int k = 0; k < 3; ++k) contact.impulse[k].at[i] = quad[k];
    contact.allowed_approach.at[i] = quad[3];
    row.get_quad(point_field(p, kBlockInverse), quad);
    for (int q = 0; q < P; ++q) contact.block_inverse[q].at[i] = quad[q];
  }
  N numbers[kSurfaceSpeed - kDelassus];
  PLUMB_UNROLL
  for (std::uint32_t i = 0; i < kSurfaceSpeed - kDelassus; i += 4) {
    row.get_quad(kDelassus + i, quad);
    for (std::uint32_t k = 0; k < 4; ++k) numbers[i + k] = quad[k];
  }
  const N* next = numbers;
  const auto take = [&next](auto& array) {
    PLUMB_UNROLL
    for (N& number : array) number = *next++;
  };
  take(contact.delassus.normal);
  take(contact.delassus.across);
  take(contact.delassus.friction);
  take(contact.delassus.stop_free);
  take(contact.delassus.stop_held);
  contact.count = *next++;
  take(contact.rolling_radius);
  return contact;
}

/// Writes back the impulses, and what may approach.
template <int P, class N>
PLUMB_HD void store_impulses(const RowAccess<N>& row, const Contact<P, N>& contact) {
  PLUMB_UNROLL
  for (int i = 0; i < kHeld<P>; ++i)
    row.put_quad(point_field(point_of(i), kNormalImpulse), contact.impulse[0].at[i], contact.impulse[1].at[i],
                 contact.impulse[2].at[i], contact.allowed_approach.at[i]);
}
template <int P, class N>
PLUMB_HD void store_noted(const RowAccess<N>& row, const Contact<P, N>& contact) {
  PLUMB_UNROLL
  for (int i = 0; i < kHeld<P>; ++i) row.put(point_field(point_of(i), kNoted), contact.noted.at[i]);
}
/// Adds impulses of a sub-step that is done to those of the step.
template <int P, class N>
PLUMB_HD void add_up_impulses(const RowAccess<N>& row, const PerPoint<P, N> (&impulse)[3]) {
  PLUMB_UNROLL
  for (int i = 0; i < kHeld<P>; ++i) PLUMB_UNROLL
  for (std::uint32_t k = 0; k < 3; ++k) row.add_to_sum(point_of(i), k, impulse[k].at[i]);
}

/// How b moves against a.
template <int P, class N>
PLUMB_HD ContactMotion<N> motion_of(const Contact<P, N>& contact, const SolverBody<N>& a, const SolverBody<N>& b) {
  const Vec3<N> n = contact.normal, t1 = contact.tangent, t2 = contact.bitangent();
  const Vec3<N> v = velocity_at(b, contact.centre_b) - velocity_at(a, contact.centre_a);
  const Vec3<N> turn = b.angular - a.angular;
  return {{dot(v, n), dot(turn, t1), dot(turn, t2)}, {dot(v, t1), dot(v, t2), dot(turn, n)}};
}
/// Pushes both bodies.
template <int P, class N>
PLUMB_HD void push(const Contact<P, N>& contact, const ContactWrench<N>& wrench, SolverBody<N>& a, SolverBody<N>& b) {
  const Vec3<N> n = contact.normal, t1 = contact.tangent, t2 = contact.bitangent();
  const NormalPart<N>& normal = wrench.normal;
  const FrictionPart<N>& friction = wrench.friction;
  const Vec3<N> impulse = normal.along_n * n + friction.along_t1 * t1 + friction.along_t2 * t2;
  const Vec3<N> torque = friction.about_n * n + normal.about_t1 * t1 + normal.about_t2 * t2;
  a.linear -= a.inverse_mass * impulse;
  a.angular -= a.inverse_inertia * (cross(contact.centre_a, impulse) + torque);
  b.linear += b.inverse_mass * impulse;
  b.angular += b.inverse_inertia * (cross(contact.centre_b, impulse) + torque);
}

/// The impulses that the last step ended with (warm starting).
template <int P, class N>
PLUMB_HD ContactWrench<N> wrench_of(const Contact<P, N>& contact) {
  const auto& impulse = contact.impulse;
  return {normal_wrench(contact.place, impulse[0]), friction_wrench(contact.place, impulse[1], impulse[2])};
}

/// Separation of each point now that the bodies have moved, m. What rolls turns about the axis of what is round, which
/// leaves the gap as it is.
template <int P, class N>
PLUMB_HD PerPoint<P, N> separations_now(const Contact<P, N>& contact, const SolverBody<N>& a, const SolverBody<N>& b) {
  const Vec3<N> n = contact.normal;
  const N at_centre = dot(displacement_at(b, contact.centre_b) - displacement_at(a, contact.centre_a), n);
  // n . (turn of b - turn of a) arm, by the turns' transposes
  const Vec3<N> by_b = change_by_turn(conjugate(b.rotated), n), by_a = change_by_turn(conjugate(a.rotated), n);
  const Vec3<N> by_arm = by_b - by_a;
  const N rolled = contact.rolling_radius[0] * dot(by_a, n) + contact.rolling_radius[1] * dot(by_b, n);
  const N along1 = dot(by_arm, contact.tangent), along2 = dot(by_arm, contact.bitangent());
  return contact.separation + (at_centre + rolled + (contact.place.x * along1 + contact.place.y * along2));
}

}  // namespace plumb::impulse
