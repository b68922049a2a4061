// The line of a value in a JSON text, for error messages: the JSON library does not keep it.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

namespace plumb::harness {

/// Keys and indices from the root to a value.
using JsonPath = std::vector<std::variant<std::string, std::size_t>>;

/// The path to the value at this address inside root; empty when it is root itself or not in it.
[[nodiscard]] JsonPath path_to(const nlohmann::json& root, const nlohmann::json* value);

/// The path as people write it: bodies[1].density; "" for the root.
[[nodiscard]] std::string text_of(const JsonPath& path);

/// Line (from 1) on which the value, or the key of a member, begins; that of the deepest part of the path that exists.
/// The text must be valid JSON.
[[nodiscard]] std::size_t line_of(const std::string& text, const JsonPath& path);

/// Line of a byte (from 0) of a text.
[[nodiscard]] std::size_t line_of_byte(const std::string& text, std::size_t byte);

}  // namespace plumb::harness
