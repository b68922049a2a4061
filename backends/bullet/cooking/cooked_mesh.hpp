// A mesh in bytes: its arrays as Bullet reads them, its box and its tree.
#pragma once

#include "shapes.hpp"

namespace plumb::bullet {

/// Throws Error for what Bullet's arithmetic cannot hold.
std::vector<std::byte> cook_mesh(const PlumbShapeDesc& desc);
/// What make_shape() makes of the descriptor that was cooked. Throws PLUMB_E_CORRUPT for bytes that are of no mesh.
std::shared_ptr<const Shape> make_cooked_mesh(std::span<const std::byte> bytes);

}  // namespace plumb::bullet
