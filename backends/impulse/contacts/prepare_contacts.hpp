// Solver rows from manifolds: arms, effective masses, last step's impulses.
#pragma once

#include "bodies/body.hpp"
#include "bodies/motion.hpp"
#include "bodies/step_counters.hpp"
#include "bodies/step_parameters.hpp"
#include "bodies/way.hpp"
#include "contacts/body_lanes.hpp"
#include "contacts/body_parts.hpp"
#include "contacts/contact.hpp"
#include "contacts/contact_frame.hpp"
#include "contacts/contact_rows.hpp"
#include "contacts/rolling.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// Where the bodies of a contact are when it closes, by their ways until then; as they are now for all contacts but
/// those of an impact within the step.
struct ContactTime {
  Vec moved_a, moved_b;
  Quat turn_a, turn_b;

  PLUMB_HD ContactTime(const Way& a, const Way& b, Real time)
      : moved_a(time * a.linear), moved_b(time * b.linear), turn_a(a.turn(time)), turn_b(b.turn(time)) {}
  /// By how much a gap at the centre of the points, and at places about it, is smaller then.
  PLUMB_HD Real closed(const Vec& n, const Vec& t1, const Vec& centre_a, const Vec& centre_b,
                       const PlanePoint<Real>& place, Real rolling_a, Real rolling_b) const {
    const Vec by_a = moved_a + change_by_turn(turn_a, centre_a), by_b = moved_b + change_by_turn(turn_b, centre_b);
    const Vec turned_b = change_by_turn(conjugate(turn_b), n), turned_a = change_by_turn(conjugate(turn_a), n);
    const Vec by_arm = turned_b - turned_a;
    const Real rolled = rolling_a * dot(turned_a, n) + rolling_b * dot(turned_b, n);
    return dot(by_b - by_a, n) + rolled + place.x * dot(by_arm, t1) + place.y * dot(by_arm, cross(n, t1));
  }
};

/// Of what two bodies of one mechanism would move alone the share below which a contact between them pushes less and
/// less, and the least that counts.
constexpr Real kShareLeft = Real(0.01), kLeastLeft = Real(1e-6);

/// The matrix of contact_frame.hpp. In its order: normal, turns about the tangents; tangents, turn about the normal.
struct FrameDelassus {
  Real at[6][6];

  PLUMB_HD FrameDelassus(const Vec& n, const Vec& t1, const Vec& arm_a, const Vec& arm_b, const Sym& inertia_a,
                         const Sym& inertia_b, Real inverse_mass) {
    const Vec t2 = cross(n, t1);
    const Vec turns_a[6] = {cross(arm_a, n), t1, t2, cross(arm_a, t1), cross(arm_a, t2), n};
    const Vec turns_b[6] = {cross(arm_b, n), t1, t2, cross(arm_b, t1), cross(arm_b, t2), n};
    PLUMB_UNROLL
    for (int j = 0; j < 6; ++j) {
      const Vec by_a = inertia_a * turns_a[j], by_b = inertia_b * turns_b[j];
      PLUMB_UNROLL
      for (int i = 0; i <= j; ++i) at[i][j] = at[j][i] = dot(turns_a[i], by_a) + dot(turns_b[i], by_b);
    }
    at[0][0] = at[0][0] + inverse_mass;
    at[3][3] = at[3][3] + inverse_mass;
    at[4][4] = at[4][4] + inverse_mass;
  }
  /// Adds what wrenches on body `from` give at body `to`, of one mechanism or the same body: sign is -1 where one is a
  /// and the other b.
  PLUMB_HD void add(const Mechanisms& mechanisms, std::uint32_t from, const Six (&at_from)[6], std::uint32_t to,
                    const Six (&at_to)[6], Real sign) {
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) at[i][j] = at[i][j] + sign * mechanisms.work(from, at_from[j], to, at_to[i]);
  }
  /// Between two bodies of one mechanism: what they move against each other is a difference of large numbers, and next
  /// to nothing where joints hold them against each other. The less of what they would move `alone` is left along the
  /// normal, the less a contact may push: joints and contact would strive against each other, with ever more.
  PLUMB_HD void yield_where_joints_hold(const FrameDelassus& alone) {
    const Real over = kShareLeft / max(at[0][0] / alone.at[0][0], kLeastLeft), share = kShareLeft * over * over;
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) at[i][j] = at[i][j] + share * alone.at[i][j];
  }
  /// The half below the diagonal is that above it.
  PLUMB_HD void mirror() {
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < j; ++i) at[j][i] = at[i][j];
  }

  PLUMB_HD void copy_normal(Real (&m)[6]) const {
    m[0] = at[0][0];
    m[1] = at[0][1];
    m[2] = at[0][2];
    m[3] = at[1][1];
    m[4] = at[1][2];
    m[5] = at[2][2];
  }
  /// The largest that an impulse along a tangent at p gives in slip there, 1/kg.
  PLUMB_HD Real largest_slip(const PlanePoint<Real>& p) const {
    const Real x = p.x, y = p.y, spin = at[5][5];
    const Real k11 = at[3][3] - 2 * y * at[3][5] + y * y * spin;
    const Real k12 = at[3][4] + x * at[3][5] - y * at[4][5] - x * y * spin;
    const Real k22 = at[4][4] + 2 * x * at[4][5] + x * x * spin;
    const Real half = (k11 - k22) / 2;
    return (k11 + k22) / 2 + sqrt(half * half + k12 * k12);
  }
};

