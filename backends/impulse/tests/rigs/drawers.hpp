// Drawers that slope, rest at the end of their ways with loads in them, and are struck from there. Made without libm,
// so that they are the same on every machine.
#pragma once

#include "tests/hashes/scene.hpp"

namespace plumb::impulse::test {

inline constexpr PlumbQuat kUp = {0, 0, 0.70710678118654752, 0.70710678118654752};  // an x axis along y

inline PlumbJointDesc slider(const PlumbQuat& along, PlumbBody body) {
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SLIDER);
  desc.body_b = body;
  desc.frame_a.orientation = desc.frame_b.orientation = along;
  return desc;
}
inline void make(Scene& scene, const PlumbJointDesc& desc) {
  PlumbJoint id = 0;
  check(scene.world(), scene.world().joints()->create_joints({&desc, 1}, {&id, 1}));
}

/// Four drawers of 2 kg, one beside the other, with loads of 1 to 1,000 kg, and a ball of 50 kg that comes for each.
inline void drawers(Scene& scene) {
  constexpr double kSine = 0.09950371902099892, kCosine = 0.99503719020998915;  // of half the slope, 11.4 degrees
  constexpr double kDownhill = -2 * kSine * kCosine, kAlong = kCosine * kCosine - kSine * kSine;  // of the whole slope
  const PlumbQuat slope = {0, 0, -kSine, kCosine};
  const PlumbShape board = scene.box({0.5, 0.02, 0.3}), load = scene.box({0.1, 0.1, 0.1}), ball = scene.sphere(0.15);
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  double heavy = 1;
  for (int i = 0; i < 4; ++i, heavy *= 10) {
    const PlumbVec3 at = {0, 0, 1.0 * i};
    scene.body.mass = 2;
    PlumbJointDesc desc = slider(slope, scene.add(board, at, slope));
    desc.frame_a.position = at;
    desc.frame_b.orientation = {0, 0, 0, 1};
    desc.limits[0] = {-1, 0, 1, 0};
    make(scene, desc);
    scene.body.mass = heavy;
    scene.add(load, {-kDownhill * 0.12, kAlong * 0.12, at.z}, slope);
    scene.body.mass = 50;
    const PlumbBody comes = scene.add(ball, {3, kDownhill * 0.6 - 0.35, at.z});
    scene.write(PLUMB_FIELD_VELOCITY, comes, {-5.0, 3.0, 0, 0, 0, 0});
  }
}

}  // namespace plumb::impulse::test
