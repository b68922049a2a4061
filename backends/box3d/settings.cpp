// One row a setting: what the host is told, and which member it moves.
#include "settings.hpp"

namespace plumb::box3d {

const backend::SettingsTable<Settings>& settings_table() {
  using S = Settings;
  using namespace backend;
  constexpr auto quality = PLUMB_ROLE_QUALITY, speed = PLUMB_ROLE_SPEED, behaviour = PLUMB_ROLE_BEHAVIOUR;
  constexpr std::uint32_t once = PLUMB_SETTING_CREATION_ONLY;
  static const SettingsTable<Settings> all = {
      setting<&S::substeps>(int_setting("substeps", "1", quality, 1, 1024, 4,
                                        "sub-steps of the solver in a step; collision is found once a step")),
      setting<&S::contact_hertz>(
          float_setting("contact_hertz", "Hz", behaviour, 0, 1e6, 30,
                        "stiffness of contacts; Box3D takes no more than an eighth of the sub-steps' rate")),
      setting<&S::contact_damping_ratio>(
          float_setting("contact_damping_ratio", "1", behaviour, 0, 1e4, 10, "of contacts; 1 is critical")),
      setting<&S::contact_speed>(
          float_setting("contact_speed", "m/s", behaviour, 0, 1e4, 3, "fastest that overlap is pushed out with")),
      setting<&S::joint_hertz>(
          float_setting("joint_hertz", "Hz", behaviour, 0, 1e6, 60,
                        "stiffness of joints; Box3D takes no more than a quarter of the sub-steps' rate", once)),
      setting<&S::joint_damping_ratio>(
          float_setting("joint_damping_ratio", "1", behaviour, 0, 1e4, 2, "of joints; 1 is critical", once)),
      setting<&S::restitution_threshold>(
          float_setting("restitution_threshold", "m/s", behaviour, 0, 1e4, 1, "slower impacts do not bounce")),
      setting<&S::max_linear_speed>(
          float_setting("max_linear_speed", "m/s", behaviour, 1, 1e6, 400, "faster bodies are slowed to it")),
      setting<&S::recycle_distance>(float_setting(
          "contact_recycle_distance", "m", speed, 0, 1, 0.05,
          "contacts of bodies that have moved less since they were found are used again; 0: found in each step")),
      setting<&S::continuous>(
          bool_setting("continuous", behaviour, true, "no body passes through static ones, however fast")),
      setting<&S::speculative>(
          bool_setting("speculative", behaviour, true, "contacts are made before bodies touch, and stop them in time")),
      setting<&S::warm_starting>(
          bool_setting("warm_starting", quality, true, "the impulses of the step before are the first guess")),
      setting<&S::fast_rotation>(bool_setting("fast_rotation", behaviour, false,
                                              "bodies may turn by more than an eighth of a turn in a step", once)),
      setting<&S::cylinder_sides>(
          int_setting("cylinder_sides", "1", quality, 3, 42, 32,
                      "of the prism that a cylinder is made of, at most what 128 edges of a hull allow", once)),
      setting<&S::sleep_threshold>(
          float_setting("sleep_threshold", "m/s", behaviour, 0, 100, 0.05, "slower bodies may fall asleep", once))};
  return all;
}

void apply_to_world(const Settings& settings, b3WorldId world) {
  b3World_SetContactTuning(world, static_cast<float>(settings.contact_hertz),
                           static_cast<float>(settings.contact_damping_ratio),
                           static_cast<float>(settings.contact_speed));
  b3World_SetRestitutionThreshold(world, static_cast<float>(settings.restitution_threshold));
  b3World_SetMaximumLinearSpeed(world, static_cast<float>(settings.max_linear_speed));
  b3World_SetContactRecycleDistance(world, static_cast<float>(settings.recycle_distance));
  b3World_EnableContinuous(world, settings.continuous);
  b3World_EnableSpeculative(world, settings.speculative);
  b3World_EnableWarmStarting(world, settings.warm_starting);
}

}  // namespace plumb::box3d
