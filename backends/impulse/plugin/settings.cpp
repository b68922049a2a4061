#include "plugin/settings.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::impulse {

namespace {

/// No sub-step is longer than in a step of this length, s, whatever the steps in which a host asks for them. Of what is
/// left over, in sub-steps, so much is spread over the others, lest a clock of 59.94 Hz have one more; and no step has
/// more than so many.
constexpr double kSettingsStep = 1.0 / 60, kSpread = 0.2, kMostInStep = 256;

/// Errors of long mechanisms are taken back as these say, however short the sub-steps: all of it in one would pluck
/// what is taut, and whips would crack.
constexpr double kChainHertz = 240, kChainDampingRatio = 10;

/// Stiffness of contacts by default, in 1 over the sub-step, and how much more it is where one body does not move. A
/// sub-step has one sweep over the contacts, which takes a motion of many bodies at once, x, only the share m of the
/// way to rest. With w = 2 pi kContactRate and the leak l of the softness such a motion follows x''' + (m + l) x'' + m
/// x' + m l w^2 x = 0, time counted in sub-steps, and swings up where w^2 > 1 + m / l (Routh and Hurwitz), whatever the
/// damping ratio: a quarter shakes pyramids of seven rows and more. Pyramids of 5 to 30 rows come to rest at this one.
constexpr double kContactRate = 0.1875, kGroundStiffness = 1.5;
/// The same between unlike masses, and where one body does not move, in steps whose loads ask for more sub-steps. There
/// m is small, for a light body passes on little of what a heavy one needs, and nothing but w^2 < 1 keeps a heavy box
/// from rocking on a light one for ever.
constexpr double kLoadedContactRate = 0.1;
/// Relaxing passes of a sub-step where many heavy bodies lie on a light one: a small star, and a large one
/// (solver/stars.hpp).
constexpr std::uint32_t kRelaxationsOfStars[] = {8, 24};

/// In the order of SolverKind.
constexpr const char* kSolvers[] = {"tgs_soft", "si", "jacobi", "xpbd"};
/// In the order of BroadPhase::Method.
constexpr const char* kBroadPhases[] = {"lbvh", "sweep", "grid"};
constexpr const char* kRelaxations[] = {"substep", "step"};
constexpr const char* kJointSolvers[] = {"auto", "iterative"};

}  // namespace

const backend::SettingsTable<Settings>& settings_table() {
  using S = Settings;
  using namespace backend;
  constexpr auto quality = PLUMB_ROLE_QUALITY, behaviour = PLUMB_ROLE_BEHAVIOUR;
  static const SettingsTable<Settings> all = {
      setting<&S::solver>(choice_setting(
          "solver", behaviour, kSolvers,
          "tgs_soft: soft constraints in sub-steps; si: sequential impulses, the step whole; jacobi: likewise, all "
          "at once on split bodies; xpbd: positions in sub-steps")),
      setting<&S::substeps>(int_setting(
          "substeps", "1", quality, 1, 256, 8,
          "tgs_soft, xpbd: parts of a step in which velocities are solved and positions moved; a step of more "
          "than 1/60 s has as many as make them no longer than those of one of 1/60 s")),
      setting<&S::most_substeps>(int_setting(
          "most_substeps", "1", quality, 1, 256, 128,
          "tgs_soft: sub-steps are doubled, up to so many, while loads ask for it (longer steps have more likewise): "
          "what is much heavier than what it lies on, machines under load. Only where it is asked, body by body and "
          "what they touch; islands of hundreds of contacts and more get fewer. No more than substeps: never")),
      setting<&S::relaxes_once>(choice_setting(
          "relaxation", behaviour, kRelaxations,
          "tgs_soft: when contacts lose the speed that taking back overlap gave them: in each sub-step, or once at "
          "the end of a step, which leaves time for more sub-steps: high stacks of stiffer contacts")),
      setting<&S::joints_one_by_one>(choice_setting(
          "joint_solver", behaviour, kJointSolvers,
          "tgs_soft: auto: the joints of a mechanism all at once, exactly, and contacts that know of them, but of nets "
          "whose matrix would fill one by one; iterative: all one by one, once in a sub-step: a fraction of the time, "
          "gaps of centimetres, and only light loads")),
      setting<&S::iterations>(int_setting("iterations", "1", quality, 1, kMostPasses, 10,
                                          "si, jacobi: passes over all constraints in a step, at most")),
      setting<&S::stop_below>(float_setting(
          "stop_below", "1", behaviour, 0, 1, 1e-5,
          "si, jacobi: passes end when no impulse changes by more than this share of the largest; 0: never")),
      setting<&S::bias>(
          float_setting("bias", "1", behaviour, 0, 1, 0.2,
                        "si, jacobi: share of the overlap beyond the slop that a step takes back; 0: none")),
      setting<&S::slop>(float_setting("slop", "m", behaviour, 0, 1e6, 0.01, "si, jacobi: overlap that is let be")),
      setting<&S::contact_hertz>(float_setting(
          "contact_hertz", "1/s", behaviour, 0, 1e5, 0,
          "stiffness of contacts against overlap, half as much again against what does not move; 0: three sixteenths "
          "of the sub-steps a second, the most at which stacks come to rest")),
      setting<&S::contact_damping_ratio>(float_setting("contact_damping_ratio", "1", behaviour, 0, 1000, 50,
                                                       "how slowly overlap is taken back: 1 is critical damping")),
      setting<&S::joint_hertz>(float_setting(
          "joint_hertz", "1/s", behaviour, 0, 1e5, 0,
          "stiffness of joints against drift; 0: all of it is taken back in a sub-step, of chains of eight joints and "
          "more as at 240; of joints that are solved one by one a quarter of the sub-steps a second")),
      setting<&S::joint_damping_ratio>(float_setting("joint_damping_ratio", "1", behaviour, 0, 1000, 10,
                                                     "how slowly drift of joints is taken back")),
      setting<&S::push_speed>(
          float_setting("push_speed", "m/s", behaviour, 0, 1e6, 3, "overlap is taken back no faster than this")),
      setting<&S::restitution_speed>(
          float_setting("restitution_speed", "m/s", behaviour, 0, 1e6, 0.1, "slower impacts do not bounce")),
      setting<&S::warm_starting>(
          bool_setting("warm_starting", behaviour, true, "start from the impulses of the last step")),
      setting<&S::sleep_speed>(float_setting("sleep_speed", "m/s", behaviour, 0, 1e6, 0.05,
                                             "a body with less kinetic energy than at this speed rests")),
      setting<&S::sleep_time>(float_setting("sleep_time", "s", behaviour, 0, 1e6, 0.5,
                                            "an island whose bodies have all rested for so long falls asleep")),
      setting<&S::broad_phase>(choice_setting(
          "broad_phase", PLUMB_ROLE_SPEED, kBroadPhases,
          "how bodies that move are found near each other: lbvh: a tree; sweep: sort and sweep on one axis; grid: "
          "cells as wide as the common body. All give the same bits; the tree was the fastest wherever measured"))};
  return all;
}

