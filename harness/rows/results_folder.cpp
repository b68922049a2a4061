#include "rows/results_folder.hpp"

#include <algorithm>
#include <string>

namespace plumb::harness {

std::vector<std::filesystem::path> results_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name == "results.jsonl" || (name.starts_with("results-") && name.ends_with(".jsonl")))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace plumb::harness
