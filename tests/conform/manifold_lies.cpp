// Lies about contacts that are shown to the host and changed by it.
#include "honest.hpp"

namespace plumb::lying {
namespace {

template <auto change>
void change_shown() {
  liar.manifolds.read = [](PlumbWorld* world, PlumbManifold* out, std::size_t stride, std::uint32_t capacity,
                           std::uint32_t* count) {
    const PlumbResult result = honest.manifolds.read(world, out, stride, capacity, count);
    for (std::uint32_t i = 0; result >= 0 && i < std::min(capacity, *count); ++i)
      change(*reinterpret_cast<PlumbManifold*>(reinterpret_cast<std::byte*>(out) + i * stride));
    return result;
  };
}

/// Changes without these bits; one that has no other is said to be made.
template <std::uint32_t bits>
void lose_changes() {
  liar.manifolds.modify = [](PlumbWorld* world, const PlumbManifoldChange* changes, std::size_t stride,
                             std::uint32_t count) {
    std::vector<PlumbManifoldChange> some = copied(changes, stride, count);
    for (PlumbManifoldChange& change : some) change.what &= ~bits;
    std::erase_if(some, [](const PlumbManifoldChange& change) { return change.what == 0; });
    return honest.manifolds.modify(world, some.data(), sizeof(PlumbManifoldChange),
                                   static_cast<std::uint32_t>(some.size()));
  };
}

}  // namespace

void shown_friction_doubled() {
  change_shown<[](PlumbManifold& row) { row.friction *= 2; }>();
}
void shown_velocities_turned_round() {
  change_shown<[](PlumbManifold& row) { row.velocity.x = -row.velocity.x; }>();
}
void contacts_go_unless_they_are_changed() {
  liar.manifolds.modify = [](PlumbWorld* world, const PlumbManifoldChange* changes, std::size_t stride,
                             std::uint32_t count) {
    PlumbManifoldChange first = manifold_change(0);
    first.what = PLUMB_MANIFOLD_DISABLED;
    return count == 0 ? honest.manifolds.modify(world, &first, sizeof first, 1)
                      : honest.manifolds.modify(world, changes, stride, count);
  };
}
void disabled_contacts_hold() { lose_changes<PLUMB_MANIFOLD_DISABLED>(); }
void the_woken_stand_on_disabled_contacts() { lose_changes<PLUMB_MANIFOLD_DISABLED>(); }
void changed_friction_is_not() { lose_changes<PLUMB_MANIFOLD_FRICTION>(); }
void changed_restitution_is_not() { lose_changes<PLUMB_MANIFOLD_RESTITUTION>(); }
void changed_surfaces_stand() { lose_changes<PLUMB_MANIFOLD_SURFACE_VELOCITY>(); }
void bad_manifold_changes_are_done() {
  liar.manifolds.modify = [](PlumbWorld* world, const PlumbManifoldChange* changes, std::size_t stride,
                             std::uint32_t count) -> PlumbResult {
    const PlumbResult result = honest.manifolds.modify(world, changes, stride, count);
    return result == PLUMB_E_INVALID_ARGUMENT ? PLUMB_OK : result;
  };
}

}  // namespace plumb::lying
