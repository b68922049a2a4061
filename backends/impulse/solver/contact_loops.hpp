// Loops over all contacts by colour: what every solver is made of.
#pragma once

#include <type_traits>

#include "constraints/contact.hpp"
#include "exec/executor.hpp"
#include "solver/solver_bodies.hpp"
#include "step_counters.hpp"

namespace plumb::impulse {

/// The contacts of a step, ready to be solved. A contact's numbers are read before the loop before has ended: within a
/// step nothing but work on that contact, by the same thread, may write them.
struct ContactSet {
  ContactRows rows;
  const StepCounters* counters;
};

/// What a pass reads and writes of a body.
enum class BodyUse { kVelocity, kVelocityWhereMoved, kAll };

/// A contact, or kLanes of them from neighbouring slots, with what leads to its bodies.
template <class N>
struct LoadedContact {
  static constexpr std::uint32_t kHere = sizeof(N) / sizeof(Real);
  std::uint32_t a[kHere], b[kHere];
  std::uint32_t points;  ///< the largest number among the lanes
  Contact<N> contact;
};

template <class N>
PLUMB_HD LoadedContact<N> load_slot(const ContactRows& rows, std::uint32_t slot) {
  LoadedContact<N> loaded;
  loaded.points = 0;
  for (std::uint32_t lane = 0; lane < LoadedContact<N>::kHere; ++lane) {
    loaded.a[lane] = rows.body_a[slot + lane];
    loaded.b[lane] = rows.body_b[slot + lane];
    loaded.points = max(loaded.points, rows.count[slot + lane]);
  }
  loaded.contact = load_contact(RowAccess<N>(rows, slot), static_cast<int>(loaded.points));
  return loaded;
}

/// The number of points that all who go the same way have to go through: on a GPU the threads of a warp, which would
/// else take the ways for one, two and four points one after the other.
PLUMB_HD inline std::uint32_t points_together(std::uint32_t points) {
#if defined(__CUDA_ARCH__)
  const unsigned together = __activemask();
  return __any_sync(together, points > 2) ? kManifoldPoints : __any_sync(together, points > 1) ? 2 : 1;
#else
  return points;
#endif
}

/// Calls f with the number of points as a constant, so that what it does goes straight: 1, 2 or all that there may be.
template <class F>
PLUMB_HD void with_point_count(std::uint32_t own, const F& f) {
  if (own == 0) return;
  const std::uint32_t points = points_together(own);
  if (points == 1) return f(std::integral_constant<int, 1>{});
  if (points == 2) return f(std::integral_constant<int, 2>{});
  f(std::integral_constant<int, kManifoldPoints>{});
}

/// Runs work(points, row, contact, a, b) on a contact and keeps what it did to the bodies.
template <class N, class Work>
PLUMB_HD void work_on(const ContactRows& rows, const SolverBodies& bodies, std::uint32_t slot, LoadedContact<N>& loaded,
                      BodyUse use, const Work& work) {
  with_point_count(loaded.points, [&](auto points) {
    const bool moved = use != BodyUse::kVelocity;
    SolverBody<N> a = load_body<N>(bodies, loaded.a, moved), b = load_body<N>(bodies, loaded.b, moved);
    work(points, RowAccess<N>(rows, slot), loaded.contact, a, b);
    store_body<N>(bodies, loaded.a, a);
    store_body<N>(bodies, loaded.b, b);
    if (use != BodyUse::kAll) return;
    store_displacement<N>(bodies, loaded.a, a);
    store_displacement<N>(bodies, loaded.b, b);
  });
}

/// Runs work on the contacts of slots first .. first + n * lanes, which share no body that they push.
template <class N, class Work>
PLUMB_DEVICE void for_slots(Team& team, const ContactSet& contacts, const SolverBodies& bodies, std::uint32_t first,
                            std::uint32_t n, BodyUse use, const Work& work) {
  constexpr std::uint32_t kHere = LoadedContact<N>::kHere;
  team.each_ahead(
      n, [&](std::uint32_t i) { return load_slot<N>(contacts.rows, first + i * kHere); },
      [&](std::uint32_t i, LoadedContact<N>& loaded) {
        work_on<N>(contacts.rows, bodies, first + i * kHere, loaded, use, work);
      });
}

/// Runs work on every contact, colour after colour, and on those without a colour one after the other.
template <class Work>
PLUMB_DEVICE void for_contacts(Team& team, const ContactSet& contacts, const SolverBodies& bodies, BodyUse use,
                               const Work& work) {
  const StepCounters& counters = *contacts.counters;
  const std::uint32_t colours = counters.colour_count;
  const std::uint32_t lone = counters.first_slot[kOverflow];
  const std::uint32_t loops = colours + (counters.first_slot[kOverflow + 1] - lone);
  for (std::uint32_t k = 0; k < loops; ++k) {
    const std::uint32_t first = k < colours ? counters.first_slot[k] : lone + (k - colours);
    const std::uint32_t slots = k < colours ? counters.first_slot[k + 1] - first : 1;
    if constexpr (kLanes == 1) {
      for_slots<Real>(team, contacts, bodies, first, slots, use, work);
    } else {
      if (k < colours)
        for_slots<Lanes>(team, contacts, bodies, first, slots / kLanes, use, work);
      else
        for_slots<Real>(team, contacts, bodies, first, 1, use, work);
    }
  }
}

/// Runs work(points, row, contact) on every contact, in any order.
template <class Work>
PLUMB_DEVICE void for_rows(Team& team, const ContactSet& contacts, const Work& work) {
  const ContactRows& rows = contacts.rows;
  team.each(contacts.counters->first_slot[kColours + 1] / kLanes, [=](std::uint32_t i) {
    const LoadedContact<Lanes> loaded = load_slot<Lanes>(rows, i * kLanes);
    with_point_count(loaded.points,
                     [&](auto points) { work(points, RowAccess<Lanes>(rows, i * kLanes), loaded.contact); });
  });
}

}  // namespace plumb::impulse
