// Which files of a folder hold rows, for those who write them and those who read them.
#pragma once

#include <filesystem>
#include <vector>

namespace plumb::harness {

/// results.jsonl and results-*.jsonl of a folder, in the order of their names: each process that works on a study has a
/// file of its own. None where there is no such folder.
[[nodiscard]] std::vector<std::filesystem::path> results_files(const std::filesystem::path& folder);

}  // namespace plumb::harness
