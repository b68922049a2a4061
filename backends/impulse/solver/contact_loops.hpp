// Loops over all contacts by colour: what every solver is made of.
#pragma once

#include "constraints/contact.hpp"
#include "exec/executor.hpp"
#include "solver/solver_bodies.hpp"
#include "step_counters.hpp"

namespace plumb::impulse {

/// The contacts of a step, ready to be solved.
struct ContactSet {
  ContactRows rows;
  const StepCounters* counters;
};

/// What a pass reads and writes of a body.
enum class BodyUse { kVelocity, kVelocityWhereMoved, kAll };

/// Runs work(row, points, a, b) on kLanes neighbouring slots from `slot` on, and keeps what it did to the bodies.
template <class N, class Work>
PLUMB_HD void work_on_lanes(const ContactSet& contacts, const SolverBodies& bodies, std::uint32_t slot, BodyUse use,
                            const Work& work) {
  const bool moved = use != BodyUse::kVelocity;
  constexpr std::uint32_t kHere = sizeof(N) / sizeof(Real);
  const ContactRows& rows = contacts.rows;
  std::uint32_t points = 0;
  for (std::uint32_t lane = 0; lane < kHere; ++lane) points = max(points, rows.count[slot + lane]);
  if (points == 0) return;
  SolverBody<N> a = load_body<N>(bodies, rows.body_a + slot, moved),
                b = load_body<N>(bodies, rows.body_b + slot, moved);
  work(RowAccess<N>{rows.at(slot)}, static_cast<int>(points), a, b);
  store_body<N>(bodies, rows.body_a + slot, a);
  store_body<N>(bodies, rows.body_b + slot, b);
  if (use != BodyUse::kAll) return;
  store_displacement<N>(bodies, rows.body_a + slot, a);
  store_displacement<N>(bodies, rows.body_b + slot, b);
}

/// Runs work on every contact, colour after colour, and on those without a colour one after the other.
template <class Work>
PLUMB_DEVICE void for_contacts(Team& team, const ContactSet& contacts, const SolverBodies& bodies, BodyUse use,
                               const Work& work) {
  const StepCounters& counters = *contacts.counters;
  for (std::uint32_t colour = 0; colour < counters.colour_count; ++colour) {
    const std::uint32_t first = counters.first_slot[colour];
    team.each((counters.first_slot[colour + 1] - first) / kLanes,
              [&](std::uint32_t i) { work_on_lanes<Lanes>(contacts, bodies, first + i * kLanes, use, work); });
  }
  const std::uint32_t first = counters.first_slot[kOverflow], end = counters.first_slot[kOverflow + 1];
  if (first == end) return;
  team.single([&] {
    for (std::uint32_t slot = first; slot < end; ++slot) work_on_lanes<Real>(contacts, bodies, slot, use, work);
  });
}

/// Runs work(row, points) on every contact, in any order.
template <class Work>
PLUMB_DEVICE void for_rows(Team& team, const ContactSet& contacts, const Work& work) {
  const ContactRows& rows = contacts.rows;
  team.each(contacts.counters->first_slot[kColours + 1] / kLanes, [=](std::uint32_t i) {
    std::uint32_t points = 0;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) points = max(points, rows.count[i * kLanes + lane]);
    work(RowAccess<Lanes>{rows.at(i * kLanes)}, static_cast<int>(points));
  });
}

}  // namespace plumb::impulse
