#include "contacts/colouring.hpp"

#include "contacts/hand_over.hpp"
#include "exec/atomic.hpp"
#include "math/bits.hpp"
#include "math/wide.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

/// A reordering of the 32-bit numbers that looks random: the finaliser of MurmurHash3 (Appleby).
PLUMB_HD constexpr std::uint32_t scramble(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x85ebca6bU;
  x ^= x >> 13;
  x *= 0xc2b2ae35U;
  return x ^ (x >> 16);
}

/// kOverflow where all are taken.
PLUMB_HD inline std::uint32_t lowest_free_colour(std::uint64_t taken) {
  static_assert(kColours < 64);
  return min(kOverflow, static_cast<std::uint32_t>(trailing_zeros(~taken)));
}

/// The two bodies of a manifold, or the owners of their mechanisms, and whether it pushes them.
struct Ends {
  std::uint32_t a, b;
  bool pushes_a, pushes_b;
};

struct View {
  ContactCache cache;
  const Velocity* velocities;
  const Proxy* proxies;
  Mechanisms mechanisms;
  BodyLevels levels;
  StepCounters* counters;
  std::uint64_t* masks;
  std::uint64_t* claims;
  std::uint32_t* waiting[2];

  PLUMB_HD Ends ends(std::uint32_t row) const {
    const Pair pair = cache.pairs[cache.candidate[row]];
    const std::uint32_t a = proxies[pair.a].body, b = proxies[pair.b].body;
    return {mechanisms.owner(a), mechanisms.owner(b), velocities[a].inverse_mass > 0, velocities[b].inverse_mass > 0};
  }
};

/// Earlier rounds have larger priorities, so that claims need no clearing: the smallest wins.
PLUMB_HD constexpr std::uint64_t priority(std::uint32_t round, std::uint32_t row) {
  return (std::uint64_t{0x7fffffffU - round} << 32) | scramble(row);
}

struct ClearBody {
  std::uint64_t *masks, *claims;
  PLUMB_HD void operator()(std::uint32_t i) const {
    masks[i] = 0;
    claims[i] = ~std::uint64_t{0};
  }
};

struct ColourNew {
  View view;

  PLUMB_HD void queue_if_new(std::uint32_t row) const {
    if (view.cache.kept[row].colour == kNone) view.waiting[0][atomic_add(&view.counters->uncoloured[0], 1U)] = row;
  }
  [[nodiscard]] PLUMB_HD std::uint64_t taken(const Ends& ends) const {
    return (ends.pushes_a ? view.masks[ends.a] : 0) | (ends.pushes_b ? view.masks[ends.b] : 0);
  }
  /// Who can have no colour does not wait for its turn: on a body that thousands touch all others would wait for it.
  PLUMB_HD void claim(std::uint32_t round, std::uint32_t row) const {
    const Ends ends = view.ends(row);
    if (lowest_free_colour(taken(ends)) == kOverflow) {
      view.cache.kept[row].colour = kOverflow;
      return;
    }
    if (ends.pushes_a) atomic_min(&view.claims[ends.a], priority(round, row));
    if (ends.pushes_b) atomic_min(&view.claims[ends.b], priority(round, row));
  }
  PLUMB_HD void colour_or_wait(std::uint32_t round, std::uint32_t row) const {
    if (view.cache.kept[row].colour == kOverflow) return;
    const Ends ends = view.ends(row);
    const std::uint64_t mine = priority(round, row);
    if ((ends.pushes_a && view.claims[ends.a] != mine) || (ends.pushes_b && view.claims[ends.b] != mine)) {
      view.waiting[(round + 1) % 2][atomic_add(&view.counters->uncoloured[(round + 1) % 3], 1U)] = row;
      return;
    }
    const std::uint32_t colour = lowest_free_colour(taken(ends));
    PLUMB_ASSERT(colour < kOverflow);
    view.cache.kept[row].colour = colour;
    if (ends.pushes_a) view.masks[ends.a] |= std::uint64_t{1} << colour;
    if (ends.pushes_b) view.masks[ends.b] |= std::uint64_t{1} << colour;
  }

  PLUMB_DEVICE void operator()(Team& team) const {
    const ColourNew self = *this;
    StepCounters* counters = view.counters;
    team.each(counters->manifolds, [self](std::uint32_t row) { self.queue_if_new(row); });
    std::uint32_t round = 0;
    for (;; ++round) {
      team.barrier();
      const std::uint32_t waiting = counters->uncoloured[round % 3];
      if (waiting == 0) break;
      const std::uint32_t* queue = view.waiting[round % 2];
      team.each(waiting, [self, round, queue](std::uint32_t i) {
        if (i == 0) self.view.counters->uncoloured[(round + 2) % 3] = 0;
        self.claim(round, queue[i]);
      });
      team.each(waiting, [self, round, queue](std::uint32_t i) { self.colour_or_wait(round, queue[i]); });
    }
    team.single([counters, round] { counters->rounds = round; });
  }
};

