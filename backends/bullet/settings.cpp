#include "settings.hpp"

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>

#include <cstring>

namespace plumb::bullet {
namespace {

constexpr const char* kSolvers[] = {"si", "nncg", "mlcp_dantzig", "mlcp_lemke"};
constexpr const char* kGyroscopic[] = {"none", "explicit", "implicit_world", "implicit_body"};
constexpr const char* kPenetration[] = {"epa", "minkowski"};

using backend::bool_setting;
using backend::choice_setting;
using backend::float_setting;
using backend::int_setting;

constexpr PlumbSettingRole kQuality = PLUMB_ROLE_QUALITY, kSpeed = PLUMB_ROLE_SPEED, kBehaviour = PLUMB_ROLE_BEHAVIOUR;
constexpr std::uint32_t kCreation = PLUMB_SETTING_CREATION_ONLY;

// Every default is Bullet's own, to the bit: some are float literals in the build with doubles too.
constexpr PlumbSettingInfo kInfos[] = {
    int_setting("iterations", "1", kQuality, 1, 10000, 10, "iterations of the solver over all constraints"),
    int_setting("substeps", "1", kQuality, 1, 1000, 1, "Bullet steps of dt / substeps that make one step"),
    choice_setting(
        "solver", kBehaviour, kSolvers,
        "sequential impulses, their conjugate-gradient variant, or a direct solver, which falls back to si where it "
        "fails and takes memory by the square of the contacts"),
    float_setting("erp", "1", kBehaviour, 0, 1, 0.2, "share of a joint's error that is corrected in a step"),
    float_setting("erp2", "1", kBehaviour, 0, 1, 0.2, "share of a contact's depth that is corrected in a step"),
    float_setting("global_cfm", "1", kBehaviour, 0, 1, 0, "softness of all constraints"),
    float_setting("friction_erp", "1", kBehaviour, 0, 1, 0.2,
                  "share of the slip corrected in a step, with friction_anchors"),
    bool_setting("friction_anchors", kBehaviour, false, "hold contact points where friction caught them"),
    bool_setting("split_impulse", kBehaviour, true,
                 "correct deep contacts by moving bodies without giving them velocity"),
    float_setting("split_impulse_threshold", "m", kBehaviour, -1000, 0, -0.04f,
                  "contacts deeper than its negative are corrected so"),
    float_setting("split_impulse_turn_erp", "1", kBehaviour, 0, 1, 0.1f,
                  "share of that correction's turn that is applied"),
    float_setting("restitution_threshold", "m/s", kBehaviour, 0, 1000, 0.2f, "slower impacts do not bounce"),
    float_setting("warm_start_factor", "1", kBehaviour, 0, 1, 0.85,
                  "share of the last step's contact impulses to begin with"),
    float_setting("relaxation", "1", kBehaviour, 0.1, 1.9, 1, "over-relaxation of contacts (sor)"),
    float_setting("joint_damping", "1", kBehaviour, 0, 1, 1,
                  "share of a joint's velocity error that is removed in a step"),
    float_setting("linear_slop", "m", kBehaviour, -1, 1, 0, "depth of contact that is left alone"),
    float_setting("residual_threshold", "N2 s2", kQuality, 0, 1e9, 0,
                  "stop iterating when no impulse changes by more, squared"),
    int_setting("friction_directions", "1", kQuality, 1, 2, 1, "tangents of a contact along which friction acts"),
    bool_setting("friction_follows_slip", kBehaviour, true,
                 "the first tangent is the slip's direction, else a fixed one"),
    bool_setting("interleave_friction", kBehaviour, false, "solve a contact's friction right after it"),
    bool_setting("randomize_order", kBehaviour, false, "solve constraints in a random order, the same in every run"),
    bool_setting("simd", kSpeed, true, "solve with vector instructions; rounding differs"),
    bool_setting("split_islands", kSpeed, true, "solve groups of touching bodies apart"),
    int_setting("island_batch", "1", kSpeed, 0, 1000000, 128,
                "constraints up to which small islands are solved together"),
    choice_setting("gyroscopic_mode", kBehaviour, kGyroscopic,
                   "the term -w x I w: absent, or by one step of which method", 0, 3),
    float_setting("max_gyroscopic_torque", "N m", kBehaviour, 0, 1e9, 100, "bound of the explicit gyroscopic term"),
    bool_setting("deterministic_pairs", kSpeed, false, "sort contact pairs; slower"),
    float_setting("contact_breaking_threshold", "m", kBehaviour, 0, 0.04, 0.02,
                  "gap up to which contact points are kept"),
    float_setting("collision_margin", "m", kBehaviour, 0, 0.5, 0.04,
                  "rounding of boxes, cylinders and hulls, at most a tenth of their thickness", kCreation),
    bool_setting("hull_clipping", kQuality, false, "clip hulls' faces for several points of contact at once",
                 kCreation),
    int_setting("multipoint_iterations", "1", kQuality, 0, 16, 0,
                "extra perturbed runs for pairs that get one point a step", kCreation),
    choice_setting("penetration", kBehaviour, kPenetration, "how the depth of overlapping convex shapes is found",
                   kCreation),
    float_setting("ccd_threshold", "1", kQuality, 0.01, 100, 0.5,
                  "motion in a step, in inner radii, above which CCD bodies are swept"),
    float_setting("ccd_radius", "1", kQuality, 0.01, 1, 0.5, "radius of the swept sphere, in inner radii"),
    float_setting("ccd_allowed_penetration", "m", kBehaviour, 0, 1, 0.04, "depth that a swept sphere ignores"),
    bool_setting("speculative_restitution", kBehaviour, false, "let swept bodies bounce"),
    float_setting("sleep_linear_threshold", "m/s", kBehaviour, 0, 1000, 0.8, "slower bodies may fall asleep"),
    float_setting("sleep_angular_threshold", "rad/s", kBehaviour, 0, 1000, 1,
                  "bodies that turn slower may fall asleep"),
};

}  // namespace

std::span<const PlumbSettingInfo> Settings::infos() { return kInfos; }

std::size_t Settings::index_of(const char* name) const {
  for (std::size_t i = 0; i < std::size(kInfos); ++i)
    if (std::strcmp(kInfos[i].name, name) == 0) return i;
  throw Error(PLUMB_E_INTERNAL, std::string("no setting ") + name);
}

const PlumbSettingValue& Settings::value(const char* name) const { return values_[index_of(name)]; }
std::uint32_t Settings::word(const char* name) const {
  const std::size_t i = index_of(name);
  return backend::word_number(kInfos[i], values_[i].choice);
}
void Settings::set(const char* name, const PlumbSettingValue& value) { values_[index_of(name)] = value; }

CollisionOptions Settings::collision_options() const {
  return {word("penetration") == 0, static_cast<int>(number("multipoint_iterations"))};
}

ShapeOptions Settings::shape_options() const { return {number("collision_margin"), is_on("hull_clipping")}; }

SolverKind Settings::solver_kind() const { return static_cast<SolverKind>(word("solver")); }

int Settings::gyroscopic_flags() const {
  constexpr int flags[] = {0, BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT, BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD,
                           BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY};
  return flags[word("gyroscopic_mode")];
}

int Settings::solver_mode(bool conveyors) const {
  int mode = SOLVER_USE_WARMSTARTING;  // always: without it Bullet does not hand back impulses; the factor may be 0
  if (is_on("simd")) mode |= SOLVER_SIMD;
  if (is_on("randomize_order")) mode |= SOLVER_RANDMIZE_ORDER;
  if (number("friction_directions") == 2) mode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  if (!is_on("friction_follows_slip")) mode |= SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
  if (is_on("interleave_friction")) mode |= SOLVER_INTERLEAVE_CONTACT_AND_FRICTION_CONSTRAINTS;
  if (conveyors) mode |= SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
  return mode;
}

void Settings::apply(DynamicsWorld& world, Dispatcher& dispatcher, bool conveyors) const {
  const auto of = [this](const char* name) { return static_cast<btScalar>(number(name)); };
  btContactSolverInfo& info = world.getSolverInfo();
  info.m_numIterations = static_cast<int>(number("iterations"));
  info.m_erp = of("erp");
  info.m_erp2 = of("erp2");
  info.m_globalCfm = of("global_cfm");
  info.m_frictionERP = of("friction_erp");
  info.m_splitImpulse = is_on("split_impulse") ? 1 : 0;
  info.m_splitImpulsePenetrationThreshold = of("split_impulse_threshold");
  info.m_splitImpulseTurnErp = of("split_impulse_turn_erp");
  info.m_restitutionVelocityThreshold = of("restitution_threshold");
  info.m_warmstartingFactor = of("warm_start_factor");
  info.m_sor = of("relaxation");
  info.m_damping = of("joint_damping");
  info.m_linearSlop = of("linear_slop");
  info.m_leastSquaresResidualThreshold = of("residual_threshold");
  info.m_minimumSolverBatchSize = static_cast<int>(number("island_batch"));
  info.m_maxGyroscopicForce = of("max_gyroscopic_torque");
  info.m_solverMode = solver_mode(conveyors);
  world.getSimulationIslandManager()->setSplitIslands(is_on("split_islands"));
  world.getDispatchInfo().m_deterministicOverlappingPairs = is_on("deterministic_pairs");
  world.getDispatchInfo().m_allowedCcdPenetration = of("ccd_allowed_penetration");
  world.setApplySpeculativeContactRestitution(is_on("speculative_restitution"));
  dispatcher.breaking_threshold = of("contact_breaking_threshold");
}

}  // namespace plumb::bullet
