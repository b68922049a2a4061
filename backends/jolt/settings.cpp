// One row a setting: what the host is told, and which member it moves.
#include "settings.hpp"

#include <cmath>
#include <numbers>

namespace plumb::jolt {

const backend::SettingsTable<Settings>& settings_table() {
  using S = Settings;
  using namespace backend;
  constexpr auto quality = PLUMB_ROLE_QUALITY, speed = PLUMB_ROLE_SPEED, behaviour = PLUMB_ROLE_BEHAVIOUR;
  constexpr std::uint32_t once = PLUMB_SETTING_CREATION_ONLY;
  static const SettingsTable<Settings> all = {
      setting<&S::velocity_steps>(int_setting("velocity_steps", "1", quality, 2, 255, 10,
                                              "iterations that solve velocities; below 2 there is no friction")),
      setting<&S::position_steps>(int_setting("position_steps", "1", quality, 0, 255, 2,
                                              "iterations that push overlap and gaps of joints out")),
      setting<&S::collision_steps>(int_setting("collision_steps", "1", quality, 1, 256, 1,
                                               "parts of a step, each with its own collision detection")),
      setting<&S::baumgarte>(float_setting("baumgarte", "1", behaviour, 0, 1, 0.2,
                                           "share of an error that an iteration of positions takes back")),
      setting<&S::penetration_slop>(
          float_setting("penetration_slop", "m", behaviour, 0, 1, 0.02, "overlap that is left as it is")),
      setting<&S::speculative_distance>(float_setting("speculative_distance", "m", behaviour, 0, 1, 0.02,
                                                      "contacts are made this far before bodies touch")),
      setting<&S::max_penetration_distance>(float_setting("max_penetration_distance", "m", behaviour, 0, 100, 0.2,
                                                          "most that an iteration of positions pushes out")),
      setting<&S::manifold_tolerance>(float_setting("manifold_tolerance", "m", behaviour, 0, 1, 1e-3,
                                                    "points this far from a face still are contacts of it")),
      setting<&S::restitution_threshold>(
          float_setting("restitution_threshold", "m/s", behaviour, 0, 1e4, 1, "slower impacts do not bounce")),
      setting<&S::max_linear_speed>(float_setting("max_linear_speed", "m/s", behaviour, 1, 1e9, 1e6,
                                                  "faster bodies are slowed to it; Jolt's own is 500", once)),
      setting<&S::max_angular_speed>(float_setting("max_angular_speed", "rad/s", behaviour, 1, 1e9, 1e6,
                                                   "faster bodies are slowed to it; Jolt's own is 47", once)),
      setting<&S::convex_radius>(
          float_setting("convex_radius", "m", behaviour, 0, 1, 0.05,
                        "edges of boxes, cylinders and hulls are rounded by it where overlap is measured", once)),
      setting<&S::cast, &S::Cast::threshold>(
          float_setting("linear_cast_threshold", "1", behaviour, 0, 100, 0.75,
                        "share of its inner radius by which a body with continuous collision moves before it is cast")),
      setting<&S::cast, &S::Cast::max_penetration>(
          float_setting("linear_cast_max_penetration", "1", behaviour, 0, 1, 0.25,
                        "share of its inner radius by which such a body may overlap what its cast hits")),
      setting<&S::recycling, &S::Recycling::distance>(
          float_setting("contact_recycle_distance", "m", speed, 0, 1, 1e-3,
                        "contacts of bodies that have moved less against each other are used again")),
      setting<&S::recycling, &S::Recycling::angle>(float_setting(
          "contact_recycle_angle", "rad", speed, 0, 1, std::numbers::pi / 90, "likewise where they have turned less")),
      setting<&S::sleep, &S::Sleep::threshold>(
          float_setting("sleep_threshold", "m/s", behaviour, 0, 100, 0.03, "bodies of which all is slower may sleep")),
      setting<&S::sleep, &S::Sleep::time>(
          float_setting("sleep_time", "s", behaviour, 0, 1e4, 0.5, "they fall asleep after this time")),
      setting<&S::warm_starting>(
          bool_setting("warm_starting", quality, true, "the impulses of the step before are the first guess")),
      setting<&S::recycling, &S::Recycling::on>(
          bool_setting("contact_recycling", speed, true, "contacts of bodies that hardly moved are used again")),
      setting<&S::manifold_reduction>(bool_setting("manifold_reduction", behaviour, true,
                                                   "contacts of triangles or children with one normal become four")),
      setting<&S::internal_edge_removal>(
          bool_setting("internal_edge_removal", behaviour, false,
                       "no contacts of edges within a surface of triangles or boxes; takes longer", once)),
      setting<&S::split_islands>(
          bool_setting("split_islands", speed, true, "several threads solve one island where it is large"))};
  return all;
}

JPH::PhysicsSettings physics_settings(const Settings& settings, bool may_sleep) {
  const auto narrow = [](double number) { return static_cast<float>(number); };
  const JPH::PhysicsSettings jolts;
  JPH::PhysicsSettings made;
  made.mNumVelocitySteps = static_cast<JPH::uint>(settings.velocity_steps);
  made.mNumPositionSteps = static_cast<JPH::uint>(settings.position_steps);
  made.mBaumgarte = narrow(settings.baumgarte);
  made.mPenetrationSlop = narrow(settings.penetration_slop);
  made.mSpeculativeContactDistance = narrow(settings.speculative_distance);
  made.mMaxPenetrationDistance = narrow(settings.max_penetration_distance);
  made.mManifoldTolerance = narrow(settings.manifold_tolerance);
  made.mMinVelocityForRestitution = narrow(settings.restitution_threshold);
  made.mLinearCastThreshold = narrow(settings.cast.threshold);
  made.mLinearCastMaxPenetration = narrow(settings.cast.max_penetration);
  made.mBodyPairCacheMaxDeltaPositionSq = JPH::Square(narrow(settings.recycling.distance));
  made.mBodyPairCacheCosMaxDeltaRotationDiv2 = settings.recycling.angle == std::numbers::pi / 90
                                                   ? jolts.mBodyPairCacheCosMaxDeltaRotationDiv2
                                                   : narrow(std::cos(settings.recycling.angle / 2));
  made.mPointVelocitySleepThreshold = narrow(settings.sleep.threshold);
  made.mTimeBeforeSleep = narrow(settings.sleep.time);
  made.mConstraintWarmStart = settings.warm_starting;
  made.mUseBodyPairContactCache = settings.recycling.on;
  made.mUseManifoldReduction = settings.manifold_reduction;
  made.mUseLargeIslandSplitter = settings.split_islands;
  made.mAllowSleeping = may_sleep;
  return made;
}

}  // namespace plumb::jolt
