#include "plugin/settings.hpp"

#include <cstring>
#include <iterator>
#include <string>
#include <vector>

#include "exec/memory.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::impulse {

namespace {

struct Row {
  PlumbSettingInfo info;
  double Settings::*member;
};

Row number(const char* name, PlumbSettingType type, PlumbSettingRole role, double least, double most, double standard,
           const char* unit, double Settings::*member, const char* doc) {
  Row row{};
  row.member = member;
  row.info.name = name;
  row.info.unit = unit;
  row.info.doc = doc;
  row.info.type = type;
  row.info.role = role;
  row.info.minimum = least;
  row.info.maximum = most;
  row.info.default_value.type = type;
  row.info.default_value.number = standard;
  return row;
}

/// Errors of long mechanisms are taken back as these say, however short the sub-steps: all of it in one would pluck
/// what is taut, and whips would crack.
constexpr double kChainHertz = 240, kChainDampingRatio = 10;

/// Stiffness of contacts by default, in 1 over the sub-step, and how much more it is where one body does not move. A
/// sub-step has one sweep over the contacts, which takes a motion of many bodies at once, x, only the share m of the
/// way to rest. With w = 2 pi kContactRate and the leak l of the softness such a motion follows x''' + (m + l) x'' + m
/// x' + m l w^2 x = 0, time counted in sub-steps, and swings up where w^2 > 1 + m / l (Routh and Hurwitz), whatever the
/// damping ratio: a quarter shakes pyramids of seven rows and more. Pyramids of 5 to 30 rows come to rest at this one.
constexpr double kContactRate = 0.1875, kGroundStiffness = 1.5;

/// In the order of SolverKind.
constexpr const char* kSolvers[] = {"tgs_soft", "si", "jacobi", "xpbd"};
/// In the order of BroadPhase::Method.
constexpr const char* kBroadPhases[] = {"lbvh", "sweep", "grid"};
constexpr const char* kRelaxations[] = {"substep", "step"};

Row choice(const char* name, PlumbSettingRole role, std::span<const char* const> words, double Settings::*member,
           const char* doc) {
  Row row = number(name, PLUMB_SETTING_CHOICE, role, 0, 0, 0, "", member, doc);
  row.info.choices = words.data();
  row.info.choice_count = static_cast<std::uint32_t>(words.size());
  row.info.default_value.choice = words[0];
  return row;
}

const std::vector<Row>& rows() {
  using S = Settings;
  constexpr auto real = PLUMB_SETTING_FLOAT, whole = PLUMB_SETTING_INT, flag = PLUMB_SETTING_BOOL;
  constexpr auto quality = PLUMB_ROLE_QUALITY, behaviour = PLUMB_ROLE_BEHAVIOUR;
  static const std::vector<Row> all = {
      choice("solver", behaviour, kSolvers, &S::solver,
             "tgs_soft: soft constraints in sub-steps; si: sequential impulses, the step whole; jacobi: likewise, all "
             "at once on split bodies; xpbd: positions in sub-steps"),
      number("substeps", whole, quality, 1, 256, 8, "1", &S::substeps,
             "tgs_soft, xpbd: parts of a step in which velocities are solved and positions moved"),
      choice("relaxation", behaviour, kRelaxations, &S::relaxation,
             "tgs_soft: when contacts lose the speed that taking back overlap gave them: in each sub-step, or once at "
             "the end of a step, which leaves time for more sub-steps: high stacks of stiffer contacts"),
      number("iterations", whole, quality, 1, kMostPasses, 10, "1", &S::iterations,
             "si, jacobi: passes over all constraints in a step, at most"),
      number("stop_below", real, behaviour, 0, 1, 1e-5, "1", &S::stop_below,
             "si, jacobi: passes end when no impulse changes by more than this share of the largest; 0: never"),
      number("bias", real, behaviour, 0, 1, 0.2, "1", &S::bias,
             "si, jacobi: share of the overlap beyond the slop that a step takes back; 0: none"),
      number("slop", real, behaviour, 0, 1e6, 0.01, "m", &S::slop, "si, jacobi: overlap that is let be"),
      number(
          "contact_hertz", real, behaviour, 0, 1e5, 0, "1/s", &S::contact_hertz,
          "stiffness of contacts against overlap, half as much again against what does not move; 0: three sixteenths "
          "of the sub-steps a second, the most at which stacks come to rest"),
      number("contact_damping_ratio", real, behaviour, 0, 1000, 50, "1", &S::contact_damping_ratio,
             "how slowly overlap is taken back: 1 is critical damping"),
      number(
          "joint_hertz", real, behaviour, 0, 1e5, 0, "1/s", &S::joint_hertz,
          "stiffness of joints against drift; 0: all of it is taken back in a sub-step, of chains of eight joints and "
          "more as at 240; of joints that are solved one by one a quarter of the sub-steps a second"),
      number("joint_damping_ratio", real, behaviour, 0, 1000, 10, "1", &S::joint_damping_ratio,
             "how slowly drift of joints is taken back"),
      number("push_speed", real, behaviour, 0, 1e6, 3, "m/s", &S::push_speed,
             "overlap is taken back no faster than this"),
      number("restitution_speed", real, behaviour, 0, 1e6, 0.1, "m/s", &S::restitution_speed,
             "slower impacts do not bounce"),
      number("warm_starting", flag, behaviour, 0, 1, 1, "", &S::warm_starting,
             "start from the impulses of the last step"),
      number("sleep_speed", real, behaviour, 0, 1e6, 0.05, "m/s", &S::sleep_speed,
             "a body with less kinetic energy than at this speed rests"),
      number("sleep_time", real, behaviour, 0, 1e6, 0.5, "s", &S::sleep_time,
             "an island whose bodies have all rested for so long falls asleep"),
      choice("broad_phase", PLUMB_ROLE_SPEED, kBroadPhases, &S::broad_phase,
             "how bodies that move are found near each other: lbvh: a tree; sweep: sort and sweep on one axis; grid: "
             "cells as wide as the common body. All give the same bits; the tree was the fastest wherever measured"),
  };
  return all;
}

const Row& row(const char* name) {
  for (const Row& r : rows())
    if (std::string_view(r.info.name) == name) return r;
  throw Error(PLUMB_E_INTERNAL, std::string("impulse has no setting ") + name);
}

}  // namespace

