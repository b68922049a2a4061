// JSON in this program keeps the order of its keys, one object a line; numbers that are not finite become null.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace plumb::harness {

using Json = nlohmann::ordered_json;

/// One line without its end. Text of engines that is not UTF-8 is mended, not refused.
[[nodiscard]] inline std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A value as people type it: a word without quotes.
[[nodiscard]] inline std::string typed_text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace plumb::harness
