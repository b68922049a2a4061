// Reading results.jsonl, which a run that is still going or was killed may be writing.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "base/json.hpp"

namespace plumb::harness {

struct Results {
  std::vector<Json> rows;                     ///< objects, one a cell, in the order of the file
  std::vector<std::size_t> unreadable_lines;  ///< from 1; other than a torn last line, which a kill leaves behind
};

/// One row a line; empty lines count for nothing. A cell that was run again replaces its earlier row in place. Throws
/// Error naming `file` and the line for what is no row of this format.
[[nodiscard]] Results read_results(std::istream& in, const std::filesystem::path& file);
/// `where` is the file, or a folder: all results*.jsonl in it, of which each rank of a study may have written one, in
/// the order of their names, and before them those packed by zstd. Unreadable lines are counted over all of them.
/// Throws UsageError when nothing can be opened, and Error likewise.
[[nodiscard]] Results read_results(const std::filesystem::path& where);

/// DIR/study.json as it is; null where `where` is no folder, or has none that is an object.
[[nodiscard]] Json read_study(const std::filesystem::path& where);

}  // namespace plumb::harness