/// The wrenches of the frame's six directions on a body, or the motions there that they see.
PLUMB_HD inline void frame_wrenches(const Vec& n, const Vec& t1, const Vec& arm, Six (&wrenches)[6]) {
  const Vec t2 = cross(n, t1), zero = {0, 0, 0};
  wrenches[0] = six(n, cross(arm, n));
  wrenches[1] = six(zero, t1);
  wrenches[2] = six(zero, t2);
  wrenches[3] = six(t1, cross(arm, t1));
  wrenches[4] = six(t2, cross(arm, t2));
  wrenches[5] = six(zero, n);
}

/// kImpacts: some contacts may be of impacts within the step. kMechanisms: some bodies may move with a mechanism.
template <bool kImpacts, bool kMechanisms>
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
  std::uint32_t sentinel;  ///< body slot that stands for none in unused lanes
  const PartRange* parts;  ///< by body: how many it is split into; null: bodies are whole
  const Real* impacts;     ///< by candidate: when it closes, s; 0: it is as it is now. With kImpacts only

  /// Place j in the order by colour.
  PLUMB_HD void operator()(std::uint32_t j) const;

 private:
  [[nodiscard]] PLUMB_HD bool is_alone(std::uint32_t body) const {
    return !kMechanisms || !solver_bodies.mechanisms.hold(body);
  }
  /// Of a body that does not move with a mechanism; else 0.
  PLUMB_HD Real inverse_mass_alone(std::uint32_t body) const {
    return is_alone(body) ? bodies.velocity[body].inverse_mass : Real(0);
  }
  PLUMB_HD Sym inverse_inertia(std::uint32_t body) const {
    return is_alone(body) ? solver_bodies.inertia[body].inverse : Sym{0, 0, 0, 0, 0, 0};
  }
  PLUMB_HD void add_mechanisms(FrameDelassus& delassus, const Vec& n, const Vec& t1, std::uint32_t a, const Vec& arm_a,
                               std::uint32_t b, const Vec& arm_b) const {
    const Mechanisms& mechanisms = solver_bodies.mechanisms;
    const bool a_is_in = mechanisms.hold(a), b_is_in = mechanisms.hold(b);
    Six on_a[6], on_b[6];
    frame_wrenches(n, t1, arm_a, on_a);
    frame_wrenches(n, t1, arm_b, on_b);
    if (a_is_in) delassus.add(mechanisms, a, on_a, a, on_a, 1);
    if (b_is_in) delassus.add(mechanisms, b, on_b, b, on_b, 1);
    if (mechanisms.together(a, b)) {
      delassus.add(mechanisms, a, on_a, b, on_b, -1);
      delassus.add(mechanisms, b, on_b, a, on_a, -1);
      const FrameDelassus alone(n, t1, arm_a, arm_b, solver_bodies.inertia[a].inverse, solver_bodies.inertia[b].inverse,
                                bodies.velocity[a].inverse_mass + bodies.velocity[b].inverse_mass);
      delassus.yield_where_joints_hold(alone);
    }
    if (a_is_in || b_is_in) delassus.mirror();
  }
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
  std::uint32_t sentinel;
  PLUMB_HD void operator()(std::uint32_t colour) const {
    const std::uint32_t used = counters->first_in_colour[colour + 1] - counters->first_in_colour[colour];
    for (std::uint32_t slot = counters->first_slot[colour] + used; slot < counters->first_slot[colour + 1]; ++slot)
      clear(slot);
    if (colour == 0) clear(rows.spare);
  }

 private:
  PLUMB_HD void clear(std::uint32_t slot) const {
    rows.body_a[slot] = rows.body_b[slot] = sentinel;
    rows.count[slot] = 0;
    rows.row[slot] = kNone;
    ContactNumbers{}.store(rows.at(slot));
    if (Real* sums = rows.sums_at(slot); sums != nullptr)
      for (std::uint32_t f = 0; f < kSumFields; ++f) sums[f * kRowBlock] = 0;
  }
};

