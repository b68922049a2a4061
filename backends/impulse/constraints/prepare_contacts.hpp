// Solver rows from manifolds: arms, effective masses, last step's impulses.
#pragma once

#include "body.hpp"
#include "constraints/contact_rows.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_cache.hpp"
#include "solver/body_parts.hpp"
#include "solver/motion.hpp"
#include "solver/solver_bodies.hpp"
#include "step_counters.hpp"
#include "step_parameters.hpp"

namespace plumb::impulse {

struct PrepareContacts {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  SolverBodies solver_bodies;
  ContactRows rows;
  const StepCounters* counters;
  const std::uint32_t* order;    ///< rows of the cache by colour
  const std::uint32_t* colours;  ///< of each place in the order
  const StepParameters* parameters;
  std::uint32_t nobody;    ///< body slot that stands for none in unused lanes
  const PartRange* parts;  ///< by body: how many it is split into; null: bodies are whole

  /// Place j in the order by colour.
  PLUMB_HD void operator()(std::uint32_t j) const;

 private:
  /// By forces, m/s2.
  PLUMB_HD Vec acceleration(std::uint32_t body) const {
    const bool falls = (bodies.mass[body].flags & kBodyDynamic) != 0;
    return falls ? acceleration_by_forces(bodies, *parameters, body) : Vec{0, 0, 0};
  }
};

/// Unused lanes at the end of a colour: no points, no body.
struct PadColours {
  ContactRows rows;
  const StepCounters* counters;
  std::uint32_t nobody;
  PLUMB_HD void operator()(std::uint32_t colour) const {
    const std::uint32_t used = counters->first_in_colour[colour + 1] - counters->first_in_colour[colour];
    for (std::uint32_t slot = counters->first_slot[colour] + used; slot < counters->first_slot[colour + 1]; ++slot) {
      rows.body_a[slot] = rows.body_b[slot] = nobody;
      rows.count[slot] = 0;
      rows.row[slot] = kNone;
      ContactNumbers{}.store(rows.at(slot));
      if (Real* sums = rows.sums_at(slot); sums != nullptr)
        for (std::uint32_t f = 0; f < kSumFields; ++f) sums[f * kRowBlock] = 0;
    }
  }
};

/// Inverse of the 2 by 2 symmetric matrix of the tangents, or 0 where nothing gives way, and its smaller eigenvalue.
PLUMB_HD inline void put_tangent_mass(ContactNumbers& numbers, int point, Real k11, Real k12, Real k22) {
  const Real inverse = reciprocal_or_zero(k11 * k22 - k12 * k12);
  numbers.put(point_field(point, kTangentMass), {inverse * k22, -(inverse * k12), inverse * k11});
  const Real half = (k11 - k22) / 2;
  numbers.at[point_field(point, kTangentStep)] = reciprocal_or_zero((k11 + k22) / 2 + sqrt(half * half + k12 * k12));
}

/// Inverse of a symmetric positive definite matrix by Gauss and Jordan's elimination, which needs no pivots for those.
PLUMB_HD inline void invert(Real (&m)[kManifoldPoints][kManifoldPoints]) {
  PLUMB_UNROLL
  for (int k = 0; k < kManifoldPoints; ++k) {
    const Real pivot = Real(1) / m[k][k];
    m[k][k] = 1;
    PLUMB_UNROLL
    for (int j = 0; j < kManifoldPoints; ++j) m[k][j] = pivot * m[k][j];
    PLUMB_UNROLL
    for (int i = 0; i < kManifoldPoints; ++i) {
      if (i == k) continue;
      const Real factor = m[i][k];
      m[i][k] = 0;
      PLUMB_UNROLL
      for (int j = 0; j < kManifoldPoints; ++j) m[i][j] = m[i][j] - factor * m[k][j];
    }
  }
}

/// The two bodies of a contact, and how they give way to impulses at it.
struct ContactEnds {
  Sym inertia_a, inertia_b;  ///< inverse
  Real inverse_mass;         ///< of both together

