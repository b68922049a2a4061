// A backend's settings as a list: what the host is told of each, and which member of a struct holds it.
//
//   // A choice is the number of its word.
//   struct Settings { int iterations; double erp; bool warm_starting; Solver solver; };
//   const SettingsTable<Settings>& table() {
//     static const SettingsTable<Settings> all = {
//         setting<&Settings::iterations>(int_setting("iterations", "1", PLUMB_ROLE_QUALITY, 1, 1000, 10, "passes")),
//         ...};
//     return all;
//   }
//
// Then World::setting_infos() answers table().infos(), its constructor takes table().values(init), and get_setting and
// set_setting are one line each. The guard has looked at names, types and ranges before.
#pragma once

#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "plumb/backend/world_init.hpp"

namespace plumb::backend {

/// flags of these: PLUMB_SETTING_CREATION_ONLY or 0. Texts and words must live as long as the process.
[[nodiscard]] constexpr PlumbSettingInfo int_setting(const char* name, const char* unit, PlumbSettingRole role,
                                                     double least, double most, double standard, const char* doc,
                                                     std::uint32_t flags = 0) {
  PlumbSettingInfo info{};
  info.name = name;
  info.unit = unit;
  info.doc = doc;
  info.type = info.default_value.type = PLUMB_SETTING_INT;
  info.role = role;
  info.flags = flags;
  info.minimum = least;
  info.maximum = most;
  info.default_value.number = standard;
  return info;
}

[[nodiscard]] constexpr PlumbSettingInfo float_setting(const char* name, const char* unit, PlumbSettingRole role,
                                                       double least, double most, double standard, const char* doc,
                                                       std::uint32_t flags = 0) {
  PlumbSettingInfo info = int_setting(name, unit, role, least, most, standard, doc, flags);
  info.type = info.default_value.type = PLUMB_SETTING_FLOAT;
  return info;
}

[[nodiscard]] constexpr PlumbSettingInfo bool_setting(const char* name, PlumbSettingRole role, bool standard,
                                                      const char* doc, std::uint32_t flags = 0) {
  PlumbSettingInfo info = int_setting(name, "", role, 0, 1, standard ? 1 : 0, doc, flags);
  info.type = info.default_value.type = PLUMB_SETTING_BOOL;
  return info;
}

/// standard: which of the words is the default.
[[nodiscard]] constexpr PlumbSettingInfo choice_setting(const char* name, PlumbSettingRole role,
                                                        std::span<const char* const> words, const char* doc,
                                                        std::uint32_t flags = 0, std::size_t standard = 0) {
  PlumbSettingInfo info = int_setting(name, "", role, 0, 0, 0, doc, flags);
  info.type = info.default_value.type = PLUMB_SETTING_CHOICE;
  info.choices = words.data();
  info.choice_count = static_cast<std::uint32_t>(words.size());
  info.default_value.choice = words[standard];
  return info;
}

/// The place of a value's word among the words of its setting.
[[nodiscard]] inline std::uint32_t word_number(const PlumbSettingInfo& info, const char* word) {
  for (std::uint32_t i = 0; i < info.choice_count; ++i)
    if (std::strcmp(info.choices[i], word) == 0) return i;
  throw Error(PLUMB_E_INTERNAL, std::string(word) + " is no word of the setting " + info.name);
}

/// One row of a table: a setting, and how the struct is read and written. Numbers travel as double.
template <class Settings>
struct SettingRow {
  PlumbSettingInfo info;
  double (*get)(const Settings& settings);
  void (*set)(Settings& settings, double number);
};

template <class T>
struct MemberOf;
template <class Settings, class Value>
struct MemberOf<Value Settings::*> {
  using Of = Settings;
  using Type = Value;
};

/// The row of a setting that lies in a member: a number, a bool or an enumeration.
template <auto Member>
[[nodiscard]] constexpr auto setting(const PlumbSettingInfo& info) {
  using Settings = typename MemberOf<decltype(Member)>::Of;
  using Value = typename MemberOf<decltype(Member)>::Type;
  return SettingRow<Settings>{info, [](const Settings& from) { return static_cast<double>(from.*Member); },
                              [](Settings& to, double number) { to.*Member = static_cast<Value>(number); }};
}

template <class Settings>
class SettingsTable {
 public:
  SettingsTable(std::initializer_list<SettingRow<Settings>> rows) : rows_(rows) {
    for (const SettingRow<Settings>& row : rows_) infos_.push_back(row.info);
  }

  [[nodiscard]] std::span<const PlumbSettingInfo> infos() const { return infos_; }

  /// As a world begins. Members without a row stay as the struct makes them.
  [[nodiscard]] Settings values(const WorldInit& init) const {
    Settings settings{};
    for (std::size_t i = 0; i < init.infos.size(); ++i) set(settings, init.infos[i].name, init.values[i]);
    return settings;
  }

  /// Throws Error (PLUMB_E_INTERNAL) for a name that the table has not; so does get.
  void set(Settings& settings, const char* name, const PlumbSettingValue& value) const {
    const SettingRow<Settings>& row = row_of(name);
    const bool chosen = row.info.type == PLUMB_SETTING_CHOICE;
    row.set(settings, chosen ? word_number(row.info, value.choice) : value.number);
  }

  [[nodiscard]] PlumbSettingValue get(const Settings& settings, const char* name) const {
    const SettingRow<Settings>& row = row_of(name);
    const double number = row.get(settings);
    if (row.info.type != PLUMB_SETTING_CHOICE) return {row.info.type, 0, number, nullptr};
    return {row.info.type, 0, 0, row.info.choices[static_cast<std::size_t>(number)]};
  }

 private:
  [[nodiscard]] const SettingRow<Settings>& row_of(const char* name) const {
    for (const SettingRow<Settings>& row : rows_)
      if (std::strcmp(row.info.name, name) == 0) return row;
    throw Error(PLUMB_E_INTERNAL, std::string("the backend lists no setting ") + name);
  }

  std::vector<SettingRow<Settings>> rows_;
  std::vector<PlumbSettingInfo> infos_;
};

}  // namespace plumb::backend
