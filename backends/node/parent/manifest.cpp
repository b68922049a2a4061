#include "manifest.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "plumb/nearest.hpp"
#include "words.hpp"

namespace plumb::wire {
namespace {

using Json = nlohmann::json;

constexpr const char* kWire = "plumb.wire/1";

std::uint32_t number_of(Words words, const std::string& word, const char* what) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::uint32_t>(found - words.begin());
  throw Error(PLUMB_E_CORRUPT, std::string("the manifest has \"") + word + "\" where " + what + " is expected" +
                                   suggestion(word, {words.begin(), words.end()}));
}

/// "box|hull" as numbers; "*" as any.
std::vector<int> numbers_of(Words words, const std::string& text, const char* what) {
  if (text == "*") return {-1};
  std::vector<int> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('|', at), text.size());
    numbers.push_back(static_cast<int>(number_of(words, text.substr(at, end - at), what)));
    at = end + 1;
  }
  return numbers;
}

/// [kind, first, second, degree, note?]
Rule rule_of(const Json& json) {
  const auto kind = number_of(kKindWords, json.at(0), "a kind of capability");
  const ArgumentWords words = argument_words(kind);
  return {kind, numbers_of(words.first, json.at(1), "a first argument"),
          numbers_of(words.second, json.at(2), "a second argument"),
          static_cast<PlumbDegree>(number_of(kDegreeWords, json.at(3), "a degree")),
          json.size() > 4 ? json.at(4).get<std::string>() : ""};
}

bool fits(const std::vector<int>& numbers, std::uint32_t argument) {
  return std::any_of(numbers.begin(), numbers.end(),
                     [&](int number) { return number < 0 || static_cast<std::uint32_t>(number) == argument; });
}

bool fits(const Rule& rule, PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  if (rule.kind != kind) return false;
  const bool symmetric = kind == PLUMB_CAP_PAIR;
  return (fits(rule.first, a) && fits(rule.second, b)) || (symmetric && fits(rule.first, b) && fits(rule.second, a));
}

/// Fields that the parent makes of velocities and of what a step takes.
bool acts(PlumbField field) {
  return (field >= PLUMB_FIELD_FORCE && field <= PLUMB_FIELD_IMPULSE_AT_POINT) || field == PLUMB_FIELD_KINEMATIC_TARGET;
}

}  // namespace

Manifest::Manifest(const std::string& text, const std::string& backend_name) try {
  const Json json = Json::parse(text);
  const std::string wire = json.at("wire");
  if (wire != kWire)
    throw Error(PLUMB_E_VERSION, "the child of " + backend_name + " speaks " + wire + " and this backend " + kWire +
                                     "; take those of one release");
  unmet_ = json.value("unmet", "");
  info_.struct_size = sizeof info_;
  info_.name = keep(backend_name);
  info_.version = keep(json.at("version"));
  info_.build = keep(json.at("build"));
  info_.description = keep(json.at("description"));
  info_.device = keep(json.value("device", "cpu"));
  info_.exclusion_group = "";
  info_.precision = PLUMB_F64;
  if (json.at("precision") == "f32") info_.precision = PLUMB_F32;
  if (json.value("deterministic", false)) info_.determinism = PLUMB_DETERMINISM_RUN;
  info_.max_threads = 1;
  for (const Json& rule : json.at("capabilities")) rules_.push_back(rule_of(rule));
  for (const Json& field : json.value("takes", Json::array()))
    takes_ |= 1u << number_of(kFieldWords, field.get<std::string>(), "a field");

  constexpr const char* types[] = {"bool", "int", "float", "choice"};
  constexpr const char* roles[] = {"quality", "speed", "behaviour"};
  for (const Json& given : json.at("settings")) {
    PlumbSettingInfo setting{};
    setting.name = keep(given.at("name"));
    setting.unit = keep(given.value("unit", ""));
    setting.doc = keep(given.at("doc"));
    setting.type = setting.default_value.type = number_of(types, given.at("type"), "a type of setting");
    setting.role = number_of(roles, given.at("role"), "a role");
    if (given.value("creation_only", false)) setting.flags = PLUMB_SETTING_CREATION_ONLY;
    const Json& standard = given.at("default");
    if (setting.type == PLUMB_SETTING_CHOICE) {
      words_.emplace_back();
      for (const Json& word : given.at("choices")) words_.back().push_back(keep(word));
      setting.choices = words_.back().data();
      setting.choice_count = static_cast<std::uint32_t>(words_.back().size());
      setting.default_value.choice =
          setting.choices[number_of(words_.back(), standard.get<std::string>(), "one of the setting's choices")];
    } else if (setting.type == PLUMB_SETTING_BOOL) {
      setting.maximum = 1;
      setting.default_value.number = standard.get<bool>() ? 1 : 0;
    } else {
      setting.minimum = given.at("minimum");
      setting.maximum = given.at("maximum");
      setting.default_value.number = standard;
    }
    add_setting(setting);
  }
  PlumbSettingInfo deadline{};
  deadline.name = kDeadlineSetting;
  deadline.unit = "s";
  deadline.doc = "seconds that one call may take; a child that takes longer is killed, and its world is lost";
  deadline.type = deadline.default_value.type = PLUMB_SETTING_FLOAT;
  deadline.role = PLUMB_ROLE_SPEED;
  deadline.minimum = 5;
  deadline.maximum = 1e6;
  deadline.default_value.number = 60;
  add_setting(deadline);
} catch (const Json::exception& error) {
  throw Error(PLUMB_E_CORRUPT, "the child of " + backend_name + " gave no manifest of " + kWire + ": " + error.what());
}

