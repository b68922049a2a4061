// Reading results.jsonl, which a run that is still going or was killed may be writing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

struct Results {
  std::vector<Row> rows;                      ///< one a cell and machine, in the order of the files
  std::vector<std::size_t> unreadable_lines;  ///< from 1; other than a torn last line, which a kill leaves behind
};

/// Gathers rows from files, which may still grow. What is run again replaces its earlier row in place.
class ResultsReader {
 public:
  /// Reads a whole text. Empty lines count for nothing. Throws Error naming `file` and the line for what is no row of
  /// this format.
  void read(std::istream& in, const std::filesystem::path& file);
  /// What the file has gained since it was last read; a torn last line waits for its end. Throws likewise.
  void read_on(const std::filesystem::path& file);

  /// The latest row of a cell on any machine; null when there is none. Until more is read.
  [[nodiscard]] const Row* find(const std::string& cell_id) const;
  [[nodiscard]] const Results& results() const { return results_; }
  [[nodiscard]] Results take() { return std::move(results_); }

 private:
  /// To where a file was read.
  struct Place {
    std::uintmax_t bytes = 0;
    std::size_t lines = 0;
  };

  void read_lines(std::istream& in, const std::filesystem::path& file, Place& place);
  void take_line(const std::string& line, const std::filesystem::path& file, std::size_t number, bool torn);

  Results results_;
  std::unordered_map<std::string, std::size_t> places_;  ///< of rows, by row_key()
  std::unordered_map<std::string, std::size_t> latest_;  ///< likewise, by cell alone
  std::map<std::filesystem::path, Place> read_;
};

[[nodiscard]] Results read_results(std::istream& in, const std::filesystem::path& file);
/// `where` is the file, or a folder: all results*.jsonl in it, of which each rank of a study may have written one, in
/// the order of their names, and before them those packed by zstd. Unreadable lines are counted over all of them.
/// Throws UsageError when nothing can be opened, and Error likewise.
[[nodiscard]] Results read_results(const std::filesystem::path& where);

/// DIR/study.json as it is; null where `where` is no folder, or has none that is an object.
[[nodiscard]] Json read_study(const std::filesystem::path& where);

}  // namespace plumb::harness
