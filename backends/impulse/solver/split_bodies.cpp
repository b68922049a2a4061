#include "solver/split_bodies.hpp"

#include <bit>

namespace plumb::impulse {

namespace {

struct CountEnds {
  const StepCounters* counters;
  std::uint32_t* ends;
  PLUMB_HD void operator()(std::uint32_t) const { *ends = 2 * counters->manifolds; }
};

/// Without colours a contact's slot is its row.
struct ListEnds {
  ContactCache cache;
  const Velocity* velocities;
  const Proxy* proxies;
  std::uint32_t sentinel;
  std::uint32_t *owners, *ends;

  PLUMB_HD void operator()(std::uint32_t row) const {
    const Pair pair = cache.pairs[cache.candidate[row]];
    put(2 * row, proxies[pair.a].body);
    put(2 * row + 1, proxies[pair.b].body);
  }

 private:
  PLUMB_HD void put(std::uint32_t end, std::uint32_t body) const {
    owners[end] = velocities[body].inverse_mass > 0 ? body : sentinel;
    ends[end] = end;
  }
};

struct ClearRange {
  PartRange* ranges;
  PLUMB_HD void operator()(std::uint32_t body) const { ranges[body] = {0, 0}; }
};

struct FindRange {
  const std::uint32_t* owners;
  const std::uint32_t* count;
  std::uint32_t sentinel;
  PartRange* ranges;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t owner = owners[i];
    if (owner == sentinel) return;
    if (i == 0 || owners[i - 1] != owner) ranges[owner].first = i;
    if (i + 1 == *count || owners[i + 1] != owner) ranges[owner].end = i + 1;
  }
};

}  // namespace

void SplitBodies::reserve(std::uint32_t bodies, std::uint32_t manifolds) {
  bodies_ = bodies;
  ends_capacity_ = 2 * manifolds;
  ranges_.grow(bodies);
  end_count_.grow(1);
  for (Buffer<std::uint32_t>* buffer : {&owners_, &ends_, &sorted_owners_, &sorted_ends_}) buffer->grow(ends_capacity_);
  changes_.grow(std::size_t{2} * slots_for(manifolds));
  sort_.reserve(ends_capacity_);
}

void SplitBodies::list(Executor& executor, const ContactCache& cache, const Velocity* velocities, const Proxy* proxies,
                       const StepCounters* counters) {
  const std::uint32_t sentinel = bodies_ - 1;
  const Count manifolds = {&counters->manifolds, ends_capacity_ / 2}, ends = {end_count_.data(), ends_capacity_};
  executor.run(1U, CountEnds{counters, end_count_.data()});
  executor.run(manifolds, ListEnds{cache, velocities, proxies, sentinel, owners_.data(), ends_.data()});
  sort_.run(executor, ends, owners_.data(), ends_.data(), sorted_owners_.data(), sorted_ends_.data(),
            static_cast<int>(std::bit_width(sentinel)));
  executor.run(bodies_, ClearRange{ranges_.data()});
  executor.run(ends, FindRange{sorted_owners_.data(), end_count_.data(), sentinel, ranges_.data()});
}

}  // namespace plumb::impulse
