// Which files of a folder hold rows, and what is in those that are packed, for those who write rows and those who read
// them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::harness {

/// results.jsonl and results-*.jsonl of a folder, in the order of their names: each process that works on a study has a
/// file of its own. Before them those that were packed for keeping, with .zst at the end. None where there is no such
/// folder.
[[nodiscard]] std::vector<std::filesystem::path> results_files(const std::filesystem::path& folder);

/// A file that was packed with zstd; no process writes to it.
[[nodiscard]] bool is_packed(const std::filesystem::path& file);
/// What was packed. Throws Error(PLUMB_E_CORRUPT) where the file is cut short or no zstd, naming it.
[[nodiscard]] std::string unpacked_text(const std::filesystem::path& file);

}  // namespace plumb::harness
