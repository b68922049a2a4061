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
#include "contacts/contact_matrix.hpp"
#include "contacts/contact_rows.hpp"
#include "contacts/hand_over.hpp"
#include "contacts/rolling.hpp"
#include "exec/executor.hpp"
#include "math/lane_vectors.hpp"
#include "narrowphase/contact_material.hpp"
#include "narrowphase/manifold_change.hpp"

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

/// What a contact's numbers are worked out from; or those of kLanes contacts. Where there is no contact all are 0, and
/// so are its numbers.
template <class N>
struct ContactSource {
  Vec3<N> normal, tangent;
  N count;                            ///< of points
  Vec3<N> position[kManifoldPoints];  ///< from the origin of a's shape, world axes, m
  N separation[kManifoldPoints];
  N impulse[3][kManifoldPoints];  ///< along normal, tangent and bitangent, N s
  Vec3<N> offset_a;               ///< from the centre of mass of a to the origin of its shape, m
  Vec3<N> from_a_to_b;            ///< between the centres of mass, m
  N friction, restitution;
  N pull;                         ///< as kPull
  N rolling_radius[2];            ///< of a and b, m
  N inverse_mass;                 ///< of both together, 1/kg
  Sym33<N> inertia_a, inertia_b;  ///< inverse, world axes
};

/// Whose contacts the lanes are.
struct ContactEnds {
  std::uint32_t a[kLanes], b[kLanes];
  Real closes_at[kLanes];  ///< when within the step, s; 0: it is as it is now
};

/// Where the points of a manifold touch.
template <class N>
struct ContactPlace {
  Vec3<N> centre;              ///< of the points, from the origin of a's shape
  Vec3<N> centre_a, centre_b;  ///< from the centres of mass

  PLUMB_HD explicit ContactPlace(const ContactSource<N>& source) {
    const N zero = N(0);
    const Vec3<N>& n = source.normal;
    // Points that are apart lie midway between the bodies, above those that touch; when they come to touch, they do so
    // in the plane of the nearest.
    centre = source.position[0];
    N gap = source.separation[0], height = dot(centre, n);
    PLUMB_UNROLL
    for (int p = 1; p < kManifoldPoints; ++p) {
      const auto there = N(p) < source.count, nearer = there && source.separation[p] < gap;
      const Vec3<N>& position = source.position[p];
      centre = {select(there, centre.x + position.x, centre.x), select(there, centre.y + position.y, centre.y),
                select(there, centre.z + position.z, centre.z)};
      gap = select(nearer, source.separation[p], gap);
      height = select(nearer, dot(position, n), height);
    }
    centre = (N(1) / max(source.count, N(1))) * centre;
    centre += (height - dot(centre, n)) * n;
    // A patch that is apart will touch each body where its surface is now, not midway: a ball that comes fast has its
    // own radius for an arm.
    const Vec3<N> half_gap = max(gap, zero) / N(2) * n;
    const Vec3<N> middle = source.offset_a + centre;
    centre_a = middle - half_gap;
    centre_b = middle + half_gap - source.from_a_to_b;
  }
};

/// The numbers of the contact in each slot of the order by colour, and zeros in slots that only fill up a colour.
/// kImpacts: some contacts may be of impacts within the step. kMechanisms: some bodies may move with a mechanism.
template <bool kImpacts, bool kMechanisms>
struct PrepareContacts {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  SolverBodies solver_bodies;
  ContactRows rows;
  const StepCounters* counters;
  const std::uint32_t* order;  ///< rows of the cache by colour
  const std::uint64_t* masks;  ///< by body: colours of the contacts that push it
  const StepParameters* parameters;
  const SubstepLevels* levels;
  std::uint32_t sentinel;   ///< body slot that stands for none in unused lanes
  const PartRange* parts;   ///< by body: how many it is split into; null: bodies are whole
  const PairTime* impacts;  ///< by candidate: when it closes; 0: it is as it is now. With kImpacts only
  ManifoldChanges changes;

  /// kLanes slots from the first of them on.
  PLUMB_HD void operator()(std::uint32_t slot) const;

 private:
  using Source = ContactSource<Lanes>;