const char* Manifest::keep(std::string text) { return texts_.emplace_back(std::move(text)).c_str(); }

const Rule* Manifest::rule_for(PlumbCapability kind, std::uint32_t a, std::uint32_t b) const {
  const auto found =
      std::find_if(rules_.rbegin(), rules_.rend(), [&](const Rule& rule) { return fits(rule, kind, a, b); });
  return found == rules_.rend() ? nullptr : &*found;
}

backend::Capability Manifest::of_child(PlumbCapability kind, std::uint32_t a, std::uint32_t b) const {
  const Rule* rule = rule_for(kind, a, b);
  if (rule == nullptr) return {PLUMB_NONE, "the adapter does not offer it"};
  return {rule->degree, rule->note.c_str()};
}

backend::Capability Manifest::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b) const {
  if (kind == PLUMB_CAP_PHASE_TIME) {
    if (a == PLUMB_PHASE_SOLVE) return {PLUMB_APPROXIMATE, "the engine's whole step, timed inside its process"};
    return {PLUMB_NONE, "the phase \"solve\" holds the engine's whole step"};
  }
  const backend::Capability usual = backend::usual_capability(kind, a, b);
  const bool rolling =
      (kind == PLUMB_CAP_FIELD_READ || kind == PLUMB_CAP_FIELD_WRITE) && a == PLUMB_FIELD_ROLLING_FRICTION;
  const bool own_work = (kind == PLUMB_CAP_NEED && a < PLUMB_NEED_COUNT) ||  // what an engine must do something for
                        rolling ||
                        (kind == PLUMB_CAP_JOINT_FEATURE && b == PLUMB_JOINT_HAS_STIFFNESS &&
                         backend::free_axes(a) != 0 && a < PLUMB_JOINT_SWING_TWIST);
  if (usual.degree == PLUMB_NONE && !own_work) {
    const Rule* rule = rule_for(kind, a, b);  // whose reason is nearer to the matter
    return rule != nullptr && rule->degree == PLUMB_NONE && !rule->note.empty() ? of_child(kind, a, b) : usual;
  }
  if (rolling) return of_child(PLUMB_CAP_FIELD_WRITE, a, b);  // what is written is read here
  if (kind == PLUMB_CAP_FIELD_READ && a > PLUMB_FIELD_KINEMATIC_TARGET) return usual;
  if (kind == PLUMB_CAP_FIELD_WRITE && acts(a) && takes(a)) return {PLUMB_NATIVE};
  if (kind == PLUMB_CAP_FIELD_WRITE && acts(a)) return {PLUMB_EMULATED, "by velocities, poses and the step's forces"};
  return of_child(kind, a, b);
}

}  // namespace plumb::wire
