#include "plugin/settings.hpp"

#include <algorithm>
#include <string>
#include <vector>

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

const std::vector<Row>& rows() {
  using S = Settings;
  constexpr auto real = PLUMB_SETTING_FLOAT, whole = PLUMB_SETTING_INT, flag = PLUMB_SETTING_BOOL;
  constexpr auto quality = PLUMB_ROLE_QUALITY, behaviour = PLUMB_ROLE_BEHAVIOUR;
  static const std::vector<Row> all = {
      number("substeps", whole, quality, 1, 256, 8, "1", &S::substeps,
             "parts of a step in which velocities are solved and positions moved"),
      number("contact_hertz", real, behaviour, 0, 1e5, 0, "1/s", &S::contact_hertz,
             "stiffness of contacts against overlap; 0: a quarter of the sub-steps a second, the most that is stable"),
      number("contact_damping_ratio", real, behaviour, 0, 1000, 50, "1", &S::contact_damping_ratio,
             "how slowly overlap is taken back: 1 is critical damping"),
      number("joint_hertz", real, behaviour, 0, 1e5, 0, "1/s", &S::joint_hertz,
             "stiffness of joints against drift; 0: half of the sub-steps a second"),
      number("joint_damping_ratio", real, behaviour, 0, 1000, 2, "1", &S::joint_damping_ratio,
             "how slowly drift of joints is taken back"),
      number("push_speed", real, behaviour, 0, 1e6, 3, "m/s", &S::push_speed,
             "overlap is taken back no faster than this"),
      number("restitution_speed", real, behaviour, 0, 1e6, 0.1, "m/s", &S::restitution_speed,
             "slower impacts do not bounce"),
      number("warm_starting", flag, behaviour, 0, 1, 1, "", &S::warm_starting,
             "start from the impulses of the last step"),
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

double Settings::get(const char* name) const { return this->*row(name).member; }
void Settings::set(const char* name, double value) { this->*row(name).member = value; }

StepParameters Settings::parameters(double dt, double last_h, const PlumbVec3& gravity) const {
  const double h = dt / substeps;
  StepParameters step{};
  step.gravity = {static_cast<Real>(gravity.x), static_cast<Real>(gravity.y), static_cast<Real>(gravity.z)};
  step.dt = static_cast<Real>(dt);
  step.h = static_cast<Real>(h);
  step.inverse_h = static_cast<Real>(1 / h);
  step.substeps = static_cast<std::uint32_t>(substeps);
  const double hertz = contact_hertz > 0 ? contact_hertz : 0.25 / h;
  step.contact = make_softness(hertz, contact_damping_ratio, h);
  step.ground = make_softness(2 * hertz, contact_damping_ratio, h);
  step.joint = make_softness(joint_hertz > 0 ? joint_hertz : 0.5 / h, joint_damping_ratio, h);
  step.warm_start = static_cast<Real>(warm_starting == 0 || last_h == 0 ? 0 : h / last_h);
  step.push_speed = static_cast<Real>(push_speed);
  step.restitution_speed = static_cast<Real>(restitution_speed);
  return step;
}

}  // namespace plumb::impulse
