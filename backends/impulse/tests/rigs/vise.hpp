// A vise: two cubes on the ground, and a slider whose motor draws one onto the other.
#pragma once

#include "tests/rigs/drawers.hpp"

namespace plumb::impulse::test {

/// Cubes of 1 m and 10 kg, which may touch although they are joined; returns the one that is drawn. force: N.
inline PlumbBody vise(Scene& scene, double force) {
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = 10;
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SLIDER);
  desc.body_a = scene.add(cube, {0, 0.5, 0});
  desc.body_b = scene.add(cube, {1, 0.5, 0});
  desc.frame_a.position = {0.5, 0, 0};
  desc.frame_b.position = {-0.5, 0, 0};
  desc.collide_connected = 1;
  desc.motors[0] = {-1, force, 1, 0};
  make(scene, desc);
  return desc.body_b;
}

}  // namespace plumb::impulse::test
