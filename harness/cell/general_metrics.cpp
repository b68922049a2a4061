#include "cell/general_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "measure/instruments/conservation.hpp"
#include "measure/instruments/contact_laws.hpp"
#include "measure/instruments/drift.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/overlaps.hpp"
#include "measure/instruments/reference_score.hpp"

namespace plumb::harness {

namespace {

constexpr std::uint64_t energy_samples = 250;
constexpr std::uint64_t overlap_samples = 10;
constexpr std::size_t many_bodies = 3000;  // from here on overlaps are looked for twice only: they cost seconds

std::vector<referee::ShapePtr> shapes_of(const Scene& scene) {
  std::vector<referee::ShapePtr> shapes;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) shapes.push_back(shape_of(scene, i));
  return shapes;
}

std::vector<referee::Mass> masses_of(const Scene& scene, const std::vector<referee::ShapePtr>& shapes) {
  std::vector<referee::Mass> masses;
  for (const SceneBody& body : scene.bodies)
    masses.push_back(referee::mass_of(body.desc, body.shape ? shapes[*body.shape].get() : nullptr));
  return masses;
}

}  // namespace

struct GeneralMetrics::State {
  explicit State(Simulation& simulation)
      : shapes(shapes_of(simulation.scene())),
        conservation(masses_of(simulation.scene(), shapes)),
        overlaps(simulation.scene(), shapes),
        laws(simulation),
        reference(simulation) {}

  std::vector<referee::ShapePtr> shapes;
  Conservation conservation;
  Overlaps overlaps;
  JointDrift joints;
  ContactLaws laws;
  ReferenceScore reference;
  std::uint64_t energy_stride = 1, overlap_stride = 1;
};

GeneralMetrics::GeneralMetrics(Simulation& simulation) : state_(std::make_unique<State>(simulation)) {
  State& s = *state_;
  const Scene& scene = simulation.scene();
  const auto steps = static_cast<std::uint64_t>(std::max(1.0, scene.seconds / scene.dt));
  s.energy_stride = std::max<std::uint64_t>(1, steps / energy_samples);
  s.overlap_stride =
      scene.bodies.size() > many_bodies ? steps + 1 : std::max<std::uint64_t>(1, steps / overlap_samples);
  s.conservation.add(simulation);
  s.overlaps.add(simulation);
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
    s.conservation.add(simulation);
    s.joints.add(simulation.scene(), simulation.poses(), simulation.time());
  }
  if (simulation.steps() % s.overlap_stride == 0) {
    s.overlaps.add(simulation);
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
  if (simulation.steps() % s.overlap_stride != 0) s.overlaps.add(simulation);
  s.overlaps.add_to(metrics);
  s.conservation.add_to(metrics, scene, s.energy_stride);
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
  if (simulation.statistics().steps_repeated > 0)
    add("steps_repeated", static_cast<double>(simulation.statistics().steps_repeated),
        "steps that the engine took back and went over again");
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
                                   {"energy_bounded", "1"},
                                   {"steps_repeated", "1"}})
    specs.push_back({name, unit, "", std::nullopt, std::nullopt});
  for (const std::vector<MetricSpec>& more : {ContactLaws::specs(), ReferenceScore::specs()})
    specs.insert(specs.end(), more.begin(), more.end());
  return specs;
}

}  // namespace plumb::harness