  /// The colour_key of a slot: the last one that begins there or before.
  [[nodiscard]] PLUMB_HD std::uint32_t key_of(std::uint32_t slot) const {
    std::uint32_t low = 0, high = colour_key(counters->levels.count, 0);
    while (high - low > 1) {
      const std::uint32_t middle = (low + high) / 2;
      (counters->first_slot[middle] <= slot ? low : high) = middle;
    }
    return low;
  }
  /// The row of the cache that belongs into a slot, or kNone.
  [[nodiscard]] PLUMB_HD std::uint32_t row_of(std::uint32_t slot, std::uint32_t key) const {
    const std::uint32_t place = counters->first_in_colour[key] + (slot - counters->first_slot[key]);
    return place < counters->first_in_colour[key + 1] ? order[place] : kNone;
  }
  PLUMB_HD void put_turns(std::uint32_t slot, std::uint32_t colour, std::uint32_t a, std::uint32_t b) const {
    rows.turns[slot] = {{bodies.velocity[a].inverse_mass, bodies.velocity[b].inverse_mass},
                        {turn_of(masks[a], colour), turn_of(masks[b], colour)}};
  }
  PLUMB_HD void leave_empty(std::uint32_t slot) const {
    rows.body_a[slot] = rows.body_b[slot] = sentinel;
    rows.count[slot] = 0;
    rows.row[slot] = kNone;
    if constexpr (kHandsOver) rows.turns[slot] = {};
  }
  PLUMB_HD void read(std::uint32_t row, std::uint32_t lane, Source& source, ContactEnds& ends) const;
  PLUMB_HD void move_to_impacts(const ContactEnds& ends, ContactPlace<Lanes>& place) const;
  /// Of what a push (a wrench) would move along itself if its body were alone the share that it does move: all where
  /// nothing is joined, nothing where the body cannot be pushed. mobility: what it moves in its mechanism, 1/kg.
  [[nodiscard]] PLUMB_HD Real share_left(std::uint32_t body, bool is_in, const Six& push, Real mobility) const;
  PLUMB_HD void add_mechanisms(const Source& source, const ContactEnds& ends, const ContactPlace<Lanes>& place,
                               FrameDelassus<Lanes>& delassus) const;

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
  [[nodiscard]] PLUMB_HD Real parts_of(std::uint32_t body) const {
    return parts == nullptr ? Real(1) : static_cast<Real>(parts[body].end - parts[body].first);
  }
  PLUMB_HD ContactTime time_of(const ContactEnds& ends, std::uint32_t lane) const {
    return ContactTime(way_through_step(bodies, *parameters, ends.a[lane]),
                       way_through_step(bodies, *parameters, ends.b[lane]), ends.closes_at[lane]);
  }
  /// By forces, m/s2.
  PLUMB_HD Vec acceleration(std::uint32_t body) const {
    const bool falls = (bodies.mass[body].flags & kBodyDynamic) != 0;
    return falls ? acceleration_by_forces(bodies, *parameters, body) : Vec{0, 0, 0};
  }
};

template <bool kImpacts, bool kMechanisms>
PLUMB_HD void PrepareContacts<kImpacts, kMechanisms>::read(std::uint32_t row, std::uint32_t lane, Source& source,
                                                           ContactEnds& ends) const {
  const std::uint32_t candidate = cache.candidate[row];
  const Pair pair = cache.pairs[candidate];
  const Manifold& found = cache.found[candidate];
  const CachedManifold& kept = cache.kept[row];
  const Proxy &proxy_a = proxies.rows[pair.a], &proxy_b = proxies.rows[pair.b];
  const std::uint32_t a = ends.a[lane] = proxy_a.body, b = ends.b[lane] = proxy_b.body;
  Vec offset_a = rotate(bodies.orientation[a], proxy_a.frame.position);
  Vec from_a_to_b = between(bodies.position[a], bodies.position[b]);
  ends.closes_at[lane] = kImpacts ? impacts[candidate].time : Real(0);
  if (kImpacts && ends.closes_at[lane] > 0) {
    const ContactTime at = time_of(ends, lane);
    offset_a = rotate(normalized(at.turn_a * bodies.orientation[a]), proxy_a.frame.position);
    from_a_to_b += at.moved_b - at.moved_a;
  }
  put_lane(source.offset_a, lane, offset_a);
  put_lane(source.from_a_to_b, lane, from_a_to_b);

  const Real warm_start = solver_bodies.levels.warm_start(*parameters, bodies.velocity, a, b);
  const Vec n = kept.normal;
  put_lane(source.normal, lane, n);
  put_lane(source.tangent, lane, kept.tangent);
  lane_of(source.count, lane) = static_cast<Real>(kept.count);
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    if (p >= static_cast<int>(kept.count)) continue;
    put_lane(source.position[p], lane, found.points[p].position);
    lane_of(source.separation[p], lane) = found.points[p].separation;
    lane_of(source.impulse[0][p], lane) = warm_start * kept.normal_impulse[p];
    lane_of(source.impulse[1][p], lane) = warm_start * kept.tangent_impulse[0][p];
    lane_of(source.impulse[2][p], lane) = warm_start * kept.tangent_impulse[1][p];
  }
  const Material material = contact_material(cache, proxies, candidate);
  const ManifoldChange* rubs = changes.find(candidate, PLUMB_MANIFOLD_FRICTION);
  lane_of(source.friction, lane) = rubs != nullptr ? rubs->friction : material.friction;
  const ManifoldChange* bounces = changes.find(candidate, PLUMB_MANIFOLD_RESTITUTION);
  const Real restitution = bounces != nullptr ? bounces->restitution : material.restitution;
  lane_of(source.restitution, lane) = restitution;
  if (restitution > 0) {
    const Real h = levels->of[solver_bodies.levels.of_pair(bodies.velocity, a, b)].h;
    lane_of(source.pull, lane) = h * dot(acceleration(b) - acceleration(a), n);
  }
  lane_of(source.rolling_radius[0], lane) = rolling_radius(proxies, proxy_a, bodies.orientation[a], n);
  lane_of(source.rolling_radius[1], lane) = rolling_radius(proxies, proxy_b, bodies.orientation[b], n);

  const Real parts_a = parts_of(a), parts_b = parts_of(b);
  lane_of(source.inverse_mass, lane) = parts_a * inverse_mass_alone(a) + parts_b * inverse_mass_alone(b);
  put_lane(source.inertia_a, lane, parts_a * inverse_inertia(a));
  put_lane(source.inertia_b, lane, parts_b * inverse_inertia(b));
}

