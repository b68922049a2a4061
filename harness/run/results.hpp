// results.jsonl of a study: finished cells are appended at once, so that whatever happens next loses none of them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "run/json.hpp"

namespace plumb::harness {

class ResultsFile {
 public:
  /// Makes the folder and the file, or opens what is there and reads its finished cells. A line that is not an object
  /// (torn by a kill) counts for nothing. Throws UsageError when the folder cannot be used.
  explicit ResultsFile(const std::filesystem::path& folder);
  ~ResultsFile();
  ResultsFile(const ResultsFile&) = delete;
  ResultsFile& operator=(const ResultsFile&) = delete;

  /// The finished row of a cell; null when there is none.
  [[nodiscard]] const Json* find(const std::string& cell_id) const;
  /// One write a row, flushed to the disk. Throws std::system_error.
  void append(const Json& row);
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  void write_all(const std::string& bytes);

  std::filesystem::path folder_;
  std::map<std::string, Json> rows_;
  int descriptor_ = -1;
};

}  // namespace plumb::harness