/// Inverse of a symmetric positive definite matrix by Gauss and Jordan's elimination, which needs no pivots for those.
template <int R>
PLUMB_HD void invert(Real (&m)[R][R]) {
  PLUMB_UNROLL
  for (int k = 0; k < R; ++k) {
    const Real pivot = Real(1) / m[k][k];
    m[k][k] = 1;
    PLUMB_UNROLL
    for (int j = 0; j < R; ++j) m[k][j] = pivot * m[k][j];
    PLUMB_UNROLL
    for (int i = 0; i < R; ++i) {
      if (i == k) continue;
      const Real factor = m[i][k];
      m[i][k] = 0;
      PLUMB_UNROLL
      for (int j = 0; j < R; ++j) m[i][j] = m[i][j] - factor * m[k][j];
    }
  }
}

/// Inverse of the matrix that gives all normal speeds for all normal impulses. Four points of a plane have but three
/// ways to move: a share of each point's own softness is added, without which there is no inverse. With much less of it
/// impulses drift in the null space, and towers tremble.
struct NormalBlock {
  Real inverse[kManifoldPoints][kManifoldPoints];

  PLUMB_HD NormalBlock(ContactNumbers& numbers, int count, const FrameDelassus& delassus,
                       const PlanePoint<Real> (&places)[kManifoldPoints]) {
    const Real share = count > 1 ? Real(0.05) : Real(0);
    const bool moves = delassus.at[0][0] > 0;
    Real normal[6];
    delassus.copy_normal(normal);
    PLUMB_UNROLL
    for (int p = 0; p < kManifoldPoints; ++p) {
      const bool there = moves && p < count;
      const Real own = there ? speed_at(apply_delassus_at(normal, places[p]), places[p]) : Real(0);
      inverse[p][p] = there ? (1 + share) * own : Real(1);
      PLUMB_UNROLL
      for (int q = p + 1; q < kManifoldPoints; ++q)
        inverse[p][q] = inverse[q][p] =
            moves && q < count ? speed_at(apply_delassus_at(normal, places[p]), places[q]) : Real(0);
    }
    invert(inverse);
    PLUMB_UNROLL
    for (int p = 0; p < kManifoldPoints; ++p) PLUMB_UNROLL
    for (int q = 0; q < kManifoldPoints; ++q) {
      if (!(moves && p < count && q < count)) inverse[p][q] = 0;
      numbers.at[point_field(p, kBlockInverse) + static_cast<std::uint32_t>(q)] = inverse[p][q];
    }
  }
};

/// What stops slip: the inverse of a block of friction. One point does not rub against a turn about the normal; nor
/// does a patch whose bodies cannot turn.
PLUMB_HD inline void put_stop_mass(ContactNumbers& numbers, std::uint32_t field, int count, const Real (&block)[3][3]) {
  const bool moves = block[0][0] > 0, turns = moves && count > 1 && block[2][2] > 0;
  Real m[3][3];
  PLUMB_UNROLL
  for (int i = 0; i < 3; ++i) PLUMB_UNROLL
  for (int j = 0; j < 3; ++j) {
    const bool there = i < 2 && j < 2 ? moves : turns;
    m[i][j] = there ? block[i][j] : i == j ? Real(1) : Real(0);
  }
  invert(m);
  PLUMB_UNROLL
  for (int i = 0; i < 3; ++i) PLUMB_UNROLL
  for (int j = i; j < 3; ++j) {
    const bool there = j < 2 ? moves : turns;
    numbers.at[field++] = there ? m[i][j] : Real(0);
  }
}

