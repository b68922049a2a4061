// Triangle meshes that forces move: Bullet's usual mesh only stands still, its other one (GImpact) collides triangle by
// triangle with everything.
#pragma once

#include "shapes.hpp"

namespace plumb::bullet {

/// A mesh for a dynamic body. offset: the body's frame seen from its mass frame. The shape must outlive the result.
std::unique_ptr<btCollisionShape> make_moving_mesh(const Shape& mesh, const btTransform& offset);

/// Teaches a dispatcher to collide moving meshes; without, they touch nothing.
void collide_moving_meshes(btCollisionDispatcher& dispatcher);

}  // namespace plumb::bullet
