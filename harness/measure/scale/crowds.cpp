// Measure of many bodies that only keep laws, no trajectory: rain, heaps, a ring of bricks under fire, a drum.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/scale/scale.hpp"

namespace plumb::harness {
namespace {

bool has(const Scene& scene, const char* argument) { return scene.measure_args.contains(argument); }

/// What a scene file cannot say: waves on its flat mesh.
Scene with_waves(Scene scene, double height) {
  for (SceneShape& shape : scene.shapes)
    if (shape.desc.type == PLUMB_TRIANGLE_MESH)
      for (std::size_t i = 0; i + 2 < shape.vertices.size(); i += 3)
        shape.vertices[i + 1] = height * std::sin(shape.vertices[i]) * std::cos(shape.vertices[i + 2]);
  return scene;
}

/// What the host does before each step: turns a drum about z, sends a ball along x.
class Host {
 public:
  Host(const Scene& scene, const RefereeView& view) {
    if (has(scene, "drum")) drum_ = {true, arg_body(scene, "drum"), arg_number(scene, "rate")};
    if (has(scene, "launch")) {
      ball_ = {true, arg_body(scene, "launch"), arg_number(scene, "speed")};
      launch_ = arg_number(scene, "launch_time");
      momentum_ = view.masses()[ball_.body].mass * ball_.rate;
    }
  }

  void before_step(Simulation& simulation) {
    const double dt = simulation.scene().dt;
    if (drum_.there) {
      const double half = drum_.rate * (simulation.time() + dt) / 2;
      simulation.write(PLUMB_FIELD_KINEMATIC_TARGET, drum_.body,
                       std::array<double, 7>{0, 0, 0, 0, 0, std::sin(half), std::cos(half)});
    }
    if (!launches(simulation)) return;
    simulation.write(PLUMB_FIELD_IMPULSE, ball_.body, std::array<double, 3>{momentum_, 0, 0});
  }

  [[nodiscard]] bool launches(const Simulation& simulation) const {
    return ball_.there && std::abs(simulation.time() - launch_) < simulation.scene().dt / 2;
  }
  [[nodiscard]] bool works() const { return drum_.there || ball_.there; }

 private:
  struct Driven {
    bool there = false;
    std::size_t body = 0;
    double rate = 0;  ///< rad/s or m/s
  };
  Driven drum_, ball_;
  double launch_ = 0, momentum_ = 0;  ///< s, N s
};

/// Share of these bodies within a quarter metre of their places.
double in_place(const Simulation& simulation, const std::vector<std::size_t>& bodies) {
  constexpr double near = 0.25;  // m
  const auto count = std::count_if(bodies.begin(), bodies.end(), [&](std::size_t body) {
    const referee::Vec3 start = referee::vec(simulation.scene().bodies[body].desc.pose.position);
    return (referee::vec(simulation.poses()[body].position) - start).norm() <= near;
  });
  return static_cast<double>(count) / static_cast<double>(bodies.size());
}

/// Whether a moving body is where it may be: above the floor and within reach of the middle, or inside the drum.
bool is_inside(const Scene& scene, const PlumbVec3& p) {
  const double reach = arg_number(scene, "reach");
  if (!(std::abs(p.x) <= reach && std::abs(p.y) <= reach && std::abs(p.z) <= reach)) return false;
  if (has(scene, "drum"))
    return std::hypot(p.x, p.y) <= arg_number(scene, "radius") / std::cos(0.2) &&
           std::abs(p.z) <= arg_number(scene, "length") / 2;
  return p.y > (has(scene, "floor") ? arg_number(scene, "floor") : 0);
}

/// m g h of all moving bodies above the lowest one, and what a fall by their mean size is worth: a scale that is not 0.
double energy_scale(const Scene& scene, const RefereeView& view, double size) {
  double lowest = std::numeric_limits<double>::infinity(), sum = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (view.masses()[i].mass > 0) lowest = std::min(lowest, scene.bodies[i].desc.pose.position.y);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    sum += view.masses()[i].mass * (scene.bodies[i].desc.pose.position.y - lowest + size);
  return sum * std::abs(scene.gravity.y);
}

}  // namespace

void measure_crowd(MeasureContext& context) {
  Scene scene = context.scene();
  if (has(scene, "wave")) scene = with_waves(scene, arg_number(scene, "wave"));
  const double size = arg_number(scene, "size");
  const RefereeView view(scene);
  const double scale = energy_scale(scene, view, size);
  Simulation simulation = context.simulate(scene);
  std::optional<Simulation> twin;
  if (has(scene, "repeat")) twin.emplace(context.simulate(scene));
  std::vector<std::size_t> stack;
  if (has(scene, "stack")) stack = arg_bodies(scene, "stack");
  Host host(scene, view);
  referee::EnergyAccount energy;
  energy.add(view.energy(simulation).total());
  double gap = 0, standing = not_measured;
  bool same = true;
  while (true) {
    if (host.launches(simulation)) standing = in_place(simulation, stack);
    host.before_step(simulation);
    if (!simulation.advance()) break;
    if (twin) same = twin->advance() && same && twin->state_hash() == simulation.state_hash();
    if (!host.works()) energy.add(view.energy(simulation).total());
    if (!scene.joints.empty()) gap = largest(gap, view.joint_gap(simulation.poses()));
  }

  const std::span<const PoseRow> poses = simulation.poses();
  context.expect("finite", simulation.finite(), true);
  const DepthSummary depth = depth_summary(view.penetration(poses));
  context.deviation("depth_max", depth.max / size);
  context.deviation("depth_p99", depth.p99 / size);
  double escaped = 0, height = 0, moving = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (scene.bodies[i].desc.motion != PLUMB_DYNAMIC) continue;
    if (!is_inside(scene, poses[i].position)) ++escaped;
    height += poses[i].position.y;
    ++moving;
  }
  context.deviation("escaped", escaped);
  if (!host.works()) context.deviation("energy_injected", energy.injected() / scale);
  context.deviation("kinetic_energy", view.energy(simulation).kinetic() / scale);
  context.add({"mean_height", height / moving, std::nullopt, 0, std::nullopt, ""});
  context.add({"contacts", static_cast<double>(simulation.report().contacts), std::nullopt, 0, std::nullopt, ""});
  if (!stack.empty()) context.compare("standing", standing, 1, 1);
  if (twin) context.expect("repeats", same, true);
  if (scene.joints.empty()) return;
  context.deviation("gap", gap / size);
  context.deviation("gap_end", view.joint_gap(poses) / size);
}

}  // namespace plumb::harness
