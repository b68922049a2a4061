// One row a setting: what the host is told, and which member it moves.
#include "settings.hpp"

#include "device.hpp"

namespace plumb::px {
namespace {

constexpr const char* kSolvers[] = {"pgs", "tgs"};
constexpr const char* kCcds[] = {"swept", "speculative"};
constexpr const char* kBroadPhases[] = {"pabp", "abp", "sap", "gpu"};
constexpr std::span<const char* const> kOfDevice(kBroadPhases, kOnGpu ? 4 : 3);
constexpr std::size_t kOwnBroadPhase = kOnGpu ? 3 : 0;

float narrow(double number) { return static_cast<float>(number); }

}  // namespace

const backend::SettingsTable<Settings>& settings_table() {
  using S = Settings;
  using namespace backend;
  constexpr auto quality = PLUMB_ROLE_QUALITY, speed = PLUMB_ROLE_SPEED, behaviour = PLUMB_ROLE_BEHAVIOUR;
  constexpr std::uint32_t once = PLUMB_SETTING_CREATION_ONLY;
  static const SettingsTable<Settings> all = {
      setting<&S::position_iterations>(int_setting("position_iterations", "1", quality, 1, 255, 4,
                                                   "iterations that solve velocities and positions")),
      setting<&S::velocity_iterations>(int_setting("velocity_iterations", "1", quality, 0, 255, 1,
                                                   "iterations after them that solve velocities alone")),
      setting<&S::solver>(choice_setting("solver", behaviour, kSolvers,
                                         "pgs: projected Gauss-Seidel; tgs: temporal Gauss-Seidel, whose position "
                                         "iterations are parts of the step",
                                         once)),
      setting<&S::bounce_threshold>(
          float_setting("bounce_threshold", "m/s", behaviour, 1e-6, 1e4, 2, "slower impacts do not bounce")),
      setting<&S::contacts, &S::Contacts::offset>(
          float_setting("contact_offset", "m", behaviour, 1e-6, 1, 0.02,
                        "contacts are made where shapes are nearer to each other than the sum of both offsets", once)),
      setting<&S::contacts, &S::Contacts::rest_offset>(float_setting(
          "rest_offset", "m", behaviour, -1, 0, 0, "shapes come to rest with the sum of both as their gap", once)),
      setting<&S::friction, &S::Friction::offset_threshold>(float_setting(
          "friction_offset_threshold", "m", behaviour, 0, 1, 0.04, "no friction at points that are further apart")),
      setting<&S::friction, &S::Friction::correlation_distance>(
          float_setting("friction_correlation_distance", "m", behaviour, 0, 1, 0.025,
                        "contact points nearer to each other have one anchor of friction")),
      setting<&S::friction, &S::Friction::every_iteration>(
          bool_setting("friction_every_iteration", quality, false,
                       "pgs: friction in all position iterations, not in the last three alone", once)),
      setting<&S::friction, &S::Friction::strong>(
          bool_setting("strong_friction", behaviour, true, "what slid though it should stick is taken back", once)),
      setting<&S::forces_every_iteration>(bool_setting("forces_every_iteration", behaviour, false,
                                                       "tgs: gravity and forces in parts, with each position iteration",
                                                       once)),
      setting<&S::max_angular_speed>(
          float_setting("max_angular_speed", "rad/s", behaviour, 1, 1e9, 100, "faster bodies are slowed to it", once)),
      setting<&S::max_depenetration_speed>(float_setting("max_depenetration_speed", "m/s", behaviour, 1e-3, 1e32, 1e32,
                                                         "most with which overlap is pushed out", once)),
      setting<&S::max_bias_coefficient>(float_setting("max_bias_coefficient", "1/s", behaviour, 0, PX_MAX_F32,
                                                      PX_MAX_F32,
                                                      "most share of an error that is taken back a second")),
      setting<&S::continuous, &S::Continuous::by>(
          choice_setting("ccd", behaviour, kCcds,
                         "swept: bodies are stopped where they first hit; speculative: contacts are made as far ahead "
                         "as bodies move",
                         once)),
      setting<&S::continuous, &S::Continuous::most_passes>(
          int_setting("ccd_max_passes", "1", quality, 1, 255, 1, "hits that a swept body may have in a step")),
      setting<&S::sleep, &S::Sleep::threshold>(float_setting("sleep_threshold", "m2/s2", behaviour, 0, 1e4, 0.005,
                                                             "bodies with less kinetic energy by mass may sleep",
                                                             once)),
      setting<&S::sleep, &S::Sleep::time>(
          float_setting("sleep_time", "s", behaviour, 1e-3, 1e4, 0.4, "they fall asleep after this time", once)),
      setting<&S::contacts, &S::Contacts::average_point>(
          bool_setting("average_point", behaviour, false, "manifolds have their middle as one more point", once)),
      setting<&S::stabilization>(
          bool_setting("stabilization", behaviour, false, "one more pass that slows heaps and loses momentum", once)),
#ifndef PLUMB_PHYSX_CUDA  // what PhysX does not let be chosen there
      setting<&S::contacts, &S::Contacts::pcm>(bool_setting(
          "persistent_manifolds", behaviour, true, "contact points are kept from step to step and added to", once)),
      setting<&S::enhanced_determinism>(
          bool_setting("enhanced_determinism", behaviour, false,
                       "what bodies do does not depend on others that are far away; takes longer", once)),
#endif
      setting<&S::broad_phase>(choice_setting("broad_phase", speed, kOfDevice,
                                              "pabp: automatic box pruning by several threads; abp: by one; sap: sweep "
                                              "and prune",
                                              once, kOwnBroadPhase)),
      setting<&S::batch_size>(int_setting("solver_batch_size", "1", speed, 1, 1 << 20, 128,
                                          "bodies of islands that are solved by one thread"))};
  return all;
}

void put_settings(const Settings& settings, PxSceneDesc& desc) {
  const auto put = [&](PxSceneFlag::Enum flag, bool on) { on ? desc.flags.raise(flag) : desc.flags.clear(flag); };
  const bool tgs = settings.solver == Settings::Solver::tgs;
  desc.solverType = tgs ? PxSolverType::eTGS : PxSolverType::ePGS;
  constexpr PxBroadPhaseType::Enum broad_phases[] = {PxBroadPhaseType::ePABP, PxBroadPhaseType::eABP,
                                                     PxBroadPhaseType::eSAP, PxBroadPhaseType::eGPU};
  desc.broadPhaseType = broad_phases[static_cast<std::size_t>(settings.broad_phase)];
  put(PxSceneFlag::eENABLE_PCM, settings.contacts.pcm || kOnGpu);
  put(PxSceneFlag::eENABLE_AVERAGE_POINT, settings.contacts.average_point);
  put(PxSceneFlag::eENABLE_FRICTION_EVERY_ITERATION, settings.friction.every_iteration);
  put(PxSceneFlag::eENABLE_EXTERNAL_FORCES_EVERY_ITERATION_TGS, settings.forces_every_iteration && tgs);
  put(PxSceneFlag::eENABLE_STABILIZATION, settings.stabilization);
  put(PxSceneFlag::eENABLE_ENHANCED_DETERMINISM, settings.enhanced_determinism);
  desc.wakeCounterResetValue = narrow(settings.sleep.time);
}

void apply_settings(const Settings& settings, PxScene& scene) {
  scene.setBounceThresholdVelocity(narrow(settings.bounce_threshold));
  scene.setFrictionOffsetThreshold(narrow(settings.friction.offset_threshold));
  scene.setFrictionCorrelationDistance(narrow(settings.friction.correlation_distance));
  scene.setMaxBiasCoefficient(narrow(settings.max_bias_coefficient));
  scene.setSolverBatchSize(static_cast<PxU32>(settings.batch_size));
  scene.setCCDMaxPasses(static_cast<PxU32>(settings.continuous.most_passes));
}

}  // namespace plumb::px
