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

PLUMB_HD inline std::uint32_t lowest_zero_bit(std::uint64_t mask) {
  return mask == ~std::uint64_t{0} ? kOverflow : static_cast<std::uint32_t>(trailing_zeros(~mask));
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
  PLUMB_HD void claim(std::uint32_t round, std::uint32_t row) const {
    const Ends ends = view.ends(row);
    if (ends.pushes_a) atomic_min(&view.claims[ends.a], priority(round, row));
    if (ends.pushes_b) atomic_min(&view.claims[ends.b], priority(round, row));
  }
  PLUMB_HD void colour_or_wait(std::uint32_t round, std::uint32_t row) const {
    const Ends ends = view.ends(row);
    const std::uint64_t mine = priority(round, row);
    if ((ends.pushes_a && view.claims[ends.a] != mine) || (ends.pushes_b && view.claims[ends.b] != mine)) {
      view.waiting[(round + 1) % 2][atomic_add(&view.counters->uncoloured[(round + 1) % 3], 1U)] = row;
      return;
    }
    const std::uint64_t taken = (ends.pushes_a ? view.masks[ends.a] : 0) | (ends.pushes_b ? view.masks[ends.b] : 0);
    const std::uint32_t colour = lowest_zero_bit(taken);
    PLUMB_ASSERT(colour <= kOverflow);
    view.cache.kept[row].colour = colour;
    if (colour == kOverflow) return;
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

struct ListColours {
  View view;
  std::uint32_t *colours, *rows;
  PLUMB_HD void operator()(std::uint32_t row) const {
    colours[row] = view.cache.kept[row].colour;
    rows[row] = row;
  }
};

/// Where a colour begins in the order: the first place whose colour is not smaller.
struct FindColours {
  const std::uint32_t* colours;
  StepCounters* counters;
  PLUMB_HD void operator()(std::uint32_t colour) const {
    std::uint32_t low = 0, high = counters->manifolds;
    while (low < high) {
      const std::uint32_t middle = (low + high) / 2;
      if (colours[middle] < colour)
        low = middle + 1;
      else
        high = middle;
    }
    counters->first_in_colour[colour] = low;
  }
};

struct LayOutSlots {
  StepCounters* counters;
  bool together;  ///< contacts of all colours may be in one loop
  PLUMB_HD void operator()(std::uint32_t) const {
    std::uint32_t slot = 0, used = 0, largest = 0;
    for (std::uint32_t c = 0; c <= kOverflow; ++c) {
      const std::uint32_t size = counters->first_in_colour[c + 1] - counters->first_in_colour[c];
      counters->first_slot[c] = slot;
      slot += (size + kLaneGroup - 1) / kLaneGroup * kLaneGroup;
      if (size != 0 && c < kOverflow) used = c + 1;
      if (c < kOverflow) largest = max(largest, size);
    }
    PLUMB_ASSERT(slot <= slots_for(counters->manifolds));
    counters->first_slot[kColours + 1] = slot;
    counters->colour_count = used;
    counters->longest_loop = longest_loop(largest, counters->first_slot[kOverflow], together);
  }
};

struct ListUncoloured {
  std::uint32_t *colours, *rows;
  PLUMB_HD void operator()(std::uint32_t row) const {
    colours[row] = 0;
    rows[row] = row;
  }
};

struct PutAllInFirst {
  StepCounters* counters;
  PLUMB_HD void operator()(std::uint32_t colour) const {
    counters->first_in_colour[colour] = colour == 0 ? 0 : counters->manifolds;
  }
};

}  // namespace

void Colouring::reserve(Executor& /*executor*/, std::uint32_t bodies, std::uint32_t manifolds) {
  bodies_ = bodies;
  capacity_ = manifolds;
  masks_.grow(bodies);
  claims_.grow(bodies);
  for (Buffer<std::uint32_t>* buffer : {&waiting_[0], &waiting_[1], &colours_, &rows_, &sorted_colours_, &sorted_rows_})
    buffer->grow(manifolds);
  sort_.reserve(manifolds);
}

void Colouring::begin(Executor& executor) { executor.run(bodies_, ClearBody{masks_.data(), claims_.data()}); }

void Colouring::colour(Executor& executor, const ContactCache& cache, const Velocity* velocities, const Proxy* proxies,
                       const Mechanisms& mechanisms, StepCounters* counters) {
  const View view = {cache,    velocities,    proxies,        mechanisms,
                     counters, masks_.data(), claims_.data(), {waiting_[0].data(), waiting_[1].data()}};
  const Count manifolds = {&counters->manifolds, capacity_};
  executor.team(manifolds, 0, ColourNew{view});
  executor.run(manifolds, ListColours{view, colours_.data(), rows_.data()});
  sort_.run(executor, manifolds, colours_.data(), rows_.data(), sorted_colours_.data(), sorted_rows_.data(), 7);
  executor.run(kColours + 2, FindColours{sorted_colours_.data(), counters});
  executor.run(1U, LayOutSlots{counters, mechanisms.count == 0});
}

void Colouring::leave_out(Executor& executor, StepCounters* counters) {
  executor.run(Count{&counters->manifolds, capacity_}, ListUncoloured{sorted_colours_.data(), sorted_rows_.data()});
  executor.run(kColours + 2, PutAllInFirst{counters});
  executor.run(1U, LayOutSlots{counters, false});
}

}  // namespace plumb::impulse
