#include "cell/general_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "measure/instruments/contact_laws.hpp"
#include "measure/instruments/drift.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/reference_score.hpp"
#include "referee/world_penetration.hpp"
#include "simulation/scene_nature.hpp"

namespace plumb::harness {

namespace {

constexpr std::uint64_t energy_samples = 250;
constexpr std::uint64_t overlap_samples = 10;
constexpr std::size_t many_bodies = 3000;  // from here on overlaps are looked for twice only: they cost seconds

}  // namespace

struct GeneralMetrics::State {
  explicit State(Simulation& simulation) : laws(simulation), reference(simulation) {}

  SceneNature nature;
  std::vector<referee::ShapePtr> shapes;
  std::vector<referee::Mass> masses;
  std::set<std::pair<std::uint32_t, std::uint32_t>> joined;  ///< bodies that a joint keeps from touching
  ContactLaws laws;
  ReferenceScore reference;
  std::uint64_t energy_stride = 1, overlap_stride = 1;

  referee::EnergyAccount energy;
  double kinetic_max = 0, potential_low = 0, potential_high = 0;
  bool energy_known = false;
  referee::Vec3 momentum_start = referee::Vec3::Zero();
  double momentum_sum = 0, momentum_drift = 0;
  double depth_max = 0, depth_p50 = 0, depth_p95 = 0, depth_p99 = 0;
  JointDrift joints;

  void sample_energy(Simulation& simulation);
  void sample_geometry(Simulation& simulation);
};

void GeneralMetrics::State::sample_energy(Simulation& simulation) {
  const auto states = referee::body_states<PoseRow, VelocityRow>(masses, simulation.poses(), simulation.velocities());
  const referee::Energy now = referee::energy(states, referee::vec(simulation.scene().gravity));
  energy.add(now.total());
  kinetic_max = std::max(kinetic_max, now.kinetic());
  potential_low = energy_known ? std::min(potential_low, now.potential) : now.potential;
  potential_high = energy_known ? std::max(potential_high, now.potential) : now.potential;
  const referee::Vec3 momentum = referee::linear_momentum(states);
  if (!energy_known) momentum_start = momentum;
  momentum_sum = std::max(momentum_sum, referee::sum_of_momenta(states));
  momentum_drift = std::max(momentum_drift, (momentum - momentum_start).norm());
  energy_known = true;
}

void GeneralMetrics::State::sample_geometry(Simulation& simulation) {
  const Scene& scene = simulation.scene();
  if ((scene.needs & PLUMB_NEED_COLLISION) == 0) return;
  std::vector<referee::PosedShape> posed(scene.bodies.size());
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    if (!body.shape || (body.desc.flags & PLUMB_BODY_SENSOR) != 0) continue;
    const PoseRow& row = simulation.poses()[i];
    posed[i] = {shapes[*body.shape].get(), referee::pose(row.position, row.orientation),
                body.desc.motion == PLUMB_DYNAMIC};
  }
  const auto may_touch = [&](std::uint32_t a, std::uint32_t b) {
    return plumb::may_touch(scene.bodies[a].desc.filter, scene.bodies[b].desc.filter) && !joined.contains({a, b});
  };
  const referee::WorldPenetration found = referee::world_penetration(posed, may_touch);
  depth_max = std::max(depth_max, found.max);
  depth_p50 = std::max(depth_p50, found.p50);
  depth_p95 = std::max(depth_p95, found.p95);
  depth_p99 = std::max(depth_p99, found.p99);
}

GeneralMetrics::GeneralMetrics(Simulation& simulation) : state_(std::make_unique<State>(simulation)) {
  State& s = *state_;
  const Scene& scene = simulation.scene();
  s.nature = nature_of(scene);
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) s.shapes.push_back(shape_of(scene, i));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    s.masses.push_back(referee::mass_of(body.desc, body.shape ? s.shapes[*body.shape].get() : nullptr));
  }
  for (const SceneJoint& joint : scene.joints) {
    if (!joint.body_a || joint.desc.collide_connected != 0) continue;
    const auto [low, high] =
        std::minmax({static_cast<std::uint32_t>(*joint.body_a), static_cast<std::uint32_t>(joint.body_b)});
    s.joined.insert({low, high});
  }
  const auto steps = static_cast<std::uint64_t>(std::max(1.0, scene.seconds / scene.dt));
  s.energy_stride = std::max<std::uint64_t>(1, steps / energy_samples);
  s.overlap_stride =
      scene.bodies.size() > many_bodies ? steps + 1 : std::max<std::uint64_t>(1, steps / overlap_samples);
  s.sample_energy(simulation);
  s.sample_geometry(simulation);
  s.joints.add(scene, simulation.poses(), 0);
  if (s.overlap_stride == 1) {
    s.laws.before_step(simulation);
    s.reference.before_step(simulation);
  }
}