/// The matrix of the frame, and what stops slip in it.
PLUMB_HD inline void put_frame_matrix(ContactNumbers& numbers, int count, const FrameDelassus& delassus,
                                      const NormalBlock& normals, const PlanePoint<Real> (&places)[kManifoldPoints]) {
  Real normal[6];
  delassus.copy_normal(normal);
  std::uint32_t field = kDelassus;
  PLUMB_UNROLL
  for (int i = 0; i < 6; ++i) numbers.at[field++] = normal[i];
  Real across[kManifoldPoints][3];  // normal speed of each point for friction
  PLUMB_UNROLL
  for (int i = 0; i < 3; ++i) PLUMB_UNROLL
  for (int j = 0; j < 3; ++j) numbers.at[field++] = delassus.at[i][3 + j];
  Real free[3][3], held[3][3];
  PLUMB_UNROLL
  for (int j = 0; j < 3; ++j) {
    PLUMB_UNROLL
    for (int i = 0; i < 3; ++i) {
      held[i][j] = free[i][j] = delassus.at[3 + i][3 + j];
      if (j >= i) numbers.at[field + static_cast<std::uint32_t>(i * (5 - i) / 2 + j)] = free[i][j];
    }
    PLUMB_UNROLL
    for (int p = 0; p < kManifoldPoints; ++p)
      across[p][j] =
          speed_at(NormalPart<Real>{delassus.at[0][3 + j], delassus.at[1][3 + j], delassus.at[2][3 + j]}, places[p]);
  }
  // What friction does along the normals is undone by them.
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) PLUMB_UNROLL
  for (int j = 0; j < 3; ++j) {
    Real undone = 0;
    PLUMB_UNROLL
    for (int q = 0; q < kManifoldPoints; ++q) undone = undone + normals.inverse[p][q] * across[q][j];
    PLUMB_UNROLL
    for (int i = 0; i < 3; ++i) held[i][j] = held[i][j] - across[p][i] * undone;
  }
  put_stop_mass(numbers, field + 6, count, free);
  put_stop_mass(numbers, field + 12, count, held);
}

