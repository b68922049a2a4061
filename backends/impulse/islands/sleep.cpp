#include "islands/sleep.hpp"

#include <algorithm>

#include "exec/atomic.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

struct FindTouched {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const std::uint32_t* island_of;
  std::uint32_t* touched;
  StepCounters* counters;

  PLUMB_HD void operator()(std::uint32_t row) const {
    const Pair pair = cache.pairs[cache.candidate[row]];
    const std::uint32_t a = proxies.rows[pair.a].body, b = proxies.rows[pair.b].body;
    const std::uint32_t island_a = island_of[a], island_b = island_of[b];
    if ((island_a == 0) == (island_b == 0)) return;
    if (!stirs(bodies.velocity[island_a == 0 ? a : b])) return;
    atomic_or(&touched[max(island_a, island_b) - 1], 1U);
    atomic_add(&counters->touched_sleepers, 1U);
  }

 private:
  PLUMB_HD static bool stirs(const Velocity& velocity) {
    return velocity.inverse_mass > 0 || length_squared(velocity.linear) > 0 || length_squared(velocity.angular) > 0;
  }
};

struct TimeRest {
  Bodies bodies;
  const StepParameters* parameters;
  const StepCounters* counters;
  std::uint32_t pair_capacity;
  Real* rest;

  PLUMB_HD void operator()(std::uint32_t i) const {
    if (is_undone(*counters, pair_capacity)) return;
    const BodyMass& mass = bodies.mass[i];
    const bool may = (mass.flags & kBodyDynamic) != 0 && (mass.flags & kBodyNeverSleeps) == 0;
    rest[i] = may && is_slow(i) && !is_pushed_on(bodies.force[i]) ? rest[i] + parameters->dt : 0;
  }

 private:
  /// By the kinetic energy per mass, so that turning counts as the motion of the body's outer parts.
  PLUMB_HD bool is_slow(std::uint32_t i) const {
    const Velocity& velocity = bodies.velocity[i];
    const Vec& inertia = bodies.mass[i].inertia;
    const Real radius_squared = max(max(inertia.x, inertia.y), inertia.z) * velocity.inverse_mass;
    const Real speed = parameters->sleep_speed;
    return length_squared(velocity.linear) + radius_squared * length_squared(velocity.angular) <= speed * speed;
  }
  PLUMB_HD static bool is_pushed_on(const BodyForce& by_host) {
    return length_squared(by_host.force) > 0 || length_squared(by_host.torque) > 0;
  }
};

}  // namespace

void Sleep::reserve(std::uint32_t bodies) {
  islands_.reserve(bodies);
  island_of_.grow(bodies);
  touched_.grow(bodies);
  rest_.grow(bodies);
  was_.resize(bodies);
  islands_changed_ = true;
}

void Sleep::find_touched(Executor& executor, const ContactCache& cache, std::uint32_t capacity, const Bodies& bodies,
                         const Proxies& proxies, StepCounters* counters) {
  executor.run(Count{&counters->manifolds, capacity},
               FindTouched{cache, bodies, proxies, island_of_.device(), touched_.data(), counters});
}

void Sleep::time_rest(Executor& executor, const Bodies& bodies, std::uint32_t body_count,
                      const StepParameters* parameters, const StepCounters* counters, std::uint32_t pair_capacity) {
  executor.run(body_count, TimeRest{bodies, parameters, counters, pair_capacity, rest_.data()});
}

std::vector<std::uint32_t> Sleep::touched() {
  const std::vector<std::uint32_t> marks = touched_.to_host(was_.size());
  memory::fill(touched_.data(), 0, touched_.size() * sizeof(std::uint32_t));
  std::vector<std::uint32_t> bodies;
  for (const auto& [island, members] : made_of_) {
    PLUMB_ASSERT(island != 0 && !members.empty());
    if (marks[island - 1] != 0) bodies.push_back(members.front());
  }
  return bodies;
}

void Sleep::fall_asleep(std::span<const std::uint32_t> island, Table<BodyMass>& mass, BodyState& state) {
  PLUMB_ASSERT(!island.empty());
  const std::uint32_t name = 1 + *std::min_element(island.begin(), island.end());
  for (const std::uint32_t body : island) {
    PLUMB_ASSERT(!sleeps(body));
    BodyMass& row = mass.edit(body);
    PLUMB_ASSERT((row.flags & kBodyDynamic) != 0);
    was_[body] = {name, row.flags, state.velocity[body].inverse_mass};
    row.flags &= ~static_cast<std::uint32_t>(kBodyDynamic | kBodyMoves);
    state.velocity[body] = {};
    state.touch(body, kVelocityPart);
    island_of_[body] = name;
  }
  made_of_[name].assign(island.begin(), island.end());
  count_ += static_cast<std::uint32_t>(island.size());
  islands_changed_ = true;
}

