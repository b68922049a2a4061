#include "replay/fineness.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "replay/mesh.hpp"

namespace plumb::harness {

namespace {

constexpr double part_of_body = 1.0 / 512, part_of_scene = 1.0 / 8192;
constexpr double tail = 0.04;       // of positions at either end
constexpr double small_body = 0.1;  // this quantile of radii
constexpr std::size_t frames_looked_at = 32;

double at_share(std::vector<double>& values, double q) {
  const auto at = values.begin() + std::llround(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double radius_of(const Json& shapes, const Json& shape) {
  double far = 0;
  if (shape.at("type") == "compound") {
    for (const Json& child : shape.at("children")) {
      const auto p = child.at("position").get<std::array<double, 3>>();
      far = std::max(far,
                     std::hypot(p[0], p[1], p[2]) + radius_of(shapes, shapes.at(child.at("shape").get<std::size_t>())));
    }
    return far;
  }
  for (const auto& p : drawn_mesh(shape).positions)
    far = std::max(far, static_cast<double>(std::hypot(p[0], p[1], p[2])));
  return far;
}

/// Half the diagonal of the box round nearly all positions of bodies that move.
double reach_of(const Trajectory& trajectory) {
  std::array<std::vector<double>, 3> values;
  const std::size_t count = trajectory.frames.size(), stride = std::max<std::size_t>(1, count / frames_looked_at);
  for (std::size_t f = 0; f < count; f += stride) {
    for (const PoseRow& row : trajectory.frames[f].poses) {
      const auto [x, y, z] = row.position;
      if (!std::isfinite(x + y + z)) continue;
      values[0].push_back(x);
      values[1].push_back(y);
      values[2].push_back(z);
    }
  }
  if (values[0].empty()) return 0;
  std::array<double, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = at_share(values[axis], tail);
    size[axis] = at_share(values[axis], 1 - tail) - low;
  }
  return std::hypot(size[0], size[1], size[2]) / 2;
}

}  // namespace

std::vector<double> radii_of_moving(const Trajectory& trajectory) {
  std::vector<double> radii;
  std::map<std::size_t, double> known;
  const Json shapes = trajectory.header.value("shapes", Json::array()),
             bodies = trajectory.header.value("bodies", Json::array());
  for (const std::size_t body : trajectory.moving) {
    radii.push_back(0);
    if (body >= bodies.size() || !bodies[body].contains("shape") || bodies[body]["shape"].is_null()) continue;
    const auto shape = bodies[body]["shape"].get<std::size_t>();
    if (!known.contains(shape)) known[shape] = radius_of(shapes, shapes.at(shape));
    radii.back() = known[shape];
  }
  return radii;
}

double radius_of_small_bodies(const Trajectory& trajectory) {
  std::vector<double> radii = radii_of_moving(trajectory);
  std::erase(radii, 0);
  return radii.empty() ? 0 : at_share(radii, small_body);
}

double step_of_positions(const Trajectory& trajectory) {
  const double body = radius_of_small_bodies(trajectory), reach = reach_of(trajectory) + body;
  const double scene = (reach > 0 ? reach : 1) * part_of_scene;
  return body > 0 ? std::min(body * part_of_body, scene) : scene;
}

}  // namespace plumb::harness