  /// Turns of both bodies by an impulse of 1 N s along a direction.
  struct Turn {
    Vec arm_a, arm_b;  ///< arm x direction
    Vec by_a, by_b;    ///< change of angular velocity
  };
  PLUMB_HD Turn turn(const Vec& arm_a, const Vec& arm_b, const Vec& direction) const {
    const Vec a = cross(arm_a, direction), b = cross(arm_b, direction);
    return {a, b, inertia_a * a, inertia_b * b};
  }
  /// Speed along the direction of u for an impulse along that of v, but for what the masses give.
  PLUMB_HD static Real give(const Turn& u, const Turn& v) { return dot(u.arm_a, v.by_a) + dot(u.arm_b, v.by_b); }
};

/// The matrix that gives all normal speeds for all normal impulses, and its inverse. Four points of a plane have but
/// three ways to move: a share of each point's own softness is added, without which there is no inverse. With much less
/// of it the impulses of the fourth way wander, and towers tremble.
PLUMB_HD inline void put_matrix(ContactNumbers& numbers, int count, Real inverse_mass,
                                const ContactEnds::Turn (&turns)[kManifoldPoints]) {
  const Real share = count > 1 ? Real(0.05) : Real(0);
  const bool moves = inverse_mass > 0;
  Real m[kManifoldPoints][kManifoldPoints];
  std::uint32_t field = kCoupling;
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    const bool there = moves && p < count;
    m[p][p] = there ? (1 + share) * (inverse_mass + ContactEnds::give(turns[p], turns[p])) : Real(1);
    PLUMB_UNROLL
    for (int q = p + 1; q < kManifoldPoints; ++q, ++field) {
      m[p][q] = m[q][p] = moves && q < count ? inverse_mass + ContactEnds::give(turns[p], turns[q]) : Real(0);
      numbers.at[field] = m[p][q];
    }
  }
  invert(m);
  field = kBlockInverse;
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) PLUMB_UNROLL
  for (int q = p; q < kManifoldPoints; ++q, ++field) numbers.at[field] = moves && q < count ? m[p][q] : Real(0);
}