std::vector<std::uint32_t> Sleep::wake(std::span<const std::uint32_t> bodies, Table<BodyMass>& mass, BodyState& state) {
  std::vector<std::uint32_t> woken;
  for (const std::uint32_t body : bodies) {
    if (!sleeps(body)) continue;
    const auto island = made_of_.find(was_[body].island);
    PLUMB_ASSERT(island != made_of_.end());
    for (const std::uint32_t member : island->second) {
      mass.edit(member).flags = was_[member].flags;
      state.velocity[member] = {};
      state.velocity[member].inverse_mass = was_[member].inverse_mass;
      state.touch(member, kVelocityPart);
      was_[member].island = island_of_[member] = 0;
      woken.push_back(member);
    }
    made_of_.erase(island);
  }
  if (woken.empty()) return woken;
  PLUMB_ASSERT(count_ >= woken.size());
  count_ -= static_cast<std::uint32_t>(woken.size());
  islands_changed_ = true;
  const auto still_asleep = [&](const StoredContact& contact) {
    return sleeps(contact.body_a) || sleeps(contact.body_b);
  };
  const auto risen = std::stable_partition(stored_.begin(), stored_.end(), still_asleep);
  std::move(risen, stored_.end(), std::back_inserter(woken_));
  stored_.erase(risen, stored_.end());
  return woken;
}

std::vector<bool> Sleep::marks_of(std::span<const std::uint32_t> bodies) const {
  std::vector<bool> marks(was_.size(), false);
  for (const std::uint32_t body : bodies) marks[body] = true;
  return marks;
}

std::vector<std::uint32_t> Sleep::neighbours(std::span<const std::uint32_t> bodies) const {
  const std::vector<bool> is_one = marks_of(bodies);
  std::vector<std::uint32_t> found;
  for (const StoredContact& contact : stored_) {
    if (sleeps(contact.body_a) && is_one[contact.body_b]) found.push_back(contact.body_a);
    if (sleeps(contact.body_b) && is_one[contact.body_a]) found.push_back(contact.body_b);
  }
  return found;
}

void Sleep::forget(std::span<const std::uint32_t> bodies) {
  if (stored_.empty() && woken_.empty()) return;
  const std::vector<bool> is_one = marks_of(bodies);
  for (auto* contacts : {&stored_, &woken_})
    std::erase_if(*contacts,
                  [&](const StoredContact& contact) { return is_one[contact.body_a] || is_one[contact.body_b]; });
}

void Sleep::exchange(Archive& archive, std::uint32_t bodies, Table<BodyMass>& mass) {
  if (archive.reads())
    for (std::uint32_t body = 0; body < was_.size(); ++body)
      if (sleeps(body)) mass.edit(body).flags = was_[body].flags;
  archive.items(was_.data(), bodies);
  archive.rows_of_all(rest_, bodies);
  archive.list(stored_);
  archive.list(woken_);
  if (!archive.reads()) return;
  count_ = 0;
  made_of_.clear();
  const auto behind = std::span(was_).subspan(bodies);
  std::fill(behind.begin(), behind.end(), Was{});
  std::fill(island_of_.host() + bodies, island_of_.host() + island_of_.size(), 0U);
  for (std::uint32_t body = 0; body < bodies; ++body) {
    island_of_[body] = was_[body].island;
    if (!sleeps(body)) continue;
    mass.edit(body).flags &= ~static_cast<std::uint32_t>(kBodyDynamic | kBodyMoves);
    made_of_[was_[body].island].push_back(body);
    ++count_;
  }
  islands_changed_ = true;
}

void Sleep::upload(Executor& executor) {
  if (islands_changed_) executor.to_device(island_of_, island_of_.size());
  islands_changed_ = false;
  if (woken_.empty()) return;
  woken_pairs_.grow(woken_.size());
  for (std::size_t i = 0; i < woken_.size(); ++i) woken_pairs_[i] = woken_[i].kept;
  std::sort(woken_pairs_.host(), woken_pairs_.host() + woken_.size(), earlier);
  executor.to_device(woken_pairs_, woken_.size());
}

}  // namespace plumb::impulse
