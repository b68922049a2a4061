// Sleeping: islands that have come to rest are taken out of the steps, and come back when something touches them.
//
// A body that sleeps is, for every kernel, one that nothing moves: it lies in the tree of the statics, makes no pairs
// with others that do not move, and no contact or joint of it is solved. What it was, and its contacts with their
// impulses, are kept here.
//
//            all of its island slow for sleep_time; looked for after every eighth step
//   awake  ------------------------------------------------------------------------------->  asleep
//     ^    flags lose "dynamic" and "moves", velocity 0, inverse mass 0; contacts -> stored
//     |
//     |    the host writes to one of it, joins it, moves or takes what it touches, changes gravity
//     '-----------------------------------------------------------------------------------------'
//          a manifold with somebody awake: the step is undone, the island wakes, the step comes again
//          stored -> woken: matched in the next step as if they were of the last one
//
// Somebody awake who comes near a sleeper (so near that there is a manifold) must find it awake: the step then does
// nothing, the host wakes the island, and the step comes again. So no contact is ever solved against a sleeper as if it
// were a wall, and a blow goes through a pile as if it had never slept. The step that is repeated may find the next
// island, and is repeated again. The report says so (PLUMB_REMARK_STEP_REPEATED).
//
// Who is slow. A body's time of rest grows while its kinetic energy per mass is below that of sleep_speed, turning
// counted, and nobody pushes it by a force; it starts anew otherwise. An island falls asleep as a whole or not at all:
// one of it that is fast, must not sleep, or touches or is joined to what the host moves or a surface that runs, keeps
// all awake. Islands are what contacts and joints connect over bodies that can be pushed (islands.hpp): ground joins
// nobody. They are found anew each time, where kernels run, for between two looks nobody needs them; their name is
// their smallest body, so that threads do not matter.
//
// But for its velocity a sleeper loses nothing: with its impulses, colours and features a tower wakes where it fell
// asleep, and need not settle anew. Only worlds that declare the need of sleeping have any of this.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "bodies/body_state.hpp"
#include "bodies/step_counters.hpp"
#include "bodies/step_parameters.hpp"
#include "contacts/contact_record.hpp"
#include "exec/archive.hpp"
#include "exec/table.hpp"
#include "islands/islands.hpp"

namespace plumb::impulse {

/// A contact between bodies that do not move, one of which sleeps; or of one that was woken and has not stepped yet.
struct StoredContact {
  std::uint32_t body_a, body_b;
  KeptPair kept;
  ContactRecord record;
  std::uint32_t step;  ///< after which it was put aside
};

class Sleep {
 public:
  /// In steps: islands are looked for no more often.
  static constexpr std::uint32_t kPeriod = 8;

  void reserve(std::uint32_t bodies);

  [[nodiscard]] std::uint32_t count() const { return count_; }  ///< of sleepers
  [[nodiscard]] bool sleeps(std::uint32_t body) const { return body < was_.size() && was_[body].island != 0; }
  /// 1 + the smallest body of those with whom it fell asleep; 0 where it is awake.
  [[nodiscard]] std::uint32_t island(std::uint32_t body) const { return body < was_.size() ? was_[body].island : 0; }

  // --- in a step ---
  /// Marks the islands of sleepers that have a manifold with somebody who is awake and can push, or moves.
  void find_touched(Executor& executor, const ContactCache& cache, std::uint32_t capacity, const Bodies& bodies,
                    const Proxies& proxies, StepCounters* counters);
  /// For how long each body has been slow, where the step was done.
  void time_rest(Executor& executor, const Bodies& bodies, std::uint32_t body_count, const StepParameters* parameters,
                 const StepCounters* counters, std::uint32_t pair_capacity);

  // --- between steps ---
  [[nodiscard]] Islands& islands() { return islands_; }
  [[nodiscard]] const Real* rest() { return rest_.data(); }
  /// Bodies of the islands that find_touched() marked.
  [[nodiscard]] std::vector<std::uint32_t> touched();

  /// These fall asleep as one island. Contacts are put aside by whoever calls this.
  void fall_asleep(std::span<const std::uint32_t> island, Table<BodyMass>& mass, BodyState& state);
  /// All bodies of the islands of these, which move again; those that do not sleep are passed over.
  std::vector<std::uint32_t> wake(std::span<const std::uint32_t> bodies, Table<BodyMass>& mass, BodyState& state);

  void store(const StoredContact& contact) { stored_.push_back(contact); }
  /// Those that sleep and touch one of these bodies.
  [[nodiscard]] std::vector<std::uint32_t> neighbours(std::span<const std::uint32_t> bodies) const;
  /// No contact with these is kept any more.
  void forget(std::span<const std::uint32_t> bodies);
  /// What contacts() tells of beyond the last step's own.
  template <class F>
  void for_records(std::uint32_t step, const F& f) const {
    for (const auto* contacts : {&stored_, &woken_})
      for (const StoredContact& contact : *contacts)
        if (contact.step < step) f(contact.record);
  }

  /// Enqueues what the next step reads, with the contacts of those who woke since the last one.
  void upload(Executor& executor);
  [[nodiscard]] std::uint32_t woken_count() const { return static_cast<std::uint32_t>(woken_.size()); }
  [[nodiscard]] const KeptPair* woken_pairs() { return woken_pairs_.device(); }
  /// Who sleeps and what is kept of them, to or from a snapshot.
  void exchange(Archive& archive, std::uint32_t bodies, Table<BodyMass>& mass);
  /// A step was done: they have their place in it.
  void stepped() { woken_.clear(); }

 private:
  struct Was {
    std::uint32_t island;  ///< 1 + the smallest body of it; 0: awake
    std::uint32_t flags;
    Real inverse_mass;
  };
  [[nodiscard]] std::vector<bool> marks_of(std::span<const std::uint32_t> bodies) const;

  std::uint32_t count_ = 0;
  std::vector<Was> was_;                                         // by body
  std::map<std::uint32_t, std::vector<std::uint32_t>> made_of_;  // by island
  std::vector<StoredContact> stored_, woken_;
  bool islands_changed_ = true;

  Islands islands_;
  Mirror<std::uint32_t> island_of_;  // by body
  Buffer<std::uint32_t> touched_;    // by island: 1 where somebody came
  Buffer<Real> rest_;                // by body, s
  Mirror<KeptPair> woken_pairs_;     // by pair
};

}  // namespace plumb::impulse