template <bool kImpacts, bool kMechanisms>
PLUMB_HD void PrepareContacts<kImpacts, kMechanisms>::operator()(std::uint32_t j) const {
  const std::uint32_t row = order[j], colour = colours[j];
  const std::uint32_t slot = counters->first_slot[colour] + (j - counters->first_in_colour[colour]);
  const std::uint32_t candidate = cache.candidate[row];
  const Pair pair = cache.pairs[candidate];
  const Manifold& found = cache.found[candidate];
  const CachedManifold& kept = cache.kept[row];
  const Proxy &proxy_a = proxies.rows[pair.a], &proxy_b = proxies.rows[pair.b];
  const std::uint32_t a = proxy_a.body, b = proxy_b.body;
  Vec offset_a = rotate(bodies.orientation[a], proxy_a.frame.position);
  Vec from_a_to_b = between(bodies.position[a], bodies.position[b]);
  [[maybe_unused]] const Real closes_at = kImpacts ? impacts[candidate] : Real(0);
  [[maybe_unused]] const auto then = [&] {
    return ContactTime(way_through_step(bodies, *parameters, a), way_through_step(bodies, *parameters, b), closes_at);
  };
  if (kImpacts && closes_at > 0) {
    const ContactTime at = then();
    offset_a = rotate(normalized(at.turn_a * bodies.orientation[a]), proxy_a.frame.position);
    from_a_to_b += at.moved_b - at.moved_a;
  }
  const auto split = [this](std::uint32_t body) {
    return parts == nullptr ? Real(1) : static_cast<Real>(parts[body].end - parts[body].first);
  };
  const Real parts_a = split(a), parts_b = split(b);
  const Real inverse_mass = parts_a * inverse_mass_alone(a) + parts_b * inverse_mass_alone(b);

  rows.body_a[slot] = a;
  rows.body_b[slot] = b;
  rows.count[slot] = kept.count;
  rows.row[slot] = row;
  ContactNumbers numbers{};
  const Real warm_start = parameters->warm_start;
  const Vec n = kept.normal, t1 = kept.tangent, t2 = cross(n, t1);
  numbers.put(kNormal, n);
  numbers.put(kTangent, t1);
  const int count = static_cast<int>(kept.count);
  // Points that are apart lie midway between the bodies, above those that touch; when they come to touch, they do so in
  // the plane of the nearest.
  Vec centre = found.points[0].position;
  Real gap = found.points[0].separation, height = dot(centre, n);
  for (int p = 1; p < count; ++p) {
    centre += found.points[p].position;
    const bool nearer = found.points[p].separation < gap;
    gap = select(nearer, found.points[p].separation, gap);
    height = select(nearer, dot(found.points[p].position, n), height);
  }
  centre = (Real(1) / static_cast<Real>(count)) * centre;
  centre += (height - dot(centre, n)) * n;
  // A patch that is apart will touch each body where its surface is now, not midway: a ball that comes fast has its own
  // radius for an arm.
  const Vec half_gap = max(gap, Real(0)) / 2 * n;
  const Vec middle = offset_a + centre;
  Vec centre_a = middle - half_gap, centre_b = middle + half_gap - from_a_to_b;
  if (kImpacts && closes_at > 0) {
    const ContactTime at = then();
    centre_a = rotate(conjugate(at.turn_a), centre_a);
    centre_b = rotate(conjugate(at.turn_b), centre_b);
  }
  const Real rolling_a = rolling_radius(proxies.shapes[proxy_a.shape], shape_pose(proxy_a, bodies.orientation[a]), n);
  const Real rolling_b = rolling_radius(proxies.shapes[proxy_b.shape], shape_pose(proxy_b, bodies.orientation[b]), n);
  numbers.at[kRollingRadius] = rolling_a;
  numbers.at[kRollingRadius + 1] = rolling_b;
  numbers.put(kCentreA, centre_a);
  numbers.put(kCentreB, centre_b);
  numbers.at[kFriction] = sqrt(proxy_a.friction * proxy_b.friction);
  numbers.at[kRestitution] = max(proxy_a.restitution, proxy_b.restitution);
  if (numbers.at[kRestitution] > 0) numbers.at[kPull] = parameters->h * dot(acceleration(b) - acceleration(a), n);
  FrameDelassus delassus(n, t1, centre_a, centre_b, parts_a * inverse_inertia(a), parts_b * inverse_inertia(b),
                         inverse_mass);
  if constexpr (kMechanisms) add_mechanisms(delassus, n, t1, a, centre_a, b, centre_b);
  PlanePoint<Real> places[kManifoldPoints] = {};
  Real largest_slip = 0;
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    const auto field = [p](std::uint32_t f) { return point_field(p, f); };
    if (p >= count) continue;
    const Vec arm = found.points[p].position - centre;
    if (count > 1) places[p] = {dot(arm, t1), dot(arm, t2)};
    largest_slip = max(largest_slip, delassus.largest_slip(places[p]));
    numbers.at[field(kPlace)] = places[p].x;
    numbers.at[field(kPlace) + 1] = places[p].y;
    numbers.at[field(kSeparation)] = found.points[p].separation;
    if (kImpacts && closes_at > 0)
      numbers.at[field(kSeparation)] =
          found.points[p].separation - then().closed(n, t1, centre_a, centre_b, places[p], rolling_a, rolling_b);
    numbers.at[field(kNormalImpulse)] = warm_start * kept.normal_impulse[p];
    numbers.at[field(kTangentImpulse)] = warm_start * kept.tangent_impulse[0][p];
    numbers.at[field(kTangentImpulse) + 1] = warm_start * kept.tangent_impulse[1][p];
    numbers.at[field(kNoted)] = kNotPushedYet / 2;
  }
  numbers.at[kTangentStep] = reciprocal_or_zero(largest_slip);
  if (Real* sums = rows.sums_at(slot); sums != nullptr)
    for (std::uint32_t i = 0; i < kSumFields; ++i) sums[i * kRowBlock] = 0;
  const NormalBlock normals(numbers, count, delassus, places);
  put_frame_matrix(numbers, count, delassus, normals, places);
  numbers.at[kPointCount] = static_cast<Real>(count);
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
