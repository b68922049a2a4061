#include "cell/description.hpp"

#include <cmath>

#include "plumb/backend/modify.hpp"
#include "plumb/backend/names.hpp"
#include "scene/build.hpp"
#include "simulation/names.hpp"

namespace plumb::harness {

namespace {

// Degrees by word, and the notes that go with them under "kind.word": as the backend has them, none left out.
class Capabilities {
 public:
  explicit Capabilities(const Backend& backend) : backend_(backend) {}

  void list(const std::string& title, PlumbCapability kind, const std::vector<std::string>& words) {
    for (std::uint32_t a = 0; a < words.size(); ++a)
      json_[title][words[a]] = degree(kind, a, 0, title + "." + words[a]);
  }
  void table(const std::string& title, PlumbCapability kind, const std::vector<std::string>& rows,
             const std::vector<std::string>& columns) {
    for (std::uint32_t a = 0; a < rows.size(); ++a) {
      for (std::uint32_t b = 0; b < columns.size(); ++b)
        json_[title][rows[a]][columns[b]] = degree(kind, a, b, title + "." + rows[a] + "." + columns[b]);
    }
  }
  /// Of bodies, then of joints, which can change in different things; then of shapes, by type.
  void changes(const std::string& title) {
    for (PlumbShapeType type = 0; type < PLUMB_SHAPE_TYPE_COUNT; ++type) {
      if (!backend::may_change(type)) continue;
      const std::string& what = shape_words()[type];
      json_[title]["shapes"][what] = degree(PLUMB_CAP_MODIFY, 2, type, title + ".shapes." + what);
    }
    for (std::uint32_t a = 0; a < 2; ++a) {
      const std::string whose = a == 0 ? "bodies" : "joints";
      const std::uint32_t count = a == 0 ? PLUMB_MODIFY_BODY_COUNT : PLUMB_MODIFY_JOINT_COUNT;
      for (std::uint32_t b = 0; b < count; ++b) {
        const std::string what = backend::modified_name(a, b);
        json_[title][whose][what] = degree(PLUMB_CAP_MODIFY, a, b, title + "." + whose + "." + what);
      }
    }
  }
  void contact_changes(const std::string& title) {
    for (std::uint32_t a = 0; a < PLUMB_MANIFOLD_CHANGE_COUNT; ++a) {
      const std::string what = backend::manifold_change_name(a);
      json_[title][what] = degree(PLUMB_CAP_MANIFOLD, a, 0, title + "." + what);
    }
  }
  void single(const std::string& title, PlumbCapability kind, std::uint32_t a = 0) {
    json_[title] = degree(kind, a, 0, title);
  }

  [[nodiscard]] Json take() {
    json_["notes"] = std::move(notes_);
    return std::move(json_);
  }

 private:
  std::string degree(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const std::string& path) {
    if (const std::string note = backend_.capability_note(kind, a, b); !note.empty()) notes_[path] = note;
    return word_of(degree_words(), static_cast<std::size_t>(backend_.capability(kind, a, b)));
  }

