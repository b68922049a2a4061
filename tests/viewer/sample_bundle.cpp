// Prints a packed bundle of motions from formulas, in base64: test_coded.mjs opens it and knows the same formulas.
#include <cmath>
#include <iostream>

#include "base/base64.hpp"
#include "replay/bundle.hpp"

namespace plumb::harness {
namespace {

constexpr std::uint32_t frames = 300, broken_from = 100;

PoseRow pose_of(std::uint32_t frame, int body) {
  const double t = frame / 60.0, a = 5 * std::sin(t), b = 3 * t;
  const double height = t < 1 ? 6 - 4.905 * t * t : 1.095;
  if (body == 0) return {{0.3 * t, height, -2}, {0, 0, 0, 1}};
  if (body == 1)
    return {{0, 0, 1},
            {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a) * std::sin(2 * b),
             std::cos(a) * std::cos(2 * b)}};
  return {{frame == 7 ? NAN : 1e8, 0, 0}, {0, std::sin(t), 0, -std::cos(t)}};
}

Trajectory sample() {
  const LayerSpec joints{"joints", LayerRows::list, {{"joint", "u32"}, {"gap", "f32"}, {"angle", "f32"}}};
  Trajectory trajectory;
  trajectory.header = {{"scene", "sample"},   {"backend", "formulas"},
                       {"dt", 1.0 / 60},      {"shapes", {{{"type", "sphere"}, {"radius", 1.0}}}},
                       {"moving", {0, 1, 2}}, {"joints", Json::array()}};
  trajectory.layers = {joints};
  trajectory.moving = {0, 1, 2};
  for (int body = 0; body < 3; ++body)
    trajectory.header["bodies"].push_back(
        {{"name", "b"}, {"shape", 0}, {"motion", "dynamic"}, {"start", {0, 0, 0, 0, 0, 0, 1}}});
  for (std::uint32_t f = 0; f < frames; ++f) {
    TrajectoryFrame frame{f, {}, FrameLayers(1)};
    for (int body = 0; body < 3; ++body) frame.poses.push_back(pose_of(f, body));
    LayerData& rows = frame.layers[0].emplace(joints);
    for (std::uint32_t joint = f < broken_from ? 0 : 1; joint < 3; ++joint, ++rows.rows) {
      rows.put(0, joint);
      rows.put(1, joint == 2 ? NAN : 0.1f * static_cast<float>(joint + 1) / static_cast<float>(f + 1));
      rows.put(2, 0.0f);
    }
    trajectory.frames.push_back(std::move(frame));
  }
  return trajectory;
}

}  // namespace
}  // namespace plumb::harness

int main() { std::cout << plumb::harness::base64(plumb::harness::bounded_bundle(plumb::harness::sample(), 1 << 20)); }
