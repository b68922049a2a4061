// A sweep: the cells that turn a backend's settings. Over a setting whose values are methods of their own, and along
// knobs, which buy accuracy with time; both are known from the backend's description alone.
#pragma once

#include <string>
#include <vector>

#include "cell/settings.hpp"

namespace plumb::harness {

/// One --over or --along: "[backend:]name" or "[backend:]name=value,value".
struct SweepAxis {
  std::string option;   ///< "--over" or "--along", for messages
  std::string backend;  ///< "": all that have it
  std::string name;
  std::vector<std::string> values;  ///< as typed; empty: chosen from the description
};

/// Throws UsageError for an empty name or value.
[[nodiscard]] SweepAxis parse_sweep_axis(const std::string& option, const std::string& argument);

/// What is turned. No `along`: every whole-numbered setting of the role "quality" that nobody has set.
struct Sweep {
  std::vector<SweepAxis> over, along;
  bool unnamed_knobs = true;  ///< false: no `along` turns none
};

/// Throws UsageError, naming the setting, the trouble and the remedy: names that no backend has or that are turned
/// twice, knobs that are none, and what --set (`fixed`) holds already.
void check_sweep(const Sweep& sweep, const std::vector<BackendDescription>& backends,
                 const std::vector<SettingRequest>& fixed);

/// The cells of one method along one knob, by their places in SweptSettings::settings. The probe is as far from the
/// base as can be: where both end in the same state, the knob does nothing and the others need not run.
struct Ladder {
  std::size_t base, probe;
  std::vector<std::size_t> others;
};

/// What the cells of one backend ask for; a base is in it once, whatever the number of its ladders.
struct SweptSettings {
  std::vector<Json> settings;
  std::vector<Ladder> ladders;
};

/// asked: the settings of the cell without the sweep. Every combination of the values of `over` is a method; each knob
/// has a ladder about the value in force there: five rungs, each twice the last, or the values that were named and
/// that one. Throws UsageError for values that the setting does not take, and for knobs without a ladder.
[[nodiscard]] SweptSettings swept_settings(const BackendDescription& backend, const Json& asked, const Sweep& sweep,
                                           const std::vector<SettingRequest>& fixed);

}  // namespace plumb::harness
