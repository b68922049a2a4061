#include "settings.hpp"

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>

#include <cstring>

namespace plumb::bullet {
namespace {

constexpr const char* kSolvers[] = {"si", "nncg", "mlcp_dantzig", "mlcp_lemke"};
constexpr const char* kGyroscopic[] = {"none", "explicit", "implicit_world", "implicit_body"};
constexpr const char* kPenetration[] = {"epa", "minkowski"};

constexpr PlumbSettingInfo integer(const char* name, PlumbSettingRole role, double low, double high, double value,
                                   const char* doc, std::uint32_t flags = 0) {
  return {
      name, "1", doc, PLUMB_SETTING_INT, role, flags, 0, nullptr, low, high, {PLUMB_SETTING_INT, 0, value, nullptr}};
}

constexpr PlumbSettingInfo real(const char* name, const char* unit, PlumbSettingRole role, double low, double high,
                                double value, const char* doc, std::uint32_t flags = 0) {
  return {name,
          unit,
          doc,
          PLUMB_SETTING_FLOAT,
          role,
          flags,
          0,
          nullptr,
          low,
          high,
          {PLUMB_SETTING_FLOAT, 0, value, nullptr}};
}

constexpr PlumbSettingInfo onoff(const char* name, PlumbSettingRole role, bool value, const char* doc,
                                 std::uint32_t flags = 0) {
  return {name,
          "",
          doc,
          PLUMB_SETTING_BOOL,
          role,
          flags,
          0,
          nullptr,
          0,
          1,
          {PLUMB_SETTING_BOOL, 0, value ? 1.0 : 0.0, nullptr}};
}

template <std::size_t N>
constexpr PlumbSettingInfo choice(const char* name, PlumbSettingRole role, const char* const (&words)[N],
                                  std::size_t value, const char* doc, std::uint32_t flags = 0) {
  return {name, "", doc, PLUMB_SETTING_CHOICE, role, flags, N, words, 0, 0, {PLUMB_SETTING_CHOICE, 0, 0, words[value]}};
}

constexpr PlumbSettingRole kQuality = PLUMB_ROLE_QUALITY, kSpeed = PLUMB_ROLE_SPEED, kBehaviour = PLUMB_ROLE_BEHAVIOUR;
constexpr std::uint32_t kCreation = PLUMB_SETTING_CREATION_ONLY;

// Every default is Bullet's own, to the bit: some are float literals in the build with doubles too.
constexpr PlumbSettingInfo kInfos[] = {
    integer("iterations", kQuality, 1, 10000, 10, "iterations of the solver over all constraints"),
    integer("substeps", kQuality, 1, 1000, 1, "Bullet steps of dt / substeps that make one step"),
    choice("solver", kBehaviour, kSolvers, 0,
           "sequential impulses, their conjugate-gradient variant, or a direct solver, which falls back to si where it "
           "fails and takes memory by the square of the contacts"),
    real("erp", "1", kBehaviour, 0, 1, 0.2, "share of a joint's error that is corrected in a step"),
    real("erp2", "1", kBehaviour, 0, 1, 0.2, "share of a contact's depth that is corrected in a step"),
    real("global_cfm", "1", kBehaviour, 0, 1, 0, "softness of all constraints"),
    real("friction_erp", "1", kBehaviour, 0, 1, 0.2, "share of the slip corrected in a step, with friction_anchors"),
    onoff("friction_anchors", kBehaviour, false, "hold contact points where friction caught them"),
    onoff("split_impulse", kBehaviour, true, "correct deep contacts by moving bodies without giving them velocity"),
    real("split_impulse_threshold", "m", kBehaviour, -1000, 0, -0.04f,
         "contacts deeper than its negative are corrected so"),
    real("split_impulse_turn_erp", "1", kBehaviour, 0, 1, 0.1f, "share of that correction's turn that is applied"),
    real("restitution_threshold", "m/s", kBehaviour, 0, 1000, 0.2f, "slower impacts do not bounce"),
    real("warm_start_factor", "1", kBehaviour, 0, 1, 0.85, "share of the last step's contact impulses to begin with"),
    real("relaxation", "1", kBehaviour, 0.1, 1.9, 1, "over-relaxation of contacts (sor)"),
    real("joint_damping", "1", kBehaviour, 0, 1, 1, "share of a joint's velocity error that is removed in a step"),
    real("linear_slop", "m", kBehaviour, -1, 1, 0, "depth of contact that is left alone"),
    real("residual_threshold", "N2 s2", kQuality, 0, 1e9, 0, "stop iterating when no impulse changes by more, squared"),
    integer("friction_directions", kQuality, 1, 2, 1, "tangents of a contact along which friction acts"),
    onoff("friction_follows_slip", kBehaviour, true, "the first tangent is the slip's direction, else a fixed one"),
    onoff("interleave_friction", kBehaviour, false, "solve a contact's friction right after it"),
    onoff("randomize_order", kBehaviour, false, "solve constraints in a random order, the same in every run"),
    onoff("simd", kSpeed, true, "solve with vector instructions; rounding differs"),
    onoff("split_islands", kSpeed, true, "solve groups of touching bodies apart"),
    integer("island_batch", kSpeed, 0, 1000000, 128, "constraints up to which small islands are solved together"),
    choice("gyroscopic_mode", kBehaviour, kGyroscopic, 3, "the term -w x I w: absent, or by one step of which method"),
    real("max_gyroscopic_torque", "N m", kBehaviour, 0, 1e9, 100, "bound of the explicit gyroscopic term"),
    onoff("deterministic_pairs", kSpeed, false, "sort contact pairs; slower"),
    real("contact_breaking_threshold", "m", kBehaviour, 0, 0.04, 0.02, "gap up to which contact points are kept"),
    real("collision_margin", "m", kBehaviour, 0, 0.5, 0.04,
         "rounding of boxes, cylinders and hulls, at most a tenth of their thickness", kCreation),
    onoff("hull_clipping", kQuality, false, "clip hulls' faces for several points of contact at once", kCreation),
    integer("multipoint_iterations", kQuality, 0, 16, 0, "extra perturbed runs for pairs that get one point a step",
            kCreation),
    choice("penetration", kBehaviour, kPenetration, 0, "how the depth of overlapping convex shapes is found",
           kCreation),
    real("ccd_threshold", "1", kQuality, 0.01, 100, 0.5,
         "motion in a step, in inner radii, above which CCD bodies are swept"),
    real("ccd_radius", "1", kQuality, 0.01, 1, 0.5, "radius of the swept sphere, in inner radii"),
    real("ccd_allowed_penetration", "m", kBehaviour, 0, 1, 0.04, "depth that a swept sphere ignores"),
    onoff("speculative_restitution", kBehaviour, false, "let swept bodies bounce"),
    real("sleep_linear_threshold", "m/s", kBehaviour, 0, 1000, 0.8, "slower bodies may fall asleep"),
    real("sleep_angular_threshold", "rad/s", kBehaviour, 0, 1000, 1, "bodies that turn slower may fall asleep"),
};

std::size_t word_index(const PlumbSettingValue& value, std::span<const char* const> words) {
  std::size_t i = 0;
  while (i + 1 < words.size() && std::strcmp(words[i], value.choice) != 0) ++i;
  return i;
}

}  // namespace

std::span<const PlumbSettingInfo> Settings::infos() { return kInfos; }

std::size_t Settings::index_of(const char* name) const {
  for (std::size_t i = 0; i < std::size(kInfos); ++i)
    if (std::strcmp(kInfos[i].name, name) == 0) return i;
  throw Error(PLUMB_E_INTERNAL, std::string("no setting ") + name);
}

const PlumbSettingValue& Settings::value(const char* name) const { return values_[index_of(name)]; }
void Settings::set(const char* name, const PlumbSettingValue& value) { values_[index_of(name)] = value; }

CollisionOptions Settings::collision_options() const {
  return {word_index(value("penetration"), kPenetration) == 0, static_cast<int>(number("multipoint_iterations"))};
}

ShapeOptions Settings::shape_options() const { return {number("collision_margin"), is_on("hull_clipping")}; }

SolverKind Settings::solver_kind() const { return static_cast<SolverKind>(word_index(value("solver"), kSolvers)); }

int Settings::gyroscopic_flags() const {
  constexpr int flags[] = {0, BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT, BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD,
                           BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY};
  return flags[word_index(value("gyroscopic_mode"), kGyroscopic)];
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
