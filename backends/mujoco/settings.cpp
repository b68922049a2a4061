// One row a setting: what the host is told, and which member it moves.
#include "settings.hpp"

namespace plumb::mujoco {
namespace {

constexpr const char* solver_words[] = {"pgs", "cg", "newton"};             // as mjtSolver counts
constexpr const char* cone_words[] = {"pyramidal", "elliptic", "by_need"};  // as mjtCone counts, and one more
constexpr int kByNeed = 2;

void put_rows(const Settings& settings, int count, double time, double damping, mjtNum* solref, mjtNum* solimp) {
  for (int i = 0; i < count; ++i) {
    solref[mjNREF * i] = time;
    solref[mjNREF * i + 1] = damping;
    put_impedance(settings, solimp + mjNIMP * i);
  }
}

}  // namespace

const backend::SettingsTable<Settings>& settings_table() {
  using S = Settings;
  using namespace backend;
  constexpr auto quality = PLUMB_ROLE_QUALITY, behaviour = PLUMB_ROLE_BEHAVIOUR;
  static const SettingsTable<Settings> all = {
      setting<&S::substeps>(
          int_setting("substeps", "1", quality, 1, 1024, 8, "MuJoCo steps of dt / substeps in a step")),
      setting<&S::solver>(choice_setting("solver", behaviour, solver_words,
                                         "projected Gauss-Seidel, conjugate gradients, or Newton's method", 0, 2)),
      setting<&S::iterations>(int_setting("iterations", "1", quality, 1, 10000, 100, "at most, of the solver")),
      setting<&S::tolerance>(float_setting("tolerance", "1", quality, 0, 1, 1e-8, "at which the solver stops early")),
      setting<&S::noslip_iterations>(int_setting("noslip_iterations", "1", quality, 0, 10000, 0,
                                                 "of a second solver that takes the creep out of friction")),
      setting<&S::cone>(choice_setting("cone", behaviour, cone_words,
                                       "of friction; by need elliptic where the world has rolling friction, for in a "
                                       "pyramid sliding takes from it, else pyramidal",
                                       0, kByNeed)),
      setting<&S::impratio>(float_setting("impratio", "1", behaviour, 1e-3, 1e6, 1,
                                          "how much stiffer friction is than the normal constraint of a contact")),
      setting<&S::contact_time>(float_setting("contact_time", "s", behaviour, 1e-5, 10, 0.02,
                                              "in which a contact's overlap goes back; no less than two sub-steps")),
      setting<&S::contact_damping>(
          float_setting("contact_damping_ratio", "1", behaviour, 1e-3, 1e3, 1, "of contacts; 1 is critical")),
      setting<&S::joint_time>(float_setting("joint_time", "s", behaviour, 1e-5, 10, 0.02,
                                            "in which limits, rods and joints that close a loop are mended")),
      setting<&S::joint_damping>(float_setting("joint_damping_ratio", "1", behaviour, 1e-3, 1e3, 1, "likewise")),
      setting<&S::impedance_least>(float_setting("impedance_least", "1", behaviour, 1e-4, 0.9999, 0.9,
                                                 "hardness of a constraint where it begins")),
      setting<&S::impedance_most>(
          float_setting("impedance_most", "1", behaviour, 1e-4, 0.9999, 0.95, "hardness of one that is far violated")),
      setting<&S::impedance_width>(float_setting("impedance_width", "m", behaviour, 0, 10, 0.001,
                                                 "violation over which hardness goes from the one to the other")),
      setting<&S::bounce_substeps>(int_setting("bounce_substeps", "1", quality, 4, 1000, 10,
                                               "sub-steps that an impact with restitution lasts; fewer are harder")),
      setting<&S::warm_starting>(
          bool_setting("warm_starting", quality, true, "the accelerations of the step before are the first guess")),
      setting<&S::multiccd>(bool_setting(
          "multiccd", quality, false, "several points of contact for pairs of hulls and cylinders, by turning them"))};
  return all;
}

void put_impedance(const Settings& settings, mjtNum* solimp) {
  const mjtNum all[mjNIMP] = {settings.impedance_least, settings.impedance_most, settings.impedance_width, 0.5, 2};
  for (int i = 0; i < mjNIMP; ++i) solimp[i] = all[i];
}

void apply_to_model(const Settings& s, bool rolls, mjModel& m) {
  m.opt.solver = s.solver;
  m.opt.iterations = s.iterations;
  m.opt.tolerance = s.tolerance;
  m.opt.noslip_iterations = s.noslip_iterations;
  m.opt.cone = s.cone != kByNeed ? s.cone : rolls ? mjCONE_ELLIPTIC : mjCONE_PYRAMIDAL;
  m.opt.impratio = s.impratio;
  m.opt.disableflags = mjDSBL_FILTERPARENT | (s.warm_starting ? 0 : mjDSBL_WARMSTART);
  m.opt.enableflags = s.multiccd ? mjENBL_MULTICCD : 0;
  put_rows(s, m.njnt, s.joint_time, s.joint_damping, m.jnt_solref, m.jnt_solimp);
  put_rows(s, m.nv, s.joint_time, s.joint_damping, m.dof_solref, m.dof_solimp);
  put_rows(s, m.neq, s.joint_time, s.joint_damping, m.eq_solref, m.eq_solimp);
  put_rows(s, m.ntendon, s.joint_time, s.joint_damping, m.tendon_solref_lim, m.tendon_solimp_lim);
}

}  // namespace plumb::mujoco
