// Measure of what must not matter: bodies that nothing ever touches, there or not there.
#include <algorithm>
#include <array>

#include "measure/instruments/args.hpp"
#include "measure/instruments/series.hpp"
#include "measure/robustness/robustness.hpp"
#include "referee/pose.hpp"

namespace plumb::harness {
namespace {

/// The scene without its last bodies, so that the others keep their indices.
Scene without_last(Scene scene, const std::vector<std::size_t>& bystanders) {
  const std::size_t kept = scene.bodies.size() - bystanders.size();
  const bool last = bystanders.front() == kept;  // their indices rise
  const bool held = std::any_of(scene.joints.begin(), scene.joints.end(), [&](const SceneJoint& joint) {
    return joint.body_b >= kept || joint.body_a.value_or(0) >= kept;
  });
  if (!last || held) throw UsageError("scene " + scene.id + ": bystanders are the last bodies and on no joint");
  scene.bodies.resize(kept);
  return scene;
}

bool same_numbers(const PoseRow& one, const PoseRow& other) {
  const auto numbers = [](const PoseRow& row) {
    const auto& [p, q] = row;
    return std::array<double, 7>{p.x, p.y, p.z, q.x, q.y, q.z, q.w};
  };
  return numbers(one) == numbers(other);
}

}  // namespace

void measure_bystanders(MeasureContext& context) {
  const Scene& scene = context.scene();
  const double size = arg_number(scene, "size");
  const Scene fewer = without_last(scene, arg_bodies(scene, "bystanders"));
  Simulation all = context.simulate(scene), alone = context.simulate(fewer);
  bool same = true;
  double worst = 0;
  while (all.advance() && alone.advance())
    for (std::size_t i = 0; i < fewer.bodies.size(); ++i) {
      const PoseRow &here = all.poses()[i], &there = alone.poses()[i];
      same = same && same_numbers(here, there);
      worst = largest(worst, (referee::vec(here.position) - referee::vec(there.position)).norm());
    }
  context.expect("same", same, true);
  context.deviation("deviation", worst / size);
}

}  // namespace plumb::harness
