#include "hosts/ogre/game/camera.hpp"

#include <algorithm>
#include <cmath>

#include "hosts/ogre/game/vectors.hpp"

namespace plumb::ogre {

PlumbVec3 Camera::forward() const {
  return {-std::sin(yaw) * std::cos(pitch), -std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

PlumbVec3 Camera::right() const { return {std::cos(yaw), 0, -std::sin(yaw)}; }

PlumbVec3 Camera::eye() const { return sub(target, scale(distance, forward())); }

Ray Camera::ray(double x, double y) const {
  const double half = std::tan(field_of_view / 2);
  const PlumbVec3 up = cross(right(), forward());
  const PlumbVec3 way = add(forward(), add(scale((2 * x - 1) * half * aspect, right()), scale((1 - 2 * y) * half, up)));
  return {eye(), scale(1 / length(way), way)};
}

void Camera::turn(double by_yaw, double by_pitch) {
  yaw += by_yaw;
  pitch = std::clamp(pitch + by_pitch, 0.05, 1.4);
}

void Camera::zoom(double factor) { distance = std::clamp(distance * factor, 3.0, 30.0); }

}  // namespace plumb::ogre
