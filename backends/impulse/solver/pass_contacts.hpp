// What the solvers that take the step whole do to all contacts.
#pragma once

#include "contacts/body_parts.hpp"
#include "contacts/contact_bias.hpp"
#include "contacts/contact_bounce.hpp"
#include "contacts/contact_friction.hpp"
#include "contacts/contact_normals.hpp"
#include "contacts/rolling_friction.hpp"
#include "solver/pass_change.hpp"
#include "solver/solver_step.hpp"

namespace plumb::impulse {

/// A contact in one pass of a solver that takes the step whole: normals, then friction, which so stays within the cone.
template <bool kMoments>
struct ContactPass {
  bool friction, note_impacts;
  PassChange* noted;  ///< null where nobody asks

  template <int P, class N>
  PLUMB_HD void solve(const RowAccess<N>& row, Contact<P, N>& contact, SolverBody<N>& a, SolverBody<N>& b) const {
    PerPoint<P, N> before[3];
    PLUMB_UNROLL
    for (int k = 0; k < 3; ++k) before[k] = contact.impulse[k];
    const NormalTarget<P, N> target = hard_target(contact);
    ContactMotion<N> motion = motion_of(contact, a, b);
    ContactWrench<N> wrench = no_wrench<N>();
    const auto held = solve_normals(contact, target, motion, wrench, note_impacts);
    solve_rolling_friction<kMoments>(row, contact, motion, wrench);
    if (friction) solve_friction(contact, motion, wrench, held);
    push(contact, wrench, a, b);
    store_impulses(row, contact);
    if (note_impacts) store_noted(row, contact);
    if (noted == nullptr) return;
    PLUMB_UNROLL
    for (int i = 0; i < kHeld<P>; ++i) {
      N changed = N(0), reached = N(0);
      PLUMB_UNROLL
      for (int k = 0; k < 3; ++k) {
        const N now = contact.impulse[k].at[i], change = now - before[k].at[i];
        changed = max(changed, zero_unless_finite(max(change, -change)));
        reached = max(reached, zero_unless_finite(max(now, -now)));
      }
      noted->note(largest(changed), largest(reached));
    }
  }
};

/// One contact after the other, each seeing what those before it did.
template <bool kSurfaceEffects>
struct InSequence : SolverStep {
  static constexpr bool kInSequence = true, kEffects = kSurfaceEffects;

  template <class Work>
  PLUMB_DEVICE void for_each_contact(Team& team, const Work& work, BodyUse use = BodyUse::kVelocity) const {
    for_contacts<kSurfaceEffects>(team, contacts, 0, solver, use, work);
  }
};

/// All contacts at once, on parts of bodies.
template <bool kSurfaceEffects>
struct InParts : SolverStep {
  static constexpr bool kInSequence = false, kEffects = kSurfaceEffects;

  BodyParts parts;

  /// work on every contact with parts of its own, then the parts put together.
  template <class Work>
  PLUMB_DEVICE void for_each_contact(Team& team, const Work& work, BodyUse /*use*/ = BodyUse::kVelocity) const {
    const InParts self = *this;
    const std::uint32_t n = counters->slots / kLanes;
    team.each(contact_loop(n),
              [=](std::uint32_t i) { self.work_on_parts(slot_of(self.contacts.rows, 0, n, i, kLanes), work); });
    team.each(body_count, [=](std::uint32_t i) { self.put_together(i); });
  }

