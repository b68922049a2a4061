#include "generate/random_part.hpp"

#include <algorithm>

namespace plumb::harness {
namespace {

using referee::Vec3;

struct Solid {
  SceneShape shape;
  double radius;  ///< of the ball about its centre that holds it
};

SceneShape random_hull(Chance& chance, const Vec3& radii) {
  SceneShape shape;
  shape.desc = shape_desc(PLUMB_CONVEX_HULL);
  for (int sign : {-1, 1})
    for (int axis = 0; axis < 3; ++axis) {  // so that it is never flat
      Vec3 corner = Vec3::Zero();
      corner[axis] = sign * radii[axis];
      shape.vertices.insert(shape.vertices.end(), corner.begin(), corner.end());
    }
  const std::size_t more = 2 + chance.below(20);
  for (std::size_t i = 0; i < more; ++i) {
    const Vec3 corner = radii.cwiseProduct(chance.direction());
    shape.vertices.insert(shape.vertices.end(), corner.begin(), corner.end());
  }
  return shape;
}

Solid random_solid(Chance& chance, const Features& features) {
  Vec3 half{chance.by_ratio(0.04, 0.2), chance.by_ratio(0.04, 0.2), chance.by_ratio(0.04, 0.2)};
  if (features.has(Feature::slender) && chance.happens(0.4))
    half =
        chance.happens(0.5) ? Vec3(0.02, chance.by_ratio(0.1, 0.4), 0.02) : Vec3(0.2, 0.02, chance.between(0.1, 0.3));
  switch (chance.below(features.has(Feature::hulls) ? 5 : 3)) {
    case 0: return {box_shape_of(half), half.norm()};
    case 1: return {sphere_shape(half.x()), half.x()};
    case 2: return {capsule_shape(half.x(), half.y()), half.x() + half.y()};
    case 3: return {cylinder_shape(half.x(), half.y()), std::hypot(half.x(), half.y())};
    default: return {random_hull(chance, half), half.maxCoeff()};
  }
}

}  // namespace

RandomPart random_part(Chance& chance, const Features& features, double mass_ratio) {
  RandomPart part;
  const Solid first = random_solid(chance, features);
  part.shapes.push_back({first.shape, {}});
  part.radius = first.radius;
  if (features.has(Feature::compounds) && chance.happens(0.4)) {
    const Solid second = random_solid(chance, features);
    const double apart = 0.7 * (first.radius + second.radius);
    referee::Pose pose;
    pose.rotation = chance.rotation();
    pose.position = apart * chance.direction();
    part.shapes.push_back({second.shape, pose});
    part.radius = std::max(first.radius, apart + second.radius);
  }
  part.mass = 5 * chance.by_ratio(1 / std::sqrt(mass_ratio), std::sqrt(mass_ratio));
  return part;
}

}  // namespace plumb::harness