  const Backend& backend_;
  Json json_ = Json::object();
  Json notes_ = Json::object();
};

Json capabilities_of(const Backend& backend) {
  Capabilities all(backend);
  all.list("needs", PLUMB_CAP_NEED, need_words());
  all.table("shapes", PLUMB_CAP_SHAPE, shape_words(), motion_words());
  all.table("pairs", PLUMB_CAP_PAIR, shape_words(), shape_words());
  all.list("joints", PLUMB_CAP_JOINT, joint_words());
  all.table("joint_features", PLUMB_CAP_JOINT_FEATURE, joint_words(), joint_feature_words());
  all.table("queries", PLUMB_CAP_QUERY, query_words(), shape_words());
  all.list("closest", PLUMB_CAP_CLOSEST, shape_words());
  all.list("cooking", PLUMB_CAP_COOKING, shape_words());
  all.list("fields_read", PLUMB_CAP_FIELD_READ, field_words());
  all.list("fields_written", PLUMB_CAP_FIELD_WRITE, field_words());
  all.list("events", PLUMB_CAP_EVENT, event_words());
  all.list("phase_times", PLUMB_CAP_PHASE_TIME, phase_words());
  all.single("residual", PLUMB_CAP_RESIDUAL);
  all.single("snapshot", PLUMB_CAP_SNAPSHOT);
  all.single("world_snapshot", PLUMB_CAP_SNAPSHOT, 1);
  all.single("host_jobs", PLUMB_CAP_HOST_JOBS);
  all.single("host_memory", PLUMB_CAP_HOST_MEMORY);
  all.single("child_materials", PLUMB_CAP_CHILD_MATERIAL);
  all.single("mesh_materials", PLUMB_CAP_TRIANGLE_MATERIAL, PLUMB_TRIANGLE_MESH);
  all.single("height_field_materials", PLUMB_CAP_TRIANGLE_MATERIAL, PLUMB_HEIGHT_FIELD);
  all.changes("changes");
  all.contact_changes("contact_changes");
  return all.take();
}

Json extensions_of(const Backend& backend) {
  Json names = Json::array();
  for (const char* name : {PLUMB_EXT_JOINTS, PLUMB_EXT_QUERIES, PLUMB_EXT_COLLIDE, PLUMB_EXT_DEBUG, PLUMB_EXT_SETTINGS,
                           PLUMB_EXT_SNAPSHOT, PLUMB_EXT_STATE, PLUMB_EXT_EXCEPTIONS, PLUMB_EXT_MODIFY,
                           PLUMB_EXT_MANIFOLDS, PLUMB_EXT_WORLDS, PLUMB_EXT_CLOSEST, PLUMB_EXT_COOKING}) {
    if (backend.table().extension(name) != nullptr) names.push_back(name);
  }
  return names;
}

Json json_of_info(const PlumbSettingInfo& info) {
  Json json{{"name", info.name},
            {"type", word_of(setting_type_words(), info.type)},
            {"role", word_of(role_words(), info.role)},
            {"unit", info.unit},
            {"default", json_of(info.default_value)}};
  if (info.type == PLUMB_SETTING_INT || info.type == PLUMB_SETTING_FLOAT) {
    json["minimum"] = info.minimum;
    json["maximum"] = info.maximum;
  }
  for (std::uint32_t i = 0; i < info.choice_count; ++i) json["choices"].push_back(info.choices[i]);
  json["creation_only"] = (info.flags & PLUMB_SETTING_CREATION_ONLY) != 0;
  json["doc"] = info.doc;
  return json;
}

SettingDescription read_setting(const Json& json) {
  SettingDescription setting;
  setting.name = json.at("name");
  setting.unit = json.at("unit");
  setting.doc = json.at("doc");
  setting.type = json.at("type");
  setting.role = json.at("role");
  setting.creation_only = json.at("creation_only");
  setting.default_value = json.at("default");
  const auto number = [&](const char* key, double otherwise) {
    const auto found = json.find(key);
    return found != json.end() && found->is_number() ? found->get<double>() : otherwise;
  };
  setting.minimum = number("minimum", -HUGE_VAL);
  setting.maximum = number("maximum", HUGE_VAL);
  if (json.contains("choices")) setting.choices = json["choices"].get<std::vector<std::string>>();
  return setting;
}

}  // namespace

const SettingDescription* BackendDescription::setting(const std::string& setting_name) const {
  for (const SettingDescription& candidate : settings) {
    if (candidate.name == setting_name) return &candidate;
  }
  return nullptr;
}

std::vector<std::string> BackendDescription::setting_names() const {
  std::vector<std::string> names;
  for (const SettingDescription& setting : settings) names.push_back(setting.name);
  return names;
}

Json describe(const Backend& backend) {
  const PlumbBackendInfo& info = backend.info();
  Json json{{"name", info.name},
            {"version", info.version},
            {"status", "ok"},
            {"reason", ""},
            {"description", info.description},
            {"build", info.build},
            {"file", backend.file()},
            {"device", info.device},
            {"precision", info.precision == PLUMB_F32 ? "f32" : "f64"},
            {"max_threads", info.max_threads},
            {"determinism", word_of(determinism_words(), info.determinism)},
            {"exclusion_group", info.exclusion_group},
            {"extensions", extensions_of(backend)},
            {"settings", Json::array()},
            {"capabilities", capabilities_of(backend)}};
  for (const PlumbSettingInfo* setting : backend.settings()) json["settings"].push_back(json_of_info(*setting));
  return json;
}

BackendDescription read_description(const Json& json) {
  BackendDescription description;
  description.name = json.at("name");
  description.file = json.at("file");
  description.status = json.at("status");
  description.error = json.at("reason");
  description.version = json.at("version");
  description.build = json.at("build");
  description.device = json.at("device");
  description.max_threads = json.at("max_threads");
  for (const Json& setting : json.at("settings")) description.settings.push_back(read_setting(setting));
  description.json = json;
  return description;
}

BackendDescription broken_backend(const std::string& name, const std::string& file, const std::string& status,
                                  const std::string& error) {
  BackendDescription description;
  description.name = name;
  description.file = file;
  description.status = status;
  description.error = error;
  description.json = Json{{"name", name}, {"version", ""}, {"status", status}, {"reason", error}, {"file", file}};
  description.json["settings"] = Json::array();
  description.json["capabilities"] = Json::object();
  return description;
}

Json json_of(const PlumbSettingValue& value) {
  switch (value.type) {
    case PLUMB_SETTING_BOOL: return value.number != 0;
    case PLUMB_SETTING_INT: return static_cast<std::int64_t>(value.number);
    case PLUMB_SETTING_CHOICE: return value.choice == nullptr ? "" : value.choice;
    default: return value.number;
  }
}

PlumbSettingValue setting_value(const PlumbSettingInfo& info, const Json& json) {
  PlumbSettingValue value{};
  value.type = info.type;
  if (info.type == PLUMB_SETTING_CHOICE) {
    const auto word = json.get<std::string>();
    for (std::uint32_t i = 0; i < info.choice_count; ++i) {
      if (word == info.choices[i]) value.choice = info.choices[i];
    }
    if (value.choice == nullptr)
      throw Error(PLUMB_E_INVALID_ARGUMENT, "setting " + std::string(info.name) + " has no choice \"" + word + "\"");
  } else if (info.type == PLUMB_SETTING_BOOL) {
    value.number = json.get<bool>() ? 1 : 0;
  } else {
    value.number = json.get<double>();
  }
  return value;
}

}  // namespace plumb::harness