struct ListColourKeys {
  View view;
  std::uint32_t *keys, *rows;
  PLUMB_HD void operator()(std::uint32_t row) const {
    const Pair pair = view.cache.pairs[view.cache.candidate[row]];
    const std::uint32_t level =
        view.levels.of_pair(view.velocities, view.proxies[pair.a].body, view.proxies[pair.b].body);
    keys[row] = level == kSettledLevel ? kSettledKey : colour_key(level, view.cache.kept[row].colour);
    rows[row] = row;
  }
};

/// Where a key begins in the order: the first place whose key is not smaller.
struct FindKeys {
  const std::uint32_t* keys;
  StepCounters* counters;
  PLUMB_HD void operator()(std::uint32_t key) const {
    std::uint32_t low = 0, high = counters->manifolds;
    while (low < high) {
      const std::uint32_t middle = (low + high) / 2;
      if (keys[middle] < key)
        low = middle + 1;
      else
        high = middle;
    }
    counters->first_in_colour[key] = low;
  }
};

struct LayOutSlots {
  StepCounters* counters;
  bool together;  ///< contacts of all colours may be in one loop
  PLUMB_HD void operator()(std::uint32_t) const {
    counters->levels.count = max(counters->levels.count, 1U);
    std::uint32_t slot = 0;
    for (std::uint32_t level = 0; level < counters->levels.count; ++level) slot = lay_out(level, slot);
    PLUMB_ASSERT(slot <= slots_for(counters->manifolds));
    counters->slots = counters->first_slot[colour_key(counters->levels.count, 0)] = slot;
  }

 private:
  /// From a slot on; returns the next one.
  PLUMB_HD std::uint32_t lay_out(std::uint32_t level, std::uint32_t slot) const {
    const std::uint32_t first = slot;
    std::uint32_t used = 0, largest = 0, coloured = 0;
    for (std::uint32_t c = 0; c <= kOverflow; ++c) {
      const std::uint32_t key = colour_key(level, c);
      const std::uint32_t size = counters->first_in_colour[key + 1] - counters->first_in_colour[key];
      counters->first_slot[key] = slot;
      if (c == kOverflow) coloured = slot - first;
      slot += (size + kLaneGroup - 1) / kLaneGroup * kLaneGroup;
      if (size != 0 && c < kOverflow) used = c + 1;
      if (c < kOverflow) largest = max(largest, size);
    }
    counters->colour_count[level] = used;
    counters->level_loop[level] = longest_loop(largest, coloured, together);
    counters->longest_loop = max(counters->longest_loop, counters->level_loop[level]);
    return slot;
  }
};

struct ListUncoloured {
  std::uint32_t *keys, *rows;
  PLUMB_HD void operator()(std::uint32_t row) const {
    keys[row] = 0;
    rows[row] = row;
  }
};

struct PutAllInFirst {
  StepCounters* counters;
  PLUMB_HD void operator()(std::uint32_t key) const {
    counters->first_in_colour[key] = key == 0 ? 0 : counters->manifolds;
  }
};

}  // namespace

void Colouring::reserve(Executor& /*executor*/, std::uint32_t bodies, std::uint32_t manifolds) {
  bodies_ = bodies;
  capacity_ = manifolds;
  masks_.grow(bodies);
  claims_.grow(bodies);
  for (Buffer<std::uint32_t>* buffer : {&waiting_[0], &waiting_[1], &keys_, &rows_, &sorted_keys_, &sorted_rows_})
    buffer->grow(manifolds);
  sort_.reserve(manifolds);
}

void Colouring::begin(Executor& executor) { executor.run(bodies_, ClearBody{masks_.data(), claims_.data()}); }

void Colouring::colour(Executor& executor, const ContactCache& cache, const Velocity* velocities, const Proxy* proxies,
                       const Mechanisms& mechanisms, const BodyLevels& levels, StepCounters* counters) {
  const View view = {cache,         velocities,     proxies,
                     mechanisms,    levels,         counters,
                     masks_.data(), claims_.data(), {waiting_[0].data(), waiting_[1].data()}};
  const Count manifolds = {&counters->manifolds, capacity_};
  executor.team(manifolds, 0, ColourNew{view});
  executor.run(manifolds, ListColourKeys{view, keys_.data(), rows_.data()});
  sort_.run(executor, manifolds, keys_.data(), rows_.data(), sorted_keys_.data(), sorted_rows_.data(), 8);
  executor.run(kColourKeys + 1, FindKeys{sorted_keys_.data(), counters});
  executor.run(1U, LayOutSlots{counters, mechanisms.count == 0});
}

void Colouring::leave_out(Executor& executor, StepCounters* counters) {
  executor.run(Count{&counters->manifolds, capacity_}, ListUncoloured{sorted_keys_.data(), sorted_rows_.data()});
  executor.run(kColourKeys + 1, PutAllInFirst{counters});
  executor.run(1U, LayOutSlots{counters, false});
}

}  // namespace plumb::impulse
