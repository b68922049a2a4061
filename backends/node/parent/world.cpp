// Making a world, its settings, shapes, and what the child is told of exceptions.
#include "world.hpp"

#include <cstring>
#include <nlohmann/json.hpp>

#include "append.hpp"

namespace plumb::wire {
namespace {

using Json = nlohmann::json;

Json json_of(const PlumbSettingValue& value) {
  if (value.type == PLUMB_SETTING_CHOICE) return value.choice;
  if (value.type == PLUMB_SETTING_BOOL) return value.number != 0;
  return value.number;
}

std::size_t place_of(std::span<const PlumbSettingInfo> infos, const char* name) {
  std::size_t place = 0;
  while (std::strcmp(infos[place].name, name) != 0) ++place;
  return place;
}

}  // namespace

World::World(const WorldInit& init, const Manifest& manifest, const std::vector<std::string>& command)
    : setting_infos_(manifest.settings().begin(), manifest.settings().end()),
      setting_values_(init.values),
      deadline_(init.setting(kDeadlineSetting).number),
      manifest_(manifest),
      child_(command),
      needs_(init.desc.needs) {
  Json settings = Json::object();
  for (std::size_t i = 0; i < setting_infos_.size(); ++i)
    if (std::strcmp(setting_infos_[i].name, kDeadlineSetting) != 0)
      settings[setting_infos_[i].name] = json_of(setting_values_[i]);
  std::vector<double> row = {double(needs_)};
  append(row, init.desc.gravity);
  row.insert(row.end(), {double(init.desc.body_capacity), double(init.desc.joint_capacity)});
  call(Call::kCreateWorld, row, settings.dump());
}

Frame World::call(Call what, std::span<const double> numbers, const std::string& text) {
  const std::lock_guard lock(one_call_);
  return child_.call(what, text, numbers, std::chrono::duration<double>(deadline_));
}

PlumbResult World::get_setting(const char* name, PlumbSettingValue& value) {
  return value = setting_values_[place_of(setting_infos_, name)], PLUMB_OK;
}

PlumbResult World::set_setting(const char* name, const PlumbSettingValue& value) {
  const std::size_t place = place_of(setting_infos_, name);
  if (std::strcmp(name, kDeadlineSetting) == 0)
    deadline_ = value.number;
  else
    call(Call::kSetSetting, {}, Json{{name, json_of(value)}}.dump());
  setting_values_[place] = value;
  return PLUMB_OK;
}

PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  std::vector<double> row;
  append(row, gravity);
  call(Call::kSetGravity, row);
  return PLUMB_OK;
}

PlumbResult World::create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) {
  std::vector<double> rows = {double(descs.size())};
  for (std::size_t i = 0; i < descs.size(); ++i) append_shape(rows, slot_of(ids[i]), descs[i]);
  call(Call::kCreateShapes, rows);
  return PLUMB_OK;
}

PlumbResult World::destroy_shapes(std::span<const PlumbShape> ids) {
  std::vector<double> slots;
  for (const PlumbShape id : ids) slots.push_back(slot_of(id));
  call(Call::kDestroyShapes, slots);
  return PLUMB_OK;
}

PlumbResult World::set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) {
  std::vector<double> row = {touch ? 1.0 : 0.0};
  for (const PlumbBodyPair& pair : pairs)
    row.insert(row.end(), {double(slot_of(pair.body_a)), double(slot_of(pair.body_b))});
  call(Call::kExceptions, row);
  return PLUMB_OK;
}

}  // namespace plumb::wire