double Settings::substep(double dt, std::uint32_t parts) const {
  return solver == SolverKind::kSequential || solver == SolverKind::kJacobi ? dt : dt / parts;
}

std::uint32_t Settings::substeps_in(double whole) const {
  const double parts = std::ceil(whole / kSettingsStep * substeps - kSpread);
  return std::max(substeps, static_cast<std::uint32_t>(std::min(parts, kMostInStep)));
}

SubstepParameters Settings::of_substep(double dt, std::uint32_t parts, double last_h, double whole) const {
  const double h = substep(dt, parts), ratio = last_h == 0 ? 1 : h / last_h;
  SubstepParameters of{};
  of.substeps = parts;
  of.relaxations = 1;
  of.h = static_cast<Real>(h);
  of.inverse_h = static_cast<Real>(1 / h);
  const double whole_h = substep(whole, parts), rate = parts > substeps_in(whole) ? kLoadedContactRate : kContactRate;
  const double hertz = contact_hertz > 0 ? contact_hertz : rate / whole_h;
  of.contact = make_softness(contact_hertz > 0 ? contact_hertz : kContactRate / whole_h, contact_damping_ratio, h);
  of.loaded = make_softness(hertz, contact_damping_ratio, h);
  of.ground = make_softness(kGroundStiffness * hertz, contact_damping_ratio, h);
  of.joint = make_softness(joint_hertz > 0 ? joint_hertz : 0.25 / h, joint_damping_ratio, h);
  of.joint_rate = joint_hertz > 0 ? of.joint.bias_rate : of.inverse_h;
  if (dt < whole) of.joint_rate = std::min(of.joint_rate, static_cast<Real>(1 / whole));
  of.chain_rate = joint_hertz > 0 ? of.joint_rate : make_softness(kChainHertz, kChainDampingRatio, h).bias_rate;
  of.warm_start = static_cast<Real>(warm_starting && last_h != 0 ? ratio : 0);
  of.shortened = static_cast<Real>(ratio * ratio);
  return of;
}

StepParameters Settings::parameters(double dt, const PlumbVec3& gravity, const SubstepLevels& levels) const {
  StepParameters step{};
  static_cast<SubstepParameters&>(step) = levels.of[0];
  step.gravity = {static_cast<Real>(gravity.x), static_cast<Real>(gravity.y), static_cast<Real>(gravity.z)};
  step.dt = static_cast<Real>(dt);
  step.max_depenetration_speed = static_cast<Real>(push_speed);
  step.relaxes_once = relaxes_once;
  step.warm_starting = warm_starting;
  step.sleep_speed = static_cast<Real>(sleep_speed);
  step.sleep_time = static_cast<Real>(sleep_time);
  step.restitution_speed = static_cast<Real>(restitution_speed);
  step.solver = solver;
  step.passes = iterations;
  step.stop_below = static_cast<Real>(stop_below);
  step.bias_rate = static_cast<Real>(bias / dt);
  step.slop = static_cast<Real>(slop);
  return step;
}

SubstepLevels Settings::levels(double dt, double last_h, double whole) const {
  SubstepLevels levels{};
  std::uint32_t factor = 2;  // larger where few levels would end far below the most
  while (substeps * factor * factor * factor * factor * 4 <= most_substeps) factor *= 2;
  static_assert(kSubstepLengths == 5);
  std::uint32_t parts = substeps_in(whole);
  const std::uint32_t most = parts * most_substeps / substeps;
  do {
    SubstepParameters& level = levels.of[levels.count];
    level = of_substep(dt, parts, last_h, whole);
    level.level = levels.count++;
    parts *= factor;
  } while (levels.count < kSubstepLengths && parts <= most);
  std::uint32_t star = kStarLevel;
  for (const std::uint32_t relaxations : kRelaxationsOfStars) {
    levels.of[star] = levels.of[0];
    levels.of[star].level = star;
    levels.of[star].relaxations = relaxations;
    ++star;
  }
  return levels;
}

}  // namespace plumb::impulse
