// Loops over all contacts by colour: what every solver is made of.
#pragma once

#include <type_traits>

#include "bodies/step_counters.hpp"
#include "contacts/blows.hpp"
#include "contacts/body_lanes.hpp"
#include "contacts/contact.hpp"
#include "contacts/hand_over.hpp"
#include "exec/executor.hpp"

namespace plumb::impulse {

/// The contacts of a step, ready to be solved. A contact's numbers are read before the loop before has ended: within a
/// step nothing but work on that contact, by the same threads, may write them.
struct ContactSet {
  ContactRows rows;
  const StepCounters* counters;
  bool surface_velocities;  ///< surfaces may run on bodies that stand
  const StepParameters* parameters;
  const SubstepLevels* levels;
};

/// What a pass reads and writes of a body. Of impacts all, and what they give it is not what holds it: it does not act
/// again in the next sub-step. Last: nothing follows in the sub-step.
enum class BodyUse { kVelocity, kVelocityWhereMoved, kLastVelocity, kLastVelocityWhereMoved, kAll, kImpact };
PLUMB_HD constexpr bool reads_places(BodyUse use) { return use != BodyUse::kVelocity && use != BodyUse::kLastVelocity; }
PLUMB_HD constexpr bool is_last(BodyUse use) {
  return use == BodyUse::kLastVelocity || use == BodyUse::kLastVelocityWhereMoved;
}
/// Whether positions change, too.
PLUMB_HD constexpr bool moves_bodies(BodyUse use) { return use == BodyUse::kAll || use == BodyUse::kImpact; }

/// A contact, or kLanes of them from neighbouring slots, with what leads to its bodies.
template <class N>
struct LoadedContact {
  static constexpr std::uint32_t kHere = kLanesIn<N>;
  std::uint32_t a[kHere], b[kHere];
  std::uint32_t points;  ///< the largest number among the lanes
#if defined(PLUMB_IMPULSE_CUDA)
  ContactTurns turns;
  Contact<kManifoldPoints, N> contact;
#endif
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
#if defined(PLUMB_IMPULSE_CUDA)
  if constexpr (kHandsOver) loaded.turns = rows.turns[slot];
  loaded.contact = load_contact<kManifoldPoints>(RowAccess<N>(rows, slot));
#endif
  return loaded;
}

/// Has what load_slot will read brought nearer, as a GPU needs for whose threads have contacts left when they have done
/// their first: each thread of a warp asks for a line that its contacts share.
PLUMB_HD inline void fetch_slot([[maybe_unused]] const ContactRows& rows, [[maybe_unused]] std::uint32_t slot) {
#if defined(__CUDA_ARCH__)
  constexpr std::uint32_t kLines = kAllFields / 4;
  const std::uint32_t line = threadIdx.x % kWarp, first = slot - slot % kLaneGroup;
  const void* at = line < kLines ? rows.at(first) + line * place_of(4) : nullptr;
  if (line == kLines) at = rows.body_a + first;
  if (line == kLines + 1) at = rows.body_b + first;
  if (line == kLines + 2 && kHandsOver) at = rows.turns + first;
  if (at != nullptr) asm volatile("prefetch.global.L1 [%0];" ::"l"(at));
#endif
}

/// Calls f with the contact. A CPU reads it now, and no more points than there are: 1, 2 or all that there may be. A
/// GPU has read it whole already, because it would have had to wait for the number.
template <class N, class F>
PLUMB_HD void with_contact([[maybe_unused]] const ContactRows& rows, [[maybe_unused]] std::uint32_t slot,
                           LoadedContact<N>& loaded, const F& f) {
#if defined(PLUMB_IMPULSE_CUDA)
  f(loaded.contact);  // even where there are no points, for the warp stays together
#else
  if (loaded.points == 0) return;
  const RowAccess<N> row(rows, slot);
  const auto call = [&](auto points) {
    Contact<points(), N> contact = load_contact<points()>(row);
    f(contact);
  };
  if (loaded.points == 1) return call(std::integral_constant<int, 1>{});
  if (loaded.points == 2) return call(std::integral_constant<int, 2>{});
  call(std::integral_constant<int, kManifoldPoints>{});
#endif
}

/// The slot that the i-th thread of a loop over the slots first .. first + n * lanes works on (contact_loop).
PLUMB_HD inline std::uint32_t slot_of(const ContactRows& rows, std::uint32_t first, std::uint32_t n, std::uint32_t i,
                                      std::uint32_t lanes) {
  const std::uint32_t k = i / kContactThreads;
  return k < n ? first + k * lanes : rows.spare;
}
/// Whether this thread stores body a (0) or b (1) of its contact.
PLUMB_HD inline bool stores_body(int which) { return holds_point(which); }

/// Runs work(row, contact, a, b) with the velocities of the surfaces. kSurfaceEffects says whether these may differ
/// from the bodies' own. A GPU's kernels are for worlds with surface velocities or without; a CPU asks each time, and
/// so is compiled once.
template <bool kSurfaceEffects, class N, class C, class Work>
PLUMB_HD void work_on_surfaces([[maybe_unused]] bool surface_velocities, const RowAccess<N>& row, C& contact,
                               SolverBody<N>& a, SolverBody<N>& b, const Work& work) {
  if constexpr (kSurfaceEffects) {
    const bool runs = Executor::kWarps || surface_velocities;
    const Vec3<N> own = b.linear;
    Vec3<N> before = own;
    if (runs) {
      N quad[4];
      row.get_quad(kSurfaceSpeed, quad);
      const Vec3<N> slip = quad[0] * contact.tangent + quad[1] * contact.bitangent();
      before = b.linear = own + slip;
    }
    work(row, contact, a, b);
    if (runs) b.linear = own + (b.linear - before);
  } else {
    work(row, contact, a, b);
  }
}

/// The bodies of a contact, or of kLanes of them.
template <class N>
struct ContactBodies {
  SolverBody<N> a, b;
};
/// They come in. by_turns: when the contact has its turn on both of them.
template <class N>
PLUMB_HD ContactBodies<N> load_bodies(const SolverBodies& bodies, const LoadedContact<N>& loaded, bool moved,
                                      [[maybe_unused]] bool by_turns) {
#if defined(__CUDA_ARCH__)
  if (by_turns) {
    ContactBodies<N> both;
    load_place(bodies, *loaded.a, moved, both.a);
    load_place(bodies, *loaded.b, moved, both.b);
    both.a.inverse_mass = loaded.turns.inverse_mass[0];
    both.b.inverse_mass = loaded.turns.inverse_mass[1];
    HandOver(bodies.velocity, *loaded.a, *loaded.b, loaded.turns).take(both.a, both.b);
    return both;
  }
#endif
  return {load_body<N>(bodies, loaded.a, moved), load_body<N>(bodies, loaded.b, moved)};
}
/// They go back.
template <class N>
PLUMB_HD void store_bodies(const SolverBodies& bodies, const LoadedContact<N>& loaded, [[maybe_unused]] bool by_turns,
                           const SolverBody<N>& a, const SolverBody<N>& b) {
#if defined(__CUDA_ARCH__)
  if (by_turns) return HandOver(bodies.velocity, *loaded.a, *loaded.b, loaded.turns).leave(a, b);
#endif
  if (stores_body(0)) store_body<N>(bodies, loaded.a, a);
  if (stores_body(1)) store_body<N>(bodies, loaded.b, b);
}

/// Runs work(row, contact, a, b) on a contact and keeps what it did to the bodies.
template <bool kSurfaceEffects, bool kMechanisms, class N, class Work>
PLUMB_HD void work_on(const ContactSet& contacts, const SolverBodies& bodies, std::uint32_t slot,
                      LoadedContact<N>& loaded, BodyUse use, bool by_turns, const Work& work) {
  const ContactRows& rows = contacts.rows;
  with_contact(rows, slot, loaded, [&](auto& contact) {
    ContactBodies<N> both = load_bodies(bodies, loaded, reads_places(use), by_turns);
    SolverBody<N>&a = both.a, &b = both.b;
    const bool whole = kMechanisms && bodies.mechanisms.count != 0;
    if (whole) {
      stand_for_mechanisms<N>(bodies, loaded.a, a);
      stand_for_mechanisms<N>(bodies, loaded.b, b);
    }
    if (whole || use == BodyUse::kImpact) {
      const SolverBody<N> a_before = a, b_before = b;
      if (use == BodyUse::kImpact) put_impact_speed(bodies, loaded.a, loaded.b, a, b, contact);
      work_on_surfaces<kSurfaceEffects>(contacts.surface_velocities, RowAccess<N>(rows, slot), contact, a, b, work);
      const bool impact = use == BodyUse::kImpact;
      if (whole) push_mechanisms<N>(bodies, loaded.a, a, a_before, impact);
      if (whole) push_mechanisms<N>(bodies, loaded.b, b, b_before, impact);
      if (whole && is_last(use))
        let_go_of_blow(bodies, loaded.a, loaded.b, RowAccess<N>(rows, slot), contact, *contacts.parameters,
                       *contacts.levels);
      if (use == BodyUse::kImpact) {
        if (stores_body(0)) store_free_velocity<N>(bodies, loaded.a, a, a_before);
        if (stores_body(1)) store_free_velocity<N>(bodies, loaded.b, b, b_before);
      }
    } else {
      work_on_surfaces<kSurfaceEffects>(contacts.surface_velocities, RowAccess<N>(rows, slot), contact, a, b, work);
    }
    store_bodies(bodies, loaded, by_turns, a, b);
    if (!moves_bodies(use)) return;
    if (stores_body(0)) store_displacement<N>(bodies, loaded.a, a);
    if (stores_body(1)) store_displacement<N>(bodies, loaded.b, b);
  });
}

/// Runs work on the contacts of slots first .. first + n * lanes, which share no body that they push or take turns.
template <bool kSurfaceEffects, bool kMechanisms, class N, class Work>
PLUMB_DEVICE void for_slots(Team& team, const ContactSet& contacts, const SolverBodies& bodies, std::uint32_t first,
                            std::uint32_t n, BodyUse use, bool by_turns, const Work& work) {
  const auto slot = [=, &contacts](std::uint32_t i) {
    return slot_of(contacts.rows, first, n, i, LoadedContact<N>::kHere);
  };
  team.each_ahead(
      contact_loop(n), [&](std::uint32_t i) { return load_slot<N>(contacts.rows, slot(i)); },
      [&](std::uint32_t i) { fetch_slot(contacts.rows, slot(i)); },
      [&](std::uint32_t i, LoadedContact<N>& loaded) {
        work_on<kSurfaceEffects, kMechanisms, N>(contacts, bodies, slot(i), loaded, use, by_turns, work);
      });
}

/// Whether a colour has one contact, the others of its lanes being empty. A CPU is done with it sooner by itself; with
/// two it is not.
PLUMB_HD inline bool has_one_contact(const ContactRows& rows, std::uint32_t first, std::uint32_t slots) {
  return slots == kLaneGroup && rows.count[first + 1] == 0;
}

/// Runs work on every contact of a level, colour after colour, and on those without a colour one after the other.
/// kMechanisms: what it pushes may be in mechanisms that move as a whole.
template <bool kSurfaceEffects = false, bool kMechanisms = false, class Work>
PLUMB_DEVICE void for_contacts(Team& team, const ContactSet& contacts, std::uint32_t level, const SolverBodies& bodies,
                               BodyUse use, const Work& work) {
  const StepCounters& counters = *contacts.counters;
  const std::uint32_t* const first_slot = counters.first_slot + colour_key(level, 0);
  const std::uint32_t colours = counters.colour_count[level];
  const std::uint32_t lone = first_slot[kOverflow];
  const std::uint32_t loops = colours + (first_slot[kOverflow + 1] - lone);
  // Passes that keep their barriers among others that are one loop: other threads have a contact's numbers there.
  const bool one_loop = is_one_loop(counters, level, bodies.mechanisms), by_turns = one_loop && !moves_bodies(use);
  if (one_loop && !by_turns) team.barrier();
  for (std::uint32_t k = by_turns && colours != 0 ? colours - 1 : 0; k < loops; ++k) {
    const bool lonely = k >= colours;
    const std::uint32_t first = lonely ? lone + (k - colours) : first_slot[by_turns ? 0 : k];
    const std::uint32_t slots = lonely ? 1 : first_slot[k + 1] - first;
    if constexpr (kLanes == 1) {
      for_slots<kSurfaceEffects, kMechanisms, Real>(team, contacts, bodies, first, slots, use, by_turns && !lonely,
                                                    work);
    } else {
      if (lonely || has_one_contact(contacts.rows, first, slots))
        for_slots<kSurfaceEffects, kMechanisms, Real>(team, contacts, bodies, first, 1, use, false, work);
      else
        for_slots<kSurfaceEffects, kMechanisms, Lanes>(team, contacts, bodies, first, slots / kLanes, use, false, work);
    }
  }
  if (one_loop && !by_turns) team.barrier();
}

/// Runs work(row, contact) on every contact, in any order.
template <class Work>
PLUMB_DEVICE void for_rows(Team& team, const ContactSet& contacts, const Work& work) {
  const ContactRows& rows = contacts.rows;
  const std::uint32_t n = contacts.counters->slots / kLanes;
  team.each(contact_loop(n), [=](std::uint32_t i) {
    const std::uint32_t slot = slot_of(rows, 0, n, i, kLanes);
    LoadedContact<Lanes> loaded = load_slot<Lanes>(rows, slot);
    with_contact(rows, slot, loaded, [&](auto& contact) { work(RowAccess<Lanes>(rows, slot), contact); });
  });
}

}  // namespace plumb::impulse
