#include "measure/instruments/standing.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::harness {

bool in_last_second(Simulation& simulation) {
  return simulation.time() > simulation.scene().seconds - 1 + simulation.scene().dt / 2;
}

double distance_from_start(const Scene& scene, std::span<const PoseRow> poses, std::size_t body) {
  return (referee::vec(poses[body].position) - referee::vec(scene.bodies[body].desc.pose.position)).norm();
}

double tilt_of(const PoseRow& pose) {
  return std::acos(std::clamp((referee::quat(pose.orientation) * referee::Vec3::UnitY()).y(), -1.0, 1.0));
}

void add_survival(MeasureContext& context, const Survival& survival, double seconds) {
  context.expect("stands", survival.whole(), true);
  context.compare("survival", survival.time(), seconds, seconds);
}

void add_ground_force(MeasureContext& context, const ImpulseAccount& account, double total_mass) {
  const referee::Vec3 weight = total_mass * referee::vec(context.scene().gravity);
  context.add({"ground_force", account.from_ground().norm(), weight.norm(),
               (account.from_ground() + weight).norm() / weight.norm(), std::nullopt, ""});
}

}  // namespace plumb::harness
