#include "measure/instruments/overlaps.hpp"

#include <algorithm>
#include <cmath>

#include "referee/pose.hpp"
#include "referee/world_penetration.hpp"

namespace plumb::harness {

Overlaps::Overlaps(const Scene& scene, const std::vector<referee::ShapePtr>& shapes) : scene_(scene), shapes_(shapes) {
  for (const SceneJoint& joint : scene.joints) {
    if (!joint.body_a || joint.desc.collide_connected != 0) continue;
    const auto [low, high] =
        std::minmax({static_cast<std::uint32_t>(*joint.body_a), static_cast<std::uint32_t>(joint.body_b)});
    joined_.insert({low, high});
  }
}

void Overlaps::add(Simulation& simulation) {
  if ((scene_.needs & PLUMB_NEED_COLLISION) == 0) return;
  std::vector<referee::PosedShape> posed(scene_.bodies.size());
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const SceneBody& body = scene_.bodies[i];
    if (!body.shape || (body.desc.flags & PLUMB_BODY_SENSOR) != 0) continue;
    const PoseRow& row = simulation.poses()[i];
    posed[i] = {shapes_[*body.shape].get(), referee::pose(row.position, row.orientation),
                body.desc.motion == PLUMB_DYNAMIC};
  }
  const auto may_touch = [&](std::uint32_t a, std::uint32_t b) {
    return plumb::may_touch(scene_.bodies[a].desc.filter, scene_.bodies[b].desc.filter) && !joined_.contains({a, b});
  };
  const referee::WorldPenetration found = referee::world_penetration(posed, may_touch);
  max_ = std::max(max_, found.max);
  p50_ = std::max(p50_, found.p50);
  p95_ = std::max(p95_, found.p95);
  p99_ = std::max(p99_, found.p99);
}

void Overlaps::add_to(std::vector<Metric>& metrics) const {
  if ((scene_.needs & PLUMB_NEED_COLLISION) == 0) return;
  const auto add = [&](const char* name, double depth, const char* note) {
    metrics.push_back({name, depth, 0.0, std::abs(depth), std::nullopt, note});
  };
  add("penetration_max", max_, "deepest overlap at sampled times, by the referee");
  add("penetration_p50", p50_, "worst median of overlaps at a sampled time");
  add("penetration_p95", p95_, "worst 95th percentile of overlaps at a sampled time");
  add("penetration_p99", p99_, "worst 99th percentile of overlaps at a sampled time");
}

}  // namespace plumb::harness
