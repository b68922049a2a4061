// The list of measures of robustness, and those of bullets and deep overlaps.

#include "measure/robustness/robustness.hpp"

#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"

namespace plumb::harness {
namespace {

/// The scene, which declares the need of continuous collision only in the cells that use it.
Scene with_ccd(Scene scene) {
  for (const SceneBody& body : scene.bodies)
    if ((body.desc.flags & PLUMB_BODY_CCD) != 0) scene.needs |= PLUMB_NEED_CCD;
  return scene;
}

void bullet(MeasureContext& context) {
  const Scene scene = with_ccd(context.scene());
  const std::vector<std::size_t> bullets = arg_bodies(scene, "bullets");
  const double wall = arg_number(scene, "wall");
  Simulation simulation = context.simulate(scene);
  simulation.run();
  double passed = 0, fastest = 0;
  for (const std::size_t body : bullets) {
    const double x = simulation.poses()[body].position.x;
    if (!(x <= wall)) ++passed;
    fastest = largest(fastest, referee::vec(simulation.velocities()[body].linear).norm());
  }
  context.deviation("passed", passed);
  const double speed = scene.bodies[bullets.front()].desc.linear_velocity.x;
  context.deviation("speed_after", fastest / speed);
}

void deep_overlap(MeasureContext& context) {
  constexpr double side = 1, clear = 0.01, g = 9.81;  // m, of a side, and what energies are measured against
  const Scene& scene = context.scene();
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  const referee::Vec3 gravity = referee::vec(scene.gravity);
  const double mass = view.masses().back().mass;
  double most = 0, fastest = 0, momentum = 0, cleared = not_measured;
  simulation.run([&](Simulation& now) {
    const std::vector<referee::BodyState> states = view.states(now);
    most = largest(most, referee::energy(states, gravity).kinetic());
    for (const referee::BodyState& state : states) fastest = largest(fastest, state.linear.norm());
    momentum = largest(momentum, referee::linear_momentum(states).norm());
    if (!(view.penetration(now.poses()).max < clear * side))
      cleared = not_measured;
    else if (std::isnan(cleared))
      cleared = now.time();
  });
  context.deviation("kinetic_energy", most / (mass * g * side));
  context.deviation("speed", fastest);
  context.deviation("clear_time", cleared);
  if (gravity.norm() == 0) context.deviation("momentum", momentum / (mass * std::sqrt(g * side)));
}

}  // namespace

std::span<const MeasureEntry> robustness_measures() {
  using enum ArgumentType;
  static constexpr MeasureArgument bullet_args[] = {{"bullets", bodies}, {"wall", number}};
  static constexpr MeasureArgument factor_args[] = {{"factor", number}};
  static constexpr MeasureArgument offset_args[] = {{"offset", number}};
  static constexpr MeasureArgument turn_args[] = {{"axis", numbers}, {"angle", number}};
  static constexpr MeasureArgument repeat_args[] = {{"orders", number}};
  static constexpr MeasureArgument edges_args[] = {
      {"bodies", bodies}, {"friction", number}, {"speed", number}, {"slides", number}};
  static constexpr MeasureArgument velocity_args[] = {{"velocity", numbers}};
  static constexpr MeasureArgument rod_args[] = {
      {"rods", bodies}, {"half_length", number}, {"wall", number}, {"thickness", number}};
  static constexpr MeasureArgument stack_args[] = {{"bullet", body}, {"boxes", bodies}};
  static constexpr MeasureArgument press_args[] = {
      {"lower", body}, {"upper", body}, {"box", body}, {"squeeze", number}};
  static constexpr MeasureArgument reversal_args[] = {{"size", number}, {"pendulum", number}};
  static constexpr MeasureArgument size_args[] = {{"size", number}};
  static constexpr MeasureArgument nudge_args[] = {{"size", number}, {"nudge", number}, {"seeds", number}};
  static constexpr MeasureArgument bystanders_args[] = {{"bystanders", bodies}, {"size", number}};
  static constexpr MeasureEntry entries[] = {
      {"bullet", "bodies that passed through a thin wall", bullet_args, bullet},
      {"spinning_rod", "rods that spin through a thin wall, and how deep they get", rod_args, measure_spinning_rod},
      {"bullet_stack", "momentum and order of what a bullet hits", stack_args, measure_bullet_stack},
      {"press", "how a cube leaves a press that gave it no room", press_args, measure_press},
      {"time_reversal", "a scene that runs back to its start", reversal_args, measure_time_reversal},
      {"deep_overlap", "how gently bodies that start in each other part", {}, deep_overlap},
      {"similarity", "a scene against itself made larger or smaller", factor_args, measure_similarity},
      {"mass_scaling", "a scene against itself made heavier or lighter", factor_args, measure_mass_scaling},
      {"translation", "a scene against itself far from the origin", offset_args, measure_translation},
      {"rotation", "a scene against itself turned, gravity too", turn_args, measure_rotation},
      {"galilean", "a scene against itself seen from a moving frame", velocity_args, measure_galilean},
      {"repeat", "a scene against itself run again, on more threads, and in another order", repeat_args,
       measure_repeat},
      {"mirror", "a scene against itself in a mirror", size_args, measure_mirror},
      {"self_convergence", "order in which a scene converges with shorter steps", size_args, measure_self_convergence},
      {"predictability", "how far ends spread that begin a hair apart", nudge_args, measure_predictability},
      {"bystanders", "a scene against itself without bodies that nothing touches", bystanders_args, measure_bystanders},
      {"inner_edges", "bodies that slide or roll over the edges within a plane", edges_args, measure_inner_edges},
      {"bad_input", "whether bad arguments of every kind are refused by name and harm nothing", {}, measure_bad_input},
  };
  return entries;
}

}  // namespace plumb::harness
