// results*.jsonl of a study: finished cells are appended at once, so that whatever happens next loses none of them.
// A folder may have several such files, one for each process that worked on it; all are read, one is written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/json.hpp"

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

  /// The finished row of a cell; null when there is none. It stays where it is.
  [[nodiscard]] const Json* find(const std::string& cell_id) const;
  /// One write a row, flushed to the disk. Throws std::system_error.
  void append(const Json& row);
  /// Reads what other processes have appended since.
  void refresh();
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  struct Place {
    std::uintmax_t bytes = 0;
    std::size_t lines = 0;
  };

  void write_all(const std::string& bytes);
  void read_on(const std::filesystem::path& file);
  void take(const std::string& line, const std::filesystem::path& file, std::size_t number);

  std::filesystem::path folder_, file_;
  std::map<std::string, Json> rows_;
  std::map<std::filesystem::path, Place> read_;  ///< to where rows_ has what the files hold
  int descriptor_ = -1;
};

}  // namespace plumb::harness
