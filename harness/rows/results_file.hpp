// results*.jsonl of a folder: finished cells are appended at once, so that whatever happens next loses none of them.
// A folder may have several such files, one for each process that worked on it; all are read, one is written.
#pragma once

#include <filesystem>
#include <string>

#include "rows/results_reader.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

class ResultsFile {
 public:
  /// Makes the folder and the file, or opens what is there and reads the finished cells of all files. A line that is
  /// not an object (torn by a kill) counts for nothing. Throws UsageError when the folder cannot be used, and Error for
  /// what is no row of this format.
  explicit ResultsFile(const std::filesystem::path& folder, const std::string& name = "results.jsonl");
  ~ResultsFile();
  ResultsFile(const ResultsFile&) = delete;
  ResultsFile& operator=(const ResultsFile&) = delete;

  /// The finished row of a cell; null when there is none. Until the next refresh().
  [[nodiscard]] const Row* find(const std::string& cell_id) const { return reader_.find(cell_id); }
  /// One write a row, flushed to the disk. Throws std::system_error.
  void append(const Row& row);
  /// Reads what other processes have appended since.
  void refresh();
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  void write_all(const std::string& bytes);

  std::filesystem::path folder_, file_;
  ResultsReader reader_;
  int descriptor_ = -1;
};

}  // namespace plumb::harness
