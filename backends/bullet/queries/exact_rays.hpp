// Rays against spheres and boxes by their equations: Bullet's iterations miss some of them by millimetres.
#pragma once

#include <optional>

#include "body.hpp"
#include "plumb/backend/small_math.hpp"

namespace plumb::bullet {

struct RayEntry {
  double fraction;   ///< of the translation
  PlumbVec3 normal;  ///< world, unit
};

[[nodiscard]] backend::Matrix3 to_matrix(const btMatrix3x3& basis);

/// Whether a body is one that ray_enters knows.
[[nodiscard]] bool has_exact_ray(const Body& body);

/// Where a ray enters a body; nothing for one that starts inside, as for Bullet's own.
[[nodiscard]] std::optional<RayEntry> ray_enters(const Body& body, const PlumbVec3& origin,
                                                 const PlumbVec3& translation);

}  // namespace plumb::bullet
