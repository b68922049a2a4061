// What rolls: a round surface touches with ever other places of itself.
//
// The arm of a contact turns with its body, as that of a corner does. The place where a ball touches does not: what
// turns is the arm to the ball's centre, which has no length, and the radius from there stays along the normal. With
// the whole arm turned, a ball that rolls by an angle a within a step would seem to rise by radius (1 - cos a), and the
// solver would let it fall.
#pragma once

#include "bodies/body.hpp"

namespace plumb::impulse {

/// Radius of a proxy's shape where it touches something along the normal, m: of a ball, of a capsule, of a cylinder
/// that lies on its side; 0 where corners, edges or faces touch. body: the orientation of the proxy's body.
PLUMB_HD inline Real rolling_radius(const Proxies& proxies, const Proxy& proxy, const Quat& body, const Vec& normal) {
  constexpr Real kLies = Real(0.3);  // of the axis along the normal
  const Shape& shape = proxies.shapes[proxy.shape];
  if (shape.type == ShapeType::kSphere || shape.type == ShapeType::kCapsule) return shape.size.x;
  if (shape.type != ShapeType::kCylinder) return 0;
  const Vec axis = rotate(body * proxy.frame.orientation, Vec{0, 1, 0});
  return abs(dot(axis, normal)) < kLies ? shape.size.x : Real(0);
}

}  // namespace plumb::impulse
