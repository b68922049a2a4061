// One row a setting: what the host is told, and which member it moves.
#include "settings.hpp"

namespace plumb::ode {
namespace {

constexpr const char* stepper_words[] = {"quickstep", "step"};
constexpr const char* friction_words[] = {"pyramid", "constant"};
constexpr const char* direction_words[] = {"normal", "sliding"};
constexpr const char* space_words[] = {"hash", "sap", "quadtree", "simple"};
constexpr const char* axes_words[] = {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"};
constexpr int axes_values[] = {dSAP_AXES_XYZ, dSAP_AXES_XZY, dSAP_AXES_YXZ,
                               dSAP_AXES_YZX, dSAP_AXES_ZXY, dSAP_AXES_ZYX};

}  // namespace

const backend::SettingsTable<Settings>& settings_table() {
  using S = Settings;
  using namespace backend;
  constexpr auto quality = PLUMB_ROLE_QUALITY, speed = PLUMB_ROLE_SPEED, behaviour = PLUMB_ROLE_BEHAVIOUR;
  constexpr std::uint32_t once = PLUMB_SETTING_CREATION_ONLY;
  static const SettingsTable<Settings> all = {
      setting<&S::stepper>(
          choice_setting("stepper", behaviour, stepper_words,
                         "quickstep: iterative; step: direct (Dantzig), exact on wild mass ratios and joints, cubic in "
                         "the island's size, and blows up on redundant contacts such as those of a tower")),
      setting<&S::iterations>(int_setting("iterations", "1", quality, 1, 10000, 20, "of quickstep's SOR solver")),
      setting<&S::sor_w>(
          float_setting("sor_w", "1", quality, 0.01, 1.99, 1.3, "over-relaxation of quickstep's solver")),
      setting<&S::substeps>(
          int_setting("substeps", "1", quality, 1, 1024, 1, "collide and solve so often in each step")),
      setting<&S::erp>(float_setting("erp", "1", quality, 0, 1, 0.2, "share of the position error mended in a step")),
      setting<&S::cfm>(
          float_setting("cfm", "s/kg", quality, 0, 1, 1e-10, "constraint force mixing: softness of constraints")),
      setting<&S::contact, &S::Contact::erp>(
          float_setting("contact_erp", "1", quality, -1, 1, -1, "erp of contacts; below 0: that of the world")),
      setting<&S::contact, &S::Contact::cfm>(
          float_setting("contact_cfm", "s/kg", quality, -1, 1, -1, "cfm of contacts; below 0: that of the world")),
      setting<&S::contact, &S::Contact::surface_layer>(float_setting(
          "contact_surface_layer", "m", quality, 0, 1, 0, "depth to which contacts may sink without being pushed out")),
      setting<&S::contact, &S::Contact::max_correcting_vel>(
          float_setting("contact_max_correcting_vel", "m/s", quality, 0, 1e6, 0,
                        "fastest that a contact pushes bodies apart; 0: no limit")),
      setting<&S::max_contacts>(int_setting("max_contacts", "1", quality, 1, 256, 8, "points of a pair of geoms")),
      setting<&S::friction_model>(
          choice_setting("friction_model", behaviour, friction_words,
                         "pyramid: mu times the normal force along each of two directions (dContactApprox1); "
                         "constant: ODE's other model, mu newtons whatever the normal force")),
      setting<&S::friction_directions>(
          choice_setting("friction_directions", behaviour, direction_words,
                         "normal: the two directions follow from the contact's normal, as in ODE; sliding: "
                         "the first is that of sliding where the contact slides (always so on conveyors)")),
      setting<&S::bounce_vel>(
          float_setting("bounce_vel", "m/s", behaviour, 0, 1000, 0.1, "slower impacts do not bounce")),
      setting<&S::gyroscopic>(
          bool_setting("gyroscopic", behaviour, true, "gyroscopic torque, where the world declares the need")),
      setting<&S::finite_rotation>(bool_setting("finite_rotation", behaviour, false,
                                                "orientations by whole rotations instead of a first order step")),
      setting<&S::sleep, &S::Sleep::linear>(
          float_setting("auto_disable_linear_threshold", "m/s", behaviour, 0, 100, 0.01, "a slower body may sleep")),
      setting<&S::sleep, &S::Sleep::angular>(
          float_setting("auto_disable_angular_threshold", "rad/s", behaviour, 0, 100, 0.01, "a slower body may sleep")),
      setting<&S::sleep, &S::Sleep::steps>(int_setting("auto_disable_steps", "1", behaviour, 0, 100000, 10,
                                                       "sub-steps that a body must be idle before it sleeps")),
      setting<&S::sleep, &S::Sleep::time>(float_setting("auto_disable_time", "s", behaviour, 0, 1000, 0,
                                                        "time that a body must be idle before it sleeps")),
      setting<&S::broad_phase, &S::BroadPhase::space>(choice_setting("space", speed, space_words, "broad phase", once)),
      setting<&S::broad_phase, &S::BroadPhase::hash_min_level>(
          int_setting("hash_min_level", "1", speed, -20, 0, -3, "smallest cell: 2^level m", once)),
      setting<&S::broad_phase, &S::BroadPhase::hash_max_level>(
          int_setting("hash_max_level", "1", speed, 0, 20, 10, "largest cell: 2^level m", once)),
      setting<&S::broad_phase, &S::BroadPhase::quadtree_extent>(float_setting(
          "quadtree_extent", "m", speed, 1, 1e6, 200, "half side of the quadtree around the origin", once)),
      setting<&S::broad_phase, &S::BroadPhase::quadtree_depth>(
          int_setting("quadtree_depth", "1", speed, 1, 10, 6, "levels of the quadtree", once)),
      setting<&S::broad_phase, &S::BroadPhase::sap_axes>(
          choice_setting("sap_axes", speed, axes_words, "order of the axes of sweep and prune", once)),
      setting<&S::threads>(
          int_setting("threads", "1", speed, 1, 64, 1,
                      "ODE's own thread pool; measured 2 to 4 times slower at 2 threads, and an engine error on one "
                      "of its threads ends the process",
                      once)),
      setting<&S::random_seed>(int_setting("random_seed", "1", behaviour, 0, 2147483647, 0,
                                           "of the order in which quickstep visits its rows", once))};
  return all;
}

dSpaceID make_space(const Settings& settings) {
  const dVector3 origin = {0, 0, 0};
  const double extent = settings.broad_phase.quadtree_extent;
  const dVector3 extents = {extent, extent, extent};
  switch (settings.broad_phase.space) {
    case Space::sap: return dSweepAndPruneSpaceCreate(nullptr, axes_values[settings.broad_phase.sap_axes]);
    case Space::quadtree: return dQuadTreeSpaceCreate(nullptr, origin, extents, settings.broad_phase.quadtree_depth);
    case Space::simple: return dSimpleSpaceCreate(nullptr);
    case Space::hash: break;
  }
  const dSpaceID space = dHashSpaceCreate(nullptr);
  dHashSpaceSetLevels(space, settings.broad_phase.hash_min_level, settings.broad_phase.hash_max_level);
  return space;
}

void apply_to_world(const Settings& settings, dWorldID world) {
  dWorldSetERP(world, settings.erp);
  dWorldSetCFM(world, settings.cfm);
  dWorldSetQuickStepNumIterations(world, settings.iterations);
  dWorldSetQuickStepW(world, settings.sor_w);
  dWorldSetContactSurfaceLayer(world, settings.contact.surface_layer);
  const double fastest = settings.contact.max_correcting_vel;
  dWorldSetContactMaxCorrectingVel(world, fastest == 0 ? dInfinity : fastest);
}

}  // namespace plumb::ode