 private:
  template <class Work>
  PLUMB_HD void work_on_parts(std::uint32_t slot, const Work& work) const {
    const ContactRows& rows = contacts.rows;
    LoadedContact<Lanes> loaded = load_slot<Lanes>(rows, slot);
    with_contact(rows, slot, loaded, [&](auto& contact) {
      SolverBody<Lanes> a = load_part(loaded.a), b = load_part(loaded.b);
      const Vec3<Lanes> a_linear = a.linear, a_angular = a.angular, b_linear = b.linear, b_angular = b.angular;
      work_on_surfaces<kSurfaceEffects>(contacts.surface_velocities, RowAccess<Lanes>(rows, slot), contact, a, b, work);
      if (stores_body(0)) store_change(2 * slot, a.linear - a_linear, a.angular - a_angular);
      if (stores_body(1)) store_change(2 * slot + 1, b.linear - b_linear, b.angular - b_angular);
    });
  }
  PLUMB_HD SolverBody<Lanes> load_part(const std::uint32_t* indices) const {
    SolverBody<Lanes> body = load_body<Lanes>(solver, indices, false);
    Lanes count;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) lane_of(count, lane) = parts.count(indices[lane]);
    body.inverse_mass = count * body.inverse_mass;
    body.inverse_inertia = count * body.inverse_inertia;
    return body;
  }
  PLUMB_HD void store_change(std::uint32_t end, const Vec3<Lanes>& linear, const Vec3<Lanes>& angular) const {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      PartChange& change = parts.changes[end + 2 * lane];
      change.linear = {lane_of(linear.x, lane), lane_of(linear.y, lane), lane_of(linear.z, lane)};
      change.angular = {lane_of(angular.x, lane), lane_of(angular.y, lane), lane_of(angular.z, lane)};
    }
  }
  PLUMB_HD void put_together(std::uint32_t body) const {
    const PartRange range = parts.ranges[body];
    if (range.first == range.end) return;
    Vec linear = {0, 0, 0}, angular = {0, 0, 0};
    for (std::uint32_t i = range.first; i < range.end; ++i) {
      const PartChange& change = parts.changes[parts.ends[i]];
      linear += change.linear;
      angular += change.angular;
    }
    const Real share = Real(1) / parts.count(body);
    Velocity& velocity = solver.velocity[body];
    velocity.linear += share * linear;
    velocity.angular += share * angular;
  }
};

/// Contacts in the order that Order goes through them: for_each_contact(team, work).
template <class Order>
struct PassContacts : Order {
  PassChange* changes;  ///< by pass

  PLUMB_DEVICE void start_contacts(Team& team, const StepParameters& step) const;
  PLUMB_DEVICE void solve_contacts(Team& team, PassChange* noted) const;
  PLUMB_DEVICE void bounce_contacts(Team& team, const StepParameters& step) const;
  /// Impulses of a step that had no sub-steps are the step's.
  PLUMB_DEVICE void add_up(Team& team) const;
};

template <class Order>
PLUMB_DEVICE void PassContacts<Order>::start_contacts(Team& team, const StepParameters& step) const {
  const bool moved = Order::kInSequence && this->features.restitution;  // by impacts
  const auto start = [=](const auto& row, auto& contact, auto& a, auto& b) {
    put_bias(contact, moved ? separations_now(contact, a, b) : contact.separation, step);
    store_impulses(row, contact);
    warm_start_contact<Order::kEffects>(row, contact, a, b);
  };
  this->for_each_contact(team, start, moved ? BodyUse::kVelocityWhereMoved : BodyUse::kVelocity);
}

template <class Order>
PLUMB_DEVICE void PassContacts<Order>::solve_contacts(Team& team, PassChange* noted) const {
  const ContactPass<Order::kEffects> pass = {this->features.friction, !Order::kInSequence && this->features.restitution,
                                             noted};
  this->for_each_contact(team,
                         [pass](const auto& row, auto& contact, auto& a, auto& b) { pass.solve(row, contact, a, b); });
}

template <class Order>
PLUMB_DEVICE void PassContacts<Order>::bounce_contacts(Team& team, const StepParameters& step) const {
  const BounceContact bounce = {step.restitution_speed, this->features.friction};
  for (std::uint32_t k = 0; k < step.passes; ++k) this->for_each_contact(team, bounce);
}

template <class Order>
PLUMB_DEVICE void PassContacts<Order>::add_up(Team& team) const {
  for_rows(team, this->contacts, [](const auto& row, const auto& contact) { add_up_impulses(row, contact.impulse); });
}

PLUMB_COMPILED_ONCE(struct PassContacts<InSequence<true>>);
PLUMB_COMPILED_ONCE(struct PassContacts<InParts<true>>);

}  // namespace plumb::impulse
