// The solver "jacobi": all contacts at once, on split bodies.
#pragma once

#include "solver/body_parts.hpp"
#include "solver/pass_step.hpp"

namespace plumb::impulse {

/// Impulses as in "si", but a pass solves all contacts at once, none seeing what the others do (Jacobi). That diverges
/// where a body has several contacts, unless it is split into as many parts of equal mass: each contact works on parts
/// of its own, and after the pass a body's parts are put together again, at their mean velocity. Momentum is kept, and
/// the energy of the impulses' error falls in every pass (R. Tonge, F. Benevolenski, A. Voroshilov, "Mass Splitting for
/// Jitter-Free Parallel Rigid Body Simulation", ACM Trans. Graph. 31(4), 2012). The sum over a body's parts goes in the
/// order of its contacts. Joints are solved by colours, between the passes.
template <JointCode kJoints, bool kBelts>
struct StepInParts : StepInPasses<StepInParts<kJoints, kBelts>, kJoints> {
  BodyParts parts;

  /// work on every contact with parts of its own, then the parts put together.
  template <class Work>
  PLUMB_DEVICE void for_each_contact(Team& team, const Work& work) const {
    const StepInParts self = *this;
    const std::uint32_t n = this->counters->first_slot[kColours + 1] / kLanes;
    team.each(contact_loop(n),
              [=](std::uint32_t i) { self.work_on_parts(slot_of(self.contacts.rows, 0, n, i, kLanes), work); });
    team.each(this->body_count, [=](std::uint32_t i) { self.put_together(i); });
  }
  PLUMB_DEVICE void bounce_contacts(Team& team, const StepParameters& step) const {
    const bool friction = this->features.friction;
    const Real slowest = step.restitution_speed;
    for (std::uint32_t k = 0; k < step.passes; ++k)
      for_each_contact(team, [=](const auto& row, auto& contact, auto& a, auto& b) {
        bounce_contact(row, contact, a, b, slowest, friction);
        store_impulses(row, contact);
      });
  }

 private:
  template <class Work>
  PLUMB_HD void work_on_parts(std::uint32_t slot, const Work& work) const {
    const ContactRows& rows = this->contacts.rows;
    LoadedContact<Lanes> loaded = load_slot<Lanes>(rows, slot);
    with_contact(rows, slot, loaded, [&](auto& contact) {
      SolverBody<Lanes> a = load_part(loaded.a), b = load_part(loaded.b);
      const Vec3<Lanes> a_linear = a.linear, a_angular = a.angular, b_linear = b.linear, b_angular = b.angular;
      work_on_surfaces<kBelts>(RowAccess<Lanes>(rows, slot), contact, a, b, work);
      if (stores_body(0)) store_change(2 * slot, a.linear - a_linear, a.angular - a_angular);
      if (stores_body(1)) store_change(2 * slot + 1, b.linear - b_linear, b.angular - b_angular);
    });
  }
  PLUMB_HD SolverBody<Lanes> load_part(const std::uint32_t* indices) const {
    SolverBody<Lanes> body = load_body<Lanes>(this->solver, indices, false);
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
    Velocity& velocity = this->solver.velocity[body];
    velocity.linear += share * linear;
    velocity.angular += share * angular;
  }
};

}  // namespace plumb::impulse
