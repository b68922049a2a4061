// Rays, shape casts, overlaps and their depths that pass through what a filter refuses: who asks, his limbs and weapon,
// what is made of glass. Filters of PlumbFilter are the engine's and cheaper; these are for what its bits cannot say.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

/// Whether a hit counts. It gets the nearest one of each body and query; of a body whose nearest is refused nothing is
/// seen. Must not call the world.
using HitFilter = std::function<bool(const PlumbHit&)>;

/// All but these bodies. Copies them.
[[nodiscard]] HitFilter all_but(std::span<const PlumbBody> bodies);

// One row a query, in their order: the nearest hit that counts, body 0 where there is none. Throw Error when a query
// fails, or where the world has no queries (PLUMB_NEED_QUERIES).
[[nodiscard]] std::vector<PlumbHit> closest_hits(IPhysicsWorld& world, std::span<const PlumbRay> rays,
                                                 const HitFilter& counts);
[[nodiscard]] std::vector<PlumbHit> closest_hits(IPhysicsWorld& world, std::span<const PlumbCast> casts,
                                                 const HitFilter& counts);
/// All that count, by query and body slot.
[[nodiscard]] std::vector<PlumbHit> overlaps(IPhysicsWorld& world, std::span<const PlumbOverlap> overlaps,
                                             const HitFilter& counts);
/// How deep in which bodies, those that count, the deepest first; the filter gets each as a hit of fraction 0. Error of
/// PLUMB_E_UNSUPPORTED where the engine does not tell depths (PLUMB_QUERY_PENETRATION).
[[nodiscard]] std::vector<PlumbPenetration> penetrations(IPhysicsWorld& world, std::span<const PlumbOverlap> overlaps,
                                                         const HitFilter& counts);

}  // namespace plumb::helpers