std::span<const PlumbSettingInfo> setting_infos() {
  static const std::vector<PlumbSettingInfo> infos = [] {
    std::vector<PlumbSettingInfo> list;
    for (const Row& r : rows()) list.push_back(r.info);
    return list;
  }();
  return infos;
}

PlumbSettingValue Settings::get(const char* name) const {
  const Row& r = row(name);
  PlumbSettingValue value{r.info.type, 0, this->*r.member, nullptr};
  if (r.info.type != PLUMB_SETTING_CHOICE) return value;
  value.choice = r.info.choices[static_cast<std::size_t>(value.number)];
  value.number = 0;
  return value;
}

void Settings::set(const char* name, const PlumbSettingValue& value) {
  const Row& r = row(name);
  this->*r.member = value.number;
  if (r.info.type != PLUMB_SETTING_CHOICE) return;
  for (std::uint32_t i = 0; i < r.info.choice_count; ++i)
    if (std::strcmp(r.info.choices[i], value.choice) == 0) this->*r.member = i;
}

double Settings::substep(double dt) const {
  const auto kind = static_cast<SolverKind>(solver);
  return kind == SolverKind::kSequential || kind == SolverKind::kJacobi ? dt : dt / substeps;
}

StepParameters Settings::parameters(double dt, double last_h, const PlumbVec3& gravity) const {
  const double h = substep(dt);
  StepParameters step{};
  step.gravity = {static_cast<Real>(gravity.x), static_cast<Real>(gravity.y), static_cast<Real>(gravity.z)};
  step.dt = static_cast<Real>(dt);
  step.h = static_cast<Real>(h);
  step.inverse_h = static_cast<Real>(1 / h);
  step.substeps = static_cast<std::uint32_t>(substeps);
  const double hertz = contact_hertz > 0 ? contact_hertz : kContactRate / h;
  step.contact = make_softness(hertz, contact_damping_ratio, h);
  step.ground = make_softness(kGroundStiffness * hertz, contact_damping_ratio, h);
  step.joint = make_softness(joint_hertz > 0 ? joint_hertz : 0.25 / h, joint_damping_ratio, h);
  step.warm_start = static_cast<Real>(warm_starting == 0 || last_h == 0 ? 0 : h / last_h);
  step.push_speed = static_cast<Real>(push_speed);
  step.joint_rate = joint_hertz > 0 ? step.joint.bias_rate : step.inverse_h;
  step.chain_rate = joint_hertz > 0 ? step.joint_rate : make_softness(kChainHertz, kChainDampingRatio, h).bias_rate;
  step.relaxes_once = relaxation != 0;
  step.sleep_speed = static_cast<Real>(sleep_speed);
  step.sleep_time = static_cast<Real>(sleep_time);
  step.restitution_speed = static_cast<Real>(restitution_speed);
  step.solver = static_cast<SolverKind>(solver);
  step.passes = static_cast<std::uint32_t>(iterations);
  step.stop_below = static_cast<Real>(stop_below);
  step.bias_rate = static_cast<Real>(bias / dt);
  step.slop = static_cast<Real>(slop);
  return step;
}

}  // namespace plumb::impulse
