// JSON files that people write (scenes, studies): read whole, and refused with the line where they go wrong.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace plumb::harness {

/// The file's text. Throws UsageError "cannot read the <what> file <path>".
[[nodiscard]] std::string read_json_text(const std::filesystem::path& path, const std::string& what);

/// Parses, and refuses what the JSON library lets pass: a key twice in one object, and bottomless nesting. Throws
/// UsageError with path and line.
[[nodiscard]] nlohmann::json parse_json(const std::filesystem::path& path, const std::string& text);

}  // namespace plumb::harness
