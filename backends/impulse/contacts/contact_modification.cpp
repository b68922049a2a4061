#include "contacts/contact_modification.hpp"

#include <algorithm>

#include "narrowphase/contact_material.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

struct FindAsked {
  ContactModification::Input in;
  std::uint32_t* is_shown;

  PLUMB_HD void operator()(std::uint32_t p) const {
    const Pair pair = in.cache.pairs[p];
    is_shown[p] = in.cache.touching[p] != 0 && (asks(pair.a) || asks(pair.b)) ? 1 : 0;
  }

 private:
  [[nodiscard]] PLUMB_HD bool asks(std::uint32_t proxy) const {
    return (in.bodies.mass[in.proxies.rows[proxy].body].flags & kBodyShowsContacts) != 0;
  }
};

struct ShowManifolds {
  ContactModification::Input in;
  const std::uint32_t *is_shown, *place;
  ShownManifold* rows;

  PLUMB_HD void operator()(std::uint32_t p) const {
    if (is_shown[p] == 0) return;
    const Manifold& found = in.cache.found[p];
    const Pair pair = in.cache.pairs[p];
    const Proxy &a = in.proxies.rows[pair.a], &b = in.proxies.rows[pair.b];
    ShownManifold row{};
    row.contact.pair = pair;
    row.contact.bodies = {a.body, b.body};
    row.contact.normal = found.normal;
    row.contact.count = found.count;
    const Vec arm = rotate(in.bodies.orientation[a.body], a.frame.position);
    const Position origin = moved(in.bodies.position[a.body], arm);
    Vec middle = {0, 0, 0};
    for (std::uint32_t i = 0; i < found.count; ++i) {
      row.contact.triangle[i] = in.cache.triangles == nullptr ? 0 : in.cache.triangles[p];
      row.contact.feature[i] = found.points[i].feature;
      row.contact.position[i] = moved(origin, found.points[i].position);
      row.contact.separation[i] = found.points[i].separation;
      middle += found.points[i].position;
    }
    const Vec from_a = arm + (Real(1) / static_cast<Real>(found.count)) * middle;
    const Vec from_b = from_a - between(in.bodies.position[a.body], in.bodies.position[b.body]);
    row.velocity = velocity_of(b.body, from_b) - velocity_of(a.body, from_a);
    const Material material = contact_material(in.cache, in.proxies, p);
    row.friction = material.friction;
    row.restitution = material.restitution;
    if (in.surface_velocities != nullptr) row.surface_velocity = surface_of(pair.b) - surface_of(pair.a);
    rows[place[p]] = row;
  }

 private:
  [[nodiscard]] PLUMB_HD Vec velocity_of(std::uint32_t body, const Vec& arm) const {
    const Velocity& velocity = in.bodies.velocity[body];
    return velocity.linear + cross(velocity.angular, arm);
  }
  [[nodiscard]] PLUMB_HD Vec surface_of(std::uint32_t proxy) const {
    return rotate(in.bodies.orientation[in.proxies.rows[proxy].body], in.surface_velocities[proxy]);
  }
};

struct DisableManifolds {
  ContactCache cache;
  ManifoldChanges changes;
  PLUMB_HD void operator()(std::uint32_t p) const {
    if (changes.disables(p)) cache.touching[p] = 0;
  }
};

}  // namespace

void ContactModification::reserve(std::uint32_t pairs) {
  scan_.reserve(pairs);
  is_shown_.grow(pairs);
  place_.grow(pairs);
  shown_.grow(pairs);
  changes_.grow(pairs);
  count_.grow(1);
}

void ContactModification::show(Executor& executor, const Input& input) {
  executor.run(input.candidates, FindAsked{input, is_shown_.data()});
  scan_.run(executor, input.candidates, is_shown_.data(), place_.data(), count_.device());
  executor.run(input.candidates, ShowManifolds{input, is_shown_.data(), place_.data(), shown_.device()});
  executor.to_host(count_, 1);
}

std::span<const ShownManifold> ContactModification::shown(Executor& executor) {
  executor.to_host(shown_, shown_count());
  executor.wait();
  return {shown_.host(), shown_count()};
}

void ContactModification::change(Executor& executor, std::span<const ManifoldChange> changes) {
  PLUMB_ASSERT(changes.size() == *count_.host());
  std::copy(changes.begin(), changes.end(), changes_.host());
  executor.to_device(changes_, changes.size());
}

void ContactModification::disable(Executor& executor, const ContactCache& cache, Count candidates) {
  executor.run(candidates, DisableManifolds{cache, changes()});
}

}  // namespace plumb::impulse
