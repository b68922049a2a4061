// Solver rows from manifolds: arms, effective masses, last step's impulses.
#pragma once

#include "body.hpp"
#include "constraints/contact_rows.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_cache.hpp"
#include "solver/body_parts.hpp"
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
      Real* numbers = rows.at(slot);
      for (std::uint32_t f = 0; f < kAllFields; ++f) numbers[f * kRowBlock] = 0;
    }
  }
};

/// Inverse of the 2 by 2 symmetric matrix of the tangents, or 0 where nothing gives way, and its smaller eigenvalue.
PLUMB_HD inline void put_tangent_mass(Real* numbers, int point, Real k11, Real k12, Real k22) {
  const Real inverse = reciprocal_or_zero(k11 * k22 - k12 * k12);
  Real* mass = numbers + point_field(point, kTangentMass) * kRowBlock;
  mass[0] = inverse * k22;
  mass[kRowBlock] = -(inverse * k12);
  mass[2 * kRowBlock] = inverse * k11;
  const Real half = (k11 - k22) / 2;
  numbers[point_field(point, kTangentStep) * kRowBlock] =
      reciprocal_or_zero((k11 + k22) / 2 + sqrt(half * half + k12 * k12));
}

/// Inverse of a symmetric positive definite matrix by Gauss and Jordan's elimination, which needs no pivots for those.
PLUMB_HD inline void invert(Real (&m)[kManifoldPoints][kManifoldPoints]) {
  for (int k = 0; k < kManifoldPoints; ++k) {
    const Real pivot = Real(1) / m[k][k];
    m[k][k] = 1;
    for (int j = 0; j < kManifoldPoints; ++j) m[k][j] = pivot * m[k][j];
    for (int i = 0; i < kManifoldPoints; ++i) {
      if (i == k) continue;
      const Real factor = m[i][k];
      m[i][k] = 0;
      for (int j = 0; j < kManifoldPoints; ++j) m[i][j] = m[i][j] - factor * m[k][j];
    }
  }
}

/// The matrix that gives all normal speeds for all normal impulses, inverted. Four points of a plane have but three
/// ways to move: a share of each point's own softness is added, without which there is no inverse. With much less of it
/// the impulses of the fourth way wander, and towers tremble.
PLUMB_HD inline void put_block_inverse(Real* numbers, std::uint32_t count, Real inverse_mass, const Sym& inertia_a,
                                       const Sym& inertia_b) {
  const Real share = count > 1 ? Real(0.05) : Real(0);
  const RowAccess<Real> row{numbers};
  const Vec n = row.vector(kNormal);
  Real m[kManifoldPoints][kManifoldPoints] = {};
  Vec turn_a[kManifoldPoints], turn_b[kManifoldPoints];
  for (int p = 0; p < kManifoldPoints; ++p) {
    turn_a[p] = cross(row.vector(point_field(p, kArmA)), n);
    turn_b[p] = cross(row.vector(point_field(p, kArmB)), n);
  }
  for (int p = 0; p < kManifoldPoints; ++p)
    for (int q = 0; q < kManifoldPoints; ++q) {
      const bool there = max(p, q) < static_cast<int>(count);
      m[p][q] = there ? inverse_mass + dot(turn_a[p], inertia_a * turn_a[q]) + dot(turn_b[p], inertia_b * turn_b[q])
                      : Real(p == q ? 1 : 0);
    }
  const bool moves = inverse_mass > 0;
  for (int p = 0; p < kManifoldPoints; ++p) m[p][p] = moves ? (1 + share) * m[p][p] : Real(1);
  invert(m);
  std::uint32_t field = kBlockInverse;
  for (int p = 0; p < kManifoldPoints; ++p)
    for (int q = p; q < kManifoldPoints; ++q, ++field)
      row.put(field, moves && q < static_cast<int>(count) ? m[p][q] : Real(0));
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
  const Sym inertia_a = parts_a * solver_bodies.inertia[a].inverse,
            inertia_b = parts_b * solver_bodies.inertia[b].inverse;
  const Real inverse_mass = parts_a * bodies.velocity[a].inverse_mass + parts_b * bodies.velocity[b].inverse_mass;

  rows.body_a[slot] = a;
  rows.body_b[slot] = b;
  rows.count[slot] = kept.count;
  rows.row[slot] = row;
  Real* numbers = rows.at(slot);
  const Real warm_start = parameters->warm_start;
  const auto put = [numbers](std::uint32_t field, Real value) { numbers[field * kRowBlock] = value; };
  const auto put_vector = [&put](std::uint32_t field, const Vec& v) {
    put(field, v.x);
    put(field + 1, v.y);
    put(field + 2, v.z);
  };
  const Vec n = kept.normal, t1 = kept.tangent, t2 = cross(n, t1);
  put_vector(kNormal, n);
  put_vector(kTangent, t1);
  put(kFriction, sqrt(proxy_a.friction * proxy_b.friction));
  put(kRestitution, max(proxy_a.restitution, proxy_b.restitution));
  for (int p = 0; p < kManifoldPoints; ++p) {
    const auto field = [p](std::uint32_t f) { return point_field(p, f); };
    if (p >= static_cast<int>(kept.count)) {
      for (std::uint32_t f = 0; f < kPointFields; ++f) put(field(f), 0);
      continue;
    }
    const Vec arm_a = offset_a + found.points[p].position, arm_b = arm_a - from_a_to_b;
    const auto give = [&](const Vec& u, const Vec& v) {  // u . K v, K the matrix of the point
      return inverse_mass * dot(u, v) + dot(cross(arm_a, u), inertia_a * cross(arm_a, v)) +
             dot(cross(arm_b, u), inertia_b * cross(arm_b, v));
    };
    put_vector(field(kArmA), arm_a);
    put_vector(field(kArmB), arm_b);
    put(field(kSeparation), found.points[p].separation);
    put(field(kNormalGive), give(n, n));
    put(field(kNormalMass), reciprocal_or_zero(give(n, n)));
    put_tangent_mass(numbers, p, give(t1, t1), give(t1, t2), give(t2, t2));
    put(field(kNormalImpulse), warm_start * kept.normal_impulse[p]);
    put(field(kTangentImpulse), warm_start * kept.tangent_impulse[0][p]);
    put(field(kTangentImpulse + 1), warm_start * kept.tangent_impulse[1][p]);
    put(field(kImpactSpeed), 1);
    put(field(kOpen), 0);
    for (std::uint32_t i = 0; i < 3; ++i) put(field(kStepImpulse + i), 0);
  }
  put_block_inverse(numbers, kept.count, inverse_mass, inertia_a, inertia_b);
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
      kept.normal_impulse[p] = numbers[point_field(p, kNormalImpulse) * kRowBlock];
      kept.tangent_impulse[0][p] = numbers[point_field(p, kTangentImpulse) * kRowBlock];
      kept.tangent_impulse[1][p] = numbers[point_field(p, kTangentImpulse + 1) * kRowBlock];
    }
    if (step_impulses == nullptr) return;
    StepImpulses& sums = step_impulses[rows.row[slot]];
    for (int p = 0; p < kManifoldPoints; ++p) {
      sums.normal[p] = numbers[point_field(p, kStepImpulse) * kRowBlock];
      sums.tangent[0][p] = numbers[point_field(p, kStepImpulse + 1) * kRowBlock];
      sums.tangent[1][p] = numbers[point_field(p, kStepImpulse + 2) * kRowBlock];
    }
  }
};

}  // namespace plumb::impulse
