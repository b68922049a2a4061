// A ray through a point of the window goes where the window draws what is there.
#include <gtest/gtest.h>

#include "hosts/ogre/game/camera.hpp"
#include "hosts/ogre/game/vectors.hpp"

namespace plumb::ogre::tests {
namespace {

TEST(Camera, LooksAtItsTargetThroughTheMiddle) {
  const Camera camera;
  const Ray ray = camera.ray(0.5, 0.5);
  const PlumbVec3 there = add(ray.origin, scale(camera.distance, ray.direction));
  EXPECT_NEAR(distance(there, camera.target), 0, 1e-12);
}

TEST(Camera, EdgesAreHalfTheFieldOfViewAway) {
  Camera camera;
  camera.aspect = 2;
  const auto cosine = [&](double x, double y) { return dot(camera.ray(x, y).direction, camera.forward()); };
  EXPECT_NEAR(std::acos(cosine(0.5, 0)), camera.field_of_view / 2, 1e-12);
  EXPECT_NEAR(std::tan(std::acos(cosine(1, 0.5))), 2 * std::tan(camera.field_of_view / 2), 1e-12);
  EXPECT_GT(camera.ray(0.5, 0).direction.y, camera.ray(0.5, 1).direction.y);
  EXPECT_GT(dot(camera.ray(1, 0.5).direction, camera.right()), 0);
}

TEST(Camera, StaysAboveTheGround) {
  Camera camera;
  camera.turn(1, -1);
  EXPECT_GT(camera.eye().y, camera.target.y);
  camera.zoom(1e9);
  EXPECT_LE(camera.distance, 30);
}

}  // namespace
}  // namespace plumb::ogre::tests