PLUMB_HD inline void PrepareContacts::operator()(std::uint32_t j) const {
  const std::uint32_t row = order[j], colour = colours[j];
  const std::uint32_t slot = counters->first_slot[colour] + (j - counters->first_in_colour[colour]);
  const std::uint32_t candidate = cache.candidate[row];
  const Pair pair = cache.pairs[candidate];
  const Manifold& found = cache.found[candidate];
  const CachedManifold& kept = cache.kept[row];
  const Proxy &proxy_a = proxies.rows[pair.a], &proxy_b = proxies.rows[pair.b];
  const std::uint32_t a = proxy_a.body, b = proxy_b.body;
  const Vec offset_a = rotate(bodies.orientation[a], proxy_a.frame.position);
  const Vec from_a_to_b = between(bodies.position[a], bodies.position[b]);
  const auto split = [this](std::uint32_t body) {
    return parts == nullptr ? Real(1) : static_cast<Real>(parts[body].end - parts[body].first);
  };
  const Real parts_a = split(a), parts_b = split(b);
  const ContactEnds ends = {parts_a * solver_bodies.inertia[a].inverse, parts_b * solver_bodies.inertia[b].inverse,
                            parts_a * bodies.velocity[a].inverse_mass + parts_b * bodies.velocity[b].inverse_mass};

  rows.body_a[slot] = a;
  rows.body_b[slot] = b;
  rows.count[slot] = kept.count;
  rows.row[slot] = row;
  ContactNumbers numbers{};
  const Real warm_start = parameters->warm_start;
  const Vec n = kept.normal, t1 = kept.tangent, t2 = cross(n, t1);
  numbers.put(kNormal, n);
  numbers.put(kTangent, t1);
  Vec centre = {0, 0, 0};
  for (int p = 0; p < static_cast<int>(kept.count); ++p) centre += found.points[p].position;
  centre = (Real(1) / static_cast<Real>(kept.count)) * centre;
  // Points that are apart will touch each body where its surface is now, not midway: a ball that comes fast has its own
  // radius for an arm. What touches first counts for all.
  Real gap = found.points[0].separation;
  for (int p = 1; p < static_cast<int>(kept.count); ++p) gap = min(gap, found.points[p].separation);
  const Vec half_gap = max(gap, Real(0)) / 2 * n;
  const Vec middle = offset_a + centre, centre_a = middle - half_gap, centre_b = middle + half_gap - from_a_to_b;
  numbers.put(kCentreA, centre_a);
  numbers.put(kCentreB, centre_b);
  numbers.at[kFriction] = sqrt(proxy_a.friction * proxy_b.friction);
  numbers.at[kRestitution] = max(proxy_a.restitution, proxy_b.restitution);
  if (numbers.at[kRestitution] > 0) numbers.at[kPull] = parameters->h * dot(acceleration(b) - acceleration(a), n);
  ContactEnds::Turn normal_turns[kManifoldPoints] = {};
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    const auto field = [p](std::uint32_t f) { return point_field(p, f); };
    if (p >= static_cast<int>(kept.count)) continue;
    const Vec arm = found.points[p].position - centre, arm_a = centre_a + arm, arm_b = centre_b + arm;
    normal_turns[p] = ends.turn(arm_a, arm_b, n);
    const ContactEnds::Turn turn1 = ends.turn(arm_a, arm_b, t1), turn2 = ends.turn(arm_a, arm_b, t2);
    const Real normal_give = ends.inverse_mass + ContactEnds::give(normal_turns[p], normal_turns[p]);
    numbers.put(field(kArm), arm);
    numbers.at[field(kSeparation)] = found.points[p].separation;
    numbers.at[field(kNormalGive)] = normal_give;
    numbers.at[field(kNormalMass)] = reciprocal_or_zero(normal_give);
    put_tangent_mass(numbers, p, ends.inverse_mass + ContactEnds::give(turn1, turn1), ContactEnds::give(turn1, turn2),
                     ends.inverse_mass + ContactEnds::give(turn2, turn2));
    numbers.at[field(kNormalImpulse)] = warm_start * kept.normal_impulse[p];
    numbers.at[field(kTangentImpulse)] = warm_start * kept.tangent_impulse[0][p];
    numbers.at[field(kTangentImpulse) + 1] = warm_start * kept.tangent_impulse[1][p];
    numbers.at[field(kImpactSpeed)] = kWaits / 2;
  }
  if (Real* sums = rows.sums_at(slot); sums != nullptr)
    for (std::uint32_t i = 0; i < kSumFields; ++i) sums[i * kRowBlock] = 0;
  put_matrix(numbers, static_cast<int>(kept.count), ends.inverse_mass, normal_turns);
  numbers.store(rows.at(slot));
}

/// Writes the impulses of a solver row back to the contact cache.
struct KeepImpulses {
  ContactCache cache;
  ContactRows rows;
  StepImpulses* step_impulses;  ///< by row of the cache; null where nobody asks
  PLUMB_HD void operator()(std::uint32_t slot) const {
    if (rows.row[slot] == kNone) return;
    CachedManifold& kept = cache.kept[rows.row[slot]];
    const Real* numbers = rows.at(slot);
    for (int p = 0; p < static_cast<int>(kept.count); ++p) {
      kept.normal_impulse[p] = numbers[place_of(point_field(p, kNormalImpulse))];
      kept.tangent_impulse[0][p] = numbers[place_of(point_field(p, kTangentImpulse))];
      kept.tangent_impulse[1][p] = numbers[place_of(point_field(p, kTangentImpulse + 1))];
    }
    if (step_impulses == nullptr) return;
    StepImpulses& kept_sums = step_impulses[rows.row[slot]];
    const Real* sums = rows.sums_at(slot);
    for (int p = 0; p < kManifoldPoints; ++p, sums += 3 * kRowBlock) {
      kept_sums.normal[p] = sums[0];
      kept_sums.tangent[0][p] = sums[kRowBlock];
      kept_sums.tangent[1][p] = sums[2 * kRowBlock];
    }
  }
};

}  // namespace plumb::impulse
