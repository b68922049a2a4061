// One row a setting: what the host is told, and which member it moves.
#include "settings.hpp"

namespace plumb::dart6 {
namespace {

constexpr const char* solver_words[] = {"dantzig", "pgs"};
constexpr const char* direction_words[] = {"normal", "sliding"};

}  // namespace

const backend::SettingsTable<Settings>& settings_table() {
  using S = Settings;
  using namespace backend;
  constexpr auto quality = PLUMB_ROLE_QUALITY, behaviour = PLUMB_ROLE_BEHAVIOUR;
  static const SettingsTable<Settings> all = {
      setting<&S::substeps>(
          int_setting("substeps", "1", quality, 1, 1024, 8, "DART's steps of dt / substeps in a step")),
      setting<&S::solver>(
          choice_setting("solver", behaviour, solver_words,
                         "of contacts, limits, motors and loops: Dantzig's, which is exact and gives way "
                         "to the other where it fails, or projected Gauss-Seidel")),
      setting<&S::iterations>(
          int_setting("iterations", "1", quality, 1, 10000, 30, "at most, of projected Gauss-Seidel")),
      setting<&S::friction_directions>(choice_setting(
          "friction_directions", behaviour, direction_words,
          "normal: the two directions of friction follow from the contact's normal, as in DART; sliding: "
          "the first is that of sliding where the contact slides")),
      setting<&S::contact_reduction>(float_setting("contact_error_reduction", "1", behaviour, 0, 1, 0.01,
                                                   "share of a contact's overlap that a sub-step takes back")),
      setting<&S::contact_reduction_speed>(
          float_setting("contact_error_speed", "m/s", behaviour, 0, 1000, 0.1,
                        "at most, at which overlap is taken back; of DART itself 0.001")),
      setting<&S::contact_allowance>(
          float_setting("contact_error_allowance", "m", behaviour, 0, 1, 0, "overlap that is left")),
      setting<&S::bounce_speed>(
          float_setting("bounce_speed", "m/s", behaviour, 0, 1000, 0.1, "rebounds that are slower are none")),
      setting<&S::joint_reduction>(float_setting("joint_error_reduction", "1", behaviour, 0, 1, 0.2,
                                                 "share of the gap of rods and of joints that close a loop that a "
                                                 "sub-step takes back")),
      setting<&S::joint_reduction_speed>(float_setting("joint_error_speed", "m/s", behaviour, 0, 1000, 10,
                                                       "at most, at which that gap is taken back; rad/s of turns"))};
  return all;
}

}  // namespace plumb::dart6
