// Settings: every knob is described, has its default in force, takes what its description allows, and still steps.
#include <cstring>

#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace {

std::string value_text(const PlumbSettingValue& value) {
  return value.type == PLUMB_SETTING_CHOICE ? (value.choice == nullptr ? "null" : value.choice)
                                            : fmt::format("{}", value.number);
}

bool equal(const PlumbSettingValue& a, const PlumbSettingValue& b) {
  if (a.type != b.type) return false;
  if (a.type == PLUMB_SETTING_CHOICE)
    return a.choice != nullptr && b.choice != nullptr && std::strcmp(a.choice, b.choice) == 0;
  return std::abs(a.number - b.number) <= 1e-6 * std::max(1.0, std::abs(b.number));  // an engine of floats rounds
}

void described(Conformance& c) {
  std::vector<std::string> names;
  for (const PlumbSettingInfo* info : c.backend().settings()) {
    c.expect(info != nullptr, "a setting within the count is null");
    if (info == nullptr) continue;
    const std::string name = info->name;
    c.expect(std::find(names.begin(), names.end(), name) == names.end(), "setting {} is listed twice", name);
    names.push_back(name);
    c.expect(!name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos,
             "\"{}\" is not snake_case", name);
    c.expect(info->doc != nullptr && *info->doc != '\0' && info->unit != nullptr, "setting {} has no doc or unit",
             name);
    c.expect(info->default_value.type == info->type, "setting {}: its default is of another type", name);
    if (info->type == PLUMB_SETTING_INT || info->type == PLUMB_SETTING_FLOAT)
      c.expect(info->minimum <= info->default_value.number && info->default_value.number <= info->maximum,
               "setting {}: its default is out of range", name);
  }
  if (names.empty()) throw Skipped{"no settings"};
}

/// Values worth trying: both ends, the default, each choice.
std::vector<PlumbSettingValue> candidates(const PlumbSettingInfo& info) {
  std::vector<PlumbSettingValue> values = {info.default_value};
  if (info.type == PLUMB_SETTING_BOOL)
    values.insert(values.end(), {{info.type, 0, 0, nullptr}, {info.type, 0, 1, nullptr}});
  for (std::uint32_t i = 0; info.type == PLUMB_SETTING_CHOICE && i < info.choice_count; ++i)
    values.push_back({info.type, 0, 0, info.choices[i]});
  if (info.type == PLUMB_SETTING_INT || info.type == PLUMB_SETTING_FLOAT) {
    values.push_back({info.type, 0, info.minimum, nullptr});
    // The largest may be a cost that nobody wants to pay in a check: a hundred times the default is large enough.
    const double large = std::min(info.maximum, std::max(100 * std::abs(info.default_value.number), info.minimum + 1));
    values.push_back({info.type, 0, info.type == PLUMB_SETTING_INT ? std::floor(large) : large, nullptr});
  }
  return values;
}

/// A few cubes and spheres in a heap, with one setting changed: it is in force, and the step still works.
void in_force(Conformance& c) {
  if (c.backend().settings().empty()) throw Skipped{"no settings"};
  for (const PlumbSettingInfo* info : c.backend().settings())
    for (const PlumbSettingValue& value : candidates(*info)) {
      const std::string what = fmt::format("{} = {}", info->name, value_text(value));
      try {
        const bool at_creation = (info->flags & PLUMB_SETTING_CREATION_ONLY) != 0;
        const PlumbSetting setting = {info->name, value};
        Probe probe(c, c.available(kPlainNeeds), {0, -9.81, 0},
                    at_creation ? std::span(&setting, 1) : std::span<const PlumbSetting>{});
        PlumbSettingValue before{};
        check(probe.world(), probe.world().settings()->get_setting(info->name, before));
        if (!at_creation) {
          c.expect(equal(before, info->default_value), "{}: {} is in force at the start, {} is said to be the default",
                   info->name, value_text(before), value_text(info->default_value));
          check(probe.world(), probe.world().settings()->set_setting(info->name, value));
        }
        PlumbSettingValue after{};
        check(probe.world(), probe.world().settings()->get_setting(info->name, after));
        c.expect(equal(after, value), "{}: {} is in force", what, value_text(after));
        probe.ground();
        const PlumbShape cube = probe.lump(0.5);
        for (int i = 0; i < 3; ++i) probe.dynamic(cube, {0.1 * i, 0.5 + 1.0 * i, 0});
        probe.step(5);
      } catch (const Error& error) {
        c.expect(false, "{}: {}", what, error.what());
      }
    }
}

}  // namespace

std::span<const Check> setting_checks() {
  static constexpr Check checks[] = {
      {"settings.described", "names, docs, units, ranges and defaults", &described},
      {"settings.in_force", "every setting at its ends and choices", &in_force},
  };
  return checks;
}

}  // namespace plumb::harness::conform
