#include "scene/json_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <set>
#include <sstream>
#include <vector>

#include "scene/locate.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

namespace {

constexpr int deepest = 32;  ///< nesting of JSON that a file may have

}  // namespace

std::string read_json_text(const std::filesystem::path& path, const std::string& what) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()) || !std::filesystem::is_regular_file(path))
    throw UsageError(fmt::format("cannot read the {} file {}", what, path.string()));
  return text.str();
}

nlohmann::json parse_json(const std::filesystem::path& path, const std::string& text) {
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& value) {
    using Event = nlohmann::json::parse_event_t;
    if (depth > deepest) throw UsageError(fmt::format("{}: nested deeper than {}", path.string(), deepest));
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    if (event == Event::key && !keys.back().insert(value.get<std::string>()).second)
      throw UsageError(
          fmt::format("{}: the key \"{}\" stands twice in one object", path.string(), value.get<std::string>()));
    return true;
  };
  try {
    return nlohmann::json::parse(text, watch);
  } catch (const nlohmann::json::parse_error& error) {
    const std::string what = error.what();
    const auto colon = what.find(": ");
    throw UsageError(fmt::format("{}:{}: not valid JSON: {}", path.string(),
                                 line_of_byte(text, error.byte > 0 ? error.byte - 1 : 0),
                                 colon == std::string::npos ? what : what.substr(colon + 2)));
  } catch (const nlohmann::json::exception& error) {
    throw UsageError(fmt::format("{}: not usable JSON: {}", path.string(), error.what()));
  }
}

}  // namespace plumb::harness
