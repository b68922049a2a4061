// A rope bridge: planks of half a metre in an arc, each tied to the next, and the first and last to the rocks, by a
// ball joint at either side. Made without libm, so that it is the same on every machine.
#pragma once

#include <cmath>
#include <vector>

#include "tests/hashes/scene.hpp"

namespace plumb::impulse::test {

struct RopeBridge {
  std::vector<PlumbBody> planks;
  double depth;  ///< of the lowest plank below the middle of the arc, m
};

/// Of planks of 20 kg, an even number, whose ends slope by 30 degrees where there are 30 of them.
inline RopeBridge rope_bridge(Scene& scene, int planks = 30) {
  constexpr double kHalf = 0.25, kSide = 0.5;
  constexpr double kTangent = 0.0087268677907587897;  // of half a degree; there are two between planks
  struct Turn {
    double cosine, sine;
    Turn after(const Turn& first) const {
      return {cosine * first.cosine - sine * first.sine, cosine * first.sine + sine * first.cosine};
    }
  };
  const double size = 1 + kTangent * kTangent;
  const Turn degree = {(1 - kTangent * kTangent) / size, 2 * kTangent / size};
  const double radius = kHalf / degree.sine, apothem = radius * degree.cosine;
  const double length = std::sqrt(size);
  const Turn half_degree = {1 / length, kTangent / length}, back = {degree.cosine, -degree.sine};
  // The middle of a plank is an odd number of degrees from the lowest point, its ends an even one.
  Turn end = {1, 0}, half = {1, 0};  // of where the plank begins, and half the angle to its middle
  for (int i = 0; i < planks; ++i) end = back.after(end);
  for (int i = 0; i < planks - 1; ++i) half = Turn{half_degree.cosine, -half_degree.sine}.after(half);

  scene.body.material.friction = 0.8;
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = 20;
  const PlumbShape shape = scene.box({kHalf, 0.03, 0.6});
  RopeBridge bridge{{}, apothem};
  const auto tie = [&](PlumbBody before, PlumbBody next) {
    for (const double side : {-kSide, kSide}) {
      const PlumbVec3 hook = {radius * end.sine, -radius * end.cosine, side};
      const PlumbVec3 first = {-kHalf, 0, side}, last = {kHalf, 0, side};
      if (next == 0)
        scene.ball_joint(0, hook, before, last);
      else
        scene.ball_joint(before, before == 0 ? hook : last, next, first);
    }
  };
  PlumbBody before = 0;
  for (int i = 0; i < planks; ++i) {
    const Turn middle = degree.after(end);
    const PlumbBody next =
        scene.add(shape, {apothem * middle.sine, -apothem * middle.cosine, 0}, {0, 0, half.sine, half.cosine});
    bridge.planks.push_back(next);
    tie(before, next);
    before = next;
    end = degree.after(middle);
    half = degree.after(half);
  }
  tie(before, 0);
  return bridge;
}

/// Somebody who keeps upright, so far from the middle, with his feet on the planks or a little above.
inline PlumbBody person(Scene& scene, const RopeBridge& bridge, double mass, double x) {
  scene.body.locks = PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Y | PLUMB_LOCK_ANGULAR_Z;
  scene.body.mass = mass;
  const PlumbBody made =
      scene.add(scene.capsule(0.2, 0.65), {x, 1.05 - std::sqrt(bridge.depth * bridge.depth - x * x), 0});
  scene.body.locks = 0;
  return made;
}

}  // namespace plumb::impulse::test