GeneralMetrics::~GeneralMetrics() = default;

void GeneralMetrics::stepped(Simulation& simulation) {
  State& s = *state_;
  if (simulation.steps() % s.energy_stride == 0) {
    s.sample_energy(simulation);
    s.joints.add(simulation.scene(), simulation.poses(), simulation.time());
  }
  if (simulation.steps() % s.overlap_stride == 0) {
    s.sample_geometry(simulation);
    s.laws.after_step(simulation);
    s.reference.after_step(simulation);
  }
  if ((simulation.steps() + 1) % s.overlap_stride == 0) {
    s.laws.before_step(simulation);
    s.reference.before_step(simulation);
  }
}

std::vector<Metric> GeneralMetrics::finish(Simulation& simulation) {
  State& s = *state_;
  const Scene& scene = simulation.scene();
  std::vector<Metric> metrics;
  if (simulation.steps() == 0) return metrics;
  const auto add = [&](const char* name, double value, const std::string& note) {
    metrics.push_back({name, value, 0.0, std::abs(value), std::nullopt, note});
  };
  if (simulation.steps() % s.overlap_stride != 0) s.sample_geometry(simulation);
  if ((scene.needs & PLUMB_NEED_COLLISION) != 0) {
    add("penetration_max", s.depth_max, "deepest overlap at sampled times, by the referee");
    add("penetration_p50", s.depth_p50, "worst median of overlaps at a sampled time");
    add("penetration_p95", s.depth_p95, "worst 95th percentile of overlaps at a sampled time");
    add("penetration_p99", s.depth_p99, "worst 99th percentile of overlaps at a sampled time");
  }
  const double reference = s.kinetic_max + (s.potential_high - s.potential_low);
  const std::string every = s.energy_stride == 1 ? "every step" : "every " + std::to_string(s.energy_stride) + " steps";
  if (reference > 0 && !s.nature.driven && !s.nature.stores) {
    add("energy_injected", s.energy.injected() / reference,
        "of the largest kinetic energy and potential range, sampled " + every);
    if (!s.nature.dissipates) add("energy_drift", s.energy.drift() / reference, "of the same reference");
  }
  if (s.nature.closed && s.momentum_sum > 0)
    add("momentum_drift", s.momentum_drift / s.momentum_sum, "largest, of the sum of all momenta");
  if (!scene.joints.empty()) {
    add("joint_gap_max", s.joints.gap_max(), "largest at sampled times");
    add("joint_gap_rms", s.joints.gap_rms(), "of all joints at sampled times");
    add("joint_gap_slope", s.joints.gap_slope(), "growth of the worst gap");
    add("joint_angle_max", s.joints.angle_max(), "largest locked angle at sampled times");
    add("joint_limit_max", s.joints.limit_max(), "beyond a limit, rad or m");
  }
  s.laws.add_to(metrics);
  s.reference.add_to(metrics);
  if (simulation.statistics().solver_fallbacks > 0)
    add("solver_fallbacks", static_cast<double>(simulation.statistics().solver_fallbacks),
        "steps that another solver finished");
  if (simulation.statistics().energy_bounded > 0)
    add("energy_bounded", static_cast<double>(simulation.statistics().energy_bounded),
        "steps that would have made energy, and were solved again finer or had it taken out");
  return metrics;
}

std::vector<MetricSpec> general_metric_specs() {
  std::vector<MetricSpec> specs;
  for (const auto& [name, unit] : {std::pair{"penetration_max", "m"},
                                   {"penetration_p50", "m"},
                                   {"penetration_p95", "m"},
                                   {"penetration_p99", "m"},
                                   {"energy_injected", "1"},
                                   {"energy_drift", "1"},
                                   {"momentum_drift", "1"},
                                   {"joint_gap_max", "m"},
                                   {"joint_gap_rms", "m"},
                                   {"joint_gap_slope", "m/s"},
                                   {"joint_angle_max", "rad"},
                                   {"joint_limit_max", "1"},
                                   {"solver_fallbacks", "1"},
                                   {"energy_bounded", "1"}})
    specs.push_back({name, unit, "", std::nullopt, std::nullopt});
  for (const std::vector<MetricSpec>& more : {ContactLaws::specs(), ReferenceScore::specs()})
    specs.insert(specs.end(), more.begin(), more.end());
  return specs;
}

}  // namespace plumb::harness