/// Arms of the bodies as they are when the contact closes, seen from how they stand now.
template <bool kImpacts, bool kMechanisms>
PLUMB_HD void PrepareContacts<kImpacts, kMechanisms>::move_to_impacts(const ContactEnds& ends,
                                                                      ContactPlace<Lanes>& place) const {
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    if (!(ends.closes_at[lane] > 0)) continue;
    const ContactTime at = time_of(ends, lane);
    put_lane(place.centre_a, lane, rotate(conjugate(at.turn_a), vector_in_lane(place.centre_a, lane)));
    put_lane(place.centre_b, lane, rotate(conjugate(at.turn_b), vector_in_lane(place.centre_b, lane)));
  }
}

template <bool kImpacts, bool kMechanisms>
PLUMB_HD Real PrepareContacts<kImpacts, kMechanisms>::share_left(std::uint32_t body, bool is_in, const Six& push,
                                                                 Real mobility) const {
  const Real inverse_mass = bodies.velocity[body].inverse_mass;
  if (!is_in) return inverse_mass > 0 ? Real(1) : Real(0);
  const Vec turn = about_of(push);
  return mobility / (inverse_mass + dot(turn, solver_bodies.inertia[body].inverse * turn));
}

template <bool kImpacts, bool kMechanisms>
PLUMB_HD void PrepareContacts<kImpacts, kMechanisms>::add_mechanisms(const Source& source, const ContactEnds& ends,
                                                                     const ContactPlace<Lanes>& place,
                                                                     FrameDelassus<Lanes>& delassus) const {
  const Mechanisms& mechanisms = solver_bodies.mechanisms;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const std::uint32_t a = ends.a[lane], b = ends.b[lane];
    const bool a_is_in = mechanisms.hold(a), b_is_in = mechanisms.hold(b);
    if (!a_is_in && !b_is_in) continue;
    const Vec n = vector_in_lane(source.normal, lane), t1 = vector_in_lane(source.tangent, lane);
    const Vec arm_a = vector_in_lane(place.centre_a, lane), arm_b = vector_in_lane(place.centre_b, lane);
    FrameDelassus<Real> of_lane(delassus, lane);
    Six on_a[6], on_b[6];
    frame_wrenches(n, t1, arm_a, on_a);
    frame_wrenches(n, t1, arm_b, on_b);
    const Real before_a = of_lane.at[0][0];
    if (a_is_in) of_lane.add(mechanisms, a, on_a, a, on_a, 1);
    const Real before_b = of_lane.at[0][0];
    if (b_is_in) of_lane.add(mechanisms, b, on_b, b, on_b, 1);
    const FrameDelassus<Real> alone(n, t1, arm_a, arm_b, solver_bodies.inertia[a].inverse,
                                    solver_bodies.inertia[b].inverse,
                                    bodies.velocity[a].inverse_mass + bodies.velocity[b].inverse_mass);
    if (mechanisms.together(a, b)) {
      of_lane.add(mechanisms, a, on_a, b, on_b, -1);
      of_lane.add(mechanisms, b, on_b, a, on_a, -1);
      of_lane.yield_where_joints_hold(alone);
    } else {
      const Real left_a = share_left(a, a_is_in, on_a[0], before_b - before_a);
      const Real left_b = share_left(b, b_is_in, on_b[0], of_lane.at[0][0] - before_b);
      of_lane.yield_where_held(max(left_a, left_b), alone);
    }
    of_lane.mirror();
    delassus.put(lane, of_lane);
  }
}

