#include <cstdio>

#include "plumb/loader.hpp"

int main() {
  const plumb::Backend backend = plumb::open_backend("impulse");  // a name on the search path, or a file
  const auto world =
      backend.create_world(plumb::world_desc(PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION));

  PlumbShapeDesc boxes[2] = {plumb::shape_desc(PLUMB_BOX), plumb::shape_desc(PLUMB_BOX)};
  boxes[0].half_extents = {50, 0.5, 50};  // m
  boxes[1].half_extents = {0.5, 0.5, 0.5};
  PlumbShape shapes[2];
  plumb::check(*world, world->create_shapes(boxes, shapes));  // throws plumb::Error with the backend's sentence

  PlumbBodyDesc descs[2] = {plumb::body_desc(PLUMB_STATIC), plumb::body_desc()};
  descs[0].shape = shapes[0];
  descs[0].pose.position = {0, -0.5, 0};
  descs[1].shape = shapes[1];
  descs[1].pose.position = {0, 3, 0};
  PlumbBody bodies[2];
  plumb::check(*world, world->create_bodies(descs, bodies));

  for (int i = 0; i < 120; ++i) {
    PlumbStepReport report{};
    plumb::check(*world, world->step(1.0 / 60));  // begins; nothing else may be asked until it is waited for
    plumb::check(*world, world->wait(report));
  }
  PlumbPose pose;
  plumb::check(*world, world->read(PLUMB_FIELD_POSE, {&bodies[1], 1}, plumb::rows_over<PlumbPose>({&pose, 1})));
  std::printf("the cube rests at %.3f m\n", pose.position.y);
}
