#include "simulation/names.hpp"

#include <array>
#include <utility>

namespace plumb::harness {

using Words = std::vector<std::string>;

const Words& degree_words() {
  static const Words words{"none", "approximate", "emulated", "native"};
  return words;
}
const Words& motion_words() {
  static const Words words{"static", "kinematic", "dynamic"};
  return words;
}
const Words& field_words() {
  static const Words words{"pose",
                           "velocity",
                           "force",
                           "torque",
                           "impulse",
                           "angular_impulse",
                           "force_at_point",
                           "impulse_at_point",
                           "awake",
                           "kinematic_target",
                           "mass",
                           "material",
                           "gravity_scale",
                           "damping",
                           "surface_velocity",
                           "filter"};
  return words;
}
const Words& event_words() {
  static const Words words{"contact_begin", "contact_end", "sensor_enter", "sensor_leave",
                           "wake",          "sleep",       "joint_broken"};
  return words;
}
const Words& phase_words() {
  static const Words words{"broad", "narrow", "islands", "solve", "integrate", "continuous", "output"};
  return words;
}
const Words& query_words() {
  static const Words words{"ray", "cast", "overlap", "penetration", "turning_cast"};
  return words;
}
const Words& joint_feature_words() {
  static const Words words{"limits", "motors", "springs", "breaks", "reaction", "stiffness", "targets"};
  return words;
}
const Words& setting_type_words() {
  static const Words words{"bool", "int", "float", "choice"};
  return words;
}
const Words& role_words() {
  static const Words words{"quality", "speed", "behaviour"};
  return words;
}
const Words& determinism_words() {
  static const Words words{"none", "run", "threads", "device"};
  return words;
}

std::string word_of(const Words& words, std::size_t index) { return index < words.size() ? words[index] : ""; }

std::string result_word(PlumbResult result) {
  static constexpr std::array<std::pair<PlumbResult, const char*>, 18> words{{
      {PLUMB_OK, "ok"},
      {PLUMB_TRUNCATED, "truncated"},
      {PLUMB_GROWN, "grown"},
      {PLUMB_COPIED, "copied"},
      {PLUMB_E_INVALID_ARGUMENT, "invalid argument"},
      {PLUMB_E_STALE_HANDLE, "stale handle"},
      {PLUMB_E_UNSUPPORTED, "unsupported"},
      {PLUMB_E_NOT_DECLARED, "need not declared"},
      {PLUMB_E_OUT_OF_MEMORY, "out of memory"},
      {PLUMB_E_WRONG_PHASE, "wrong phase"},
      {PLUMB_E_WRONG_THREAD, "wrong thread"},
      {PLUMB_E_VERSION, "no common version"},
      {PLUMB_E_EXCLUDED, "excluded"},
      {PLUMB_E_IN_USE, "in use"},
      {PLUMB_E_CORRUPT, "corrupt"},
      {PLUMB_E_INTERNAL, "internal error"},
      {PLUMB_E_WORLD_LOST, "world lost"},
      {PLUMB_E_DEVICE_LOST, "device lost"},
  }};
  for (const auto& [code, word] : words) {
    if (code == result) return word;
  }
  return "result " + std::to_string(result);
}

}  // namespace plumb::harness
