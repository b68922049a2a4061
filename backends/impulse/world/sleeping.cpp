// Who sleeps, between steps.
#include <algorithm>
#include <map>
#include <numeric>

#include "world/simulation.hpp"

namespace plumb::impulse {

namespace {

/// Bodies that joints join, over bodies that can be pushed: the name of a group is its smallest body.
std::vector<std::uint32_t> joined_groups(const JointStore& joints, const Table<BodyMass>& mass, std::uint32_t bodies) {
  std::vector<std::uint32_t> parent(bodies);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t body) {
    while (parent[body] != body) body = parent[body] = parent[parent[body]];
    return body;
  };
  const auto is_pushed = [&](std::uint32_t body) { return body != kWorld && (mass[body].flags & kBodyDynamic) != 0; };
  joints.for_joined([&](std::uint32_t a, std::uint32_t b) {
    if (!is_pushed(a) || !is_pushed(b)) return;
    const std::uint32_t root_a = root(a), root_b = root(b);
    parent[std::max(root_a, root_b)] = std::min(root_a, root_b);
  });
  for (std::uint32_t body = 0; body < bodies; ++body) parent[body] = root(body);
  return parent;
}

}  // namespace

Simulation::Slots Simulation::wake(std::span<const std::uint32_t> slots) {
  Slots woken = sleep_.wake(slots, bodies.mass, bodies.state);
  if (woken.empty()) return woken;
  bodies_changed();
  joints.bodies_changed();
  return woken;
}

Simulation::Slots Simulation::wake_neighbours(std::span<const std::uint32_t> slots, bool touching) {
  if (sleep_.count() == 0) return {};
  Slots near;
  if (touching) near = sleep_.neighbours(slots);
  std::vector<bool> is_one(bodies.count, false);
  for (const std::uint32_t body : slots) is_one[body] = true;
  joints.for_joined([&](std::uint32_t a, std::uint32_t b) {
    if (a == kWorld) return;
    if (is_one[a]) near.push_back(b);
    if (is_one[b]) near.push_back(a);
  });
  return wake(near);
}

Simulation::Slots Simulation::wake_all() {
  Slots all;
  for (std::uint32_t body = 0; body < bodies.count; ++body)
    if (sleeps(body)) all.push_back(body);
  return wake(all);
}

Simulation::Slots Simulation::put_to_sleep(std::span<const std::uint32_t> slots) {
  const std::vector<std::uint32_t> group = joined_groups(joints, bodies.mass, bodies.count);
  std::map<std::uint32_t, Slots> islands;
  for (const std::uint32_t body : slots)
    if ((bodies.mass[body].flags & kBodyDynamic) != 0) islands.try_emplace(group[body]);
  for (std::uint32_t body = 0; body < bodies.count; ++body)
    if (const auto island = islands.find(group[body]); island != islands.end()) island->second.push_back(body);
  Slots fallen;
  for (const auto& [name, island] : islands) {
    fall_asleep(island);
    fallen.insert(fallen.end(), island.begin(), island.end());
  }
  if (!fallen.empty()) store_contacts();
  return fallen;
}

void Simulation::let_islands_rest() {
  sleep_.islands().find_resting(executor_,
                                {stages_.narrow_phase.cache(step_),
                                 counters().manifolds,
                                 {joints.device(), joints.count(), joints.drives.device()},
                                 body_view(),
                                 bodies.count,
                                 colliders.view(),
                                 sleep_.rest(),
                                 numbers_.parameters[0].sleep_time,
                                 stages_.features.surface_velocity ? colliders.surface_velocities.device() : nullptr,
                                 stages_.changes()});
  executor_.wait();
  if (sleep_.islands().resting_count() == 0) return;
  const Slots names = sleep_.islands().resting(bodies.count);
  std::map<std::uint32_t, Slots> islands;
  for (std::uint32_t body = 0; body < bodies.count; ++body)
    if (names[body] != 0) islands[names[body]].push_back(body);
  for (const auto& [name, island] : islands) {
    fall_asleep(island);
    outcome_.fallen_asleep.insert(outcome_.fallen_asleep.end(), island.begin(), island.end());
  }
  store_contacts();
}

void Simulation::fall_asleep(const Slots& island) {
  sleep_.fall_asleep(island, bodies.mass, bodies.state);
  bodies_changed();
  statics_changed();
  joints.bodies_changed();
}

/// Contacts of the last step of which neither body moves any more: no step will find them until somebody wakes.
void Simulation::store_contacts() {
  if (restored_) return;
  const std::vector<KeptPair> kept = stages_.narrow_phase.kept(step_, counters());
  const std::vector<ContactRecord> records = contacts_of_step();
  const auto stays = [&](std::uint32_t index) {
    const Proxy& proxy = colliders.proxies[index];
    return proxy.shape != kNone && proxy.first_step <= step_ && (bodies.mass[proxy.body].flags & kBodyMoves) == 0;
  };
  for (std::size_t row = 0; row < kept.size(); ++row) {
    const Pair pair = kept[row].pair;
    if (stays(pair.a) && stays(pair.b))
      sleep_.store({colliders.proxies[pair.a].body, colliders.proxies[pair.b].body, kept[row], records[row], step_});
  }
}

}  // namespace plumb::impulse