template <bool kImpacts, bool kMechanisms>
PLUMB_HD void PrepareContacts<kImpacts, kMechanisms>::operator()(std::uint32_t slot) const {
  if (slot % kLanes != 0) return;  // the first of them works for all
  if (slot == 0) leave_empty(rows.spare);
  Source source{};
  ContactEnds ends;
  const std::uint32_t key = key_of(slot);
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const std::uint32_t row = row_of(slot + lane, key);
    leave_empty(slot + lane);
    ends.a[lane] = ends.b[lane] = sentinel;
    ends.closes_at[lane] = 0;
    if (row == kNone) continue;
    read(row, lane, source, ends);
    rows.body_a[slot + lane] = ends.a[lane];
    rows.body_b[slot + lane] = ends.b[lane];
    rows.count[slot + lane] = static_cast<std::uint32_t>(lane_of(source.count, lane));
    rows.row[slot + lane] = row;
    if constexpr (kHandsOver) put_turns(slot + lane, key % (kColours + 1), ends.a[lane], ends.b[lane]);
  }

  const Vec3<Lanes>&n = source.normal, &t1 = source.tangent;
  const Vec3<Lanes> t2 = cross(n, t1);
  const Lanes zero = Lanes(0), &count = source.count;
  ContactPlace<Lanes> place(source);
  if constexpr (kImpacts) move_to_impacts(ends, place);
  FrameDelassus<Lanes> delassus(n, t1, place.centre_a, place.centre_b, source.inertia_a, source.inertia_b,
                                source.inverse_mass);
  if constexpr (kMechanisms) add_mechanisms(source, ends, place, delassus);

  ContactNumbers<Lanes> numbers{};
  numbers.put(kNormal, n);
  numbers.at[kFriction] = source.friction;
  numbers.put(kTangent, t1);
  numbers.at[kRestitution] = source.restitution;
  numbers.put(kCentreA, place.centre_a);
  numbers.at[kPull] = source.pull;
  numbers.put(kCentreB, place.centre_b);
  PlanePoint<Lanes> places[kManifoldPoints];
  Lanes largest_slip = zero;
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    const auto there = Lanes(p) < count, of_several = there && count > Lanes(1);
    const Vec3<Lanes> arm = source.position[p] - place.centre;
    places[p] = {select(of_several, dot(arm, t1), zero), select(of_several, dot(arm, t2), zero)};
    largest_slip = select(there, max(largest_slip, delassus.largest_slip(places[p])), largest_slip);
    Lanes separation = source.separation[p];
    if constexpr (kImpacts) {
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        if (!(ends.closes_at[lane] > 0) || p >= static_cast<int>(rows.count[slot + lane])) continue;
        lane_of(separation, lane) =
            lane_of(separation, lane) -
            time_of(ends, lane)
                .closed(vector_in_lane(n, lane), vector_in_lane(t1, lane), vector_in_lane(place.centre_a, lane),
                        vector_in_lane(place.centre_b, lane), {lane_of(places[p].x, lane), lane_of(places[p].y, lane)},
                        lane_of(source.rolling_radius[0], lane), lane_of(source.rolling_radius[1], lane));
      }
    }
    const auto field = [p](std::uint32_t f) { return point_field(p, f); };
    numbers.at[field(kPlace)] = places[p].x;
    numbers.at[field(kPlace) + 1] = places[p].y;
    numbers.at[field(kSeparation)] = separation;
    numbers.at[field(kNoted)] = select(there, Lanes(kNotPushedYet / 2), zero);
    numbers.at[field(kNormalImpulse)] = source.impulse[0][p];
    numbers.at[field(kTangentImpulse)] = source.impulse[1][p];
    numbers.at[field(kTangentImpulse) + 1] = source.impulse[2][p];
  }
  numbers.at[kTangentStep] = select(largest_slip > zero, Lanes(1) / largest_slip, zero);
  const NormalBlock<Lanes> normals(numbers, count, delassus, places);
  put_frame_matrix(numbers, count, delassus, normals, places);
  numbers.at[kPointCount] = count;
  numbers.at[kRollingRadius] = source.rolling_radius[0];
  numbers.at[kRollingRadius + 1] = source.rolling_radius[1];
  numbers.store(rows.at(slot));
  const RowAccess<Lanes> row(rows, slot);
  row.clear_sums();
  row.clear_moments();
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
