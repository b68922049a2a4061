// A folder for files that are nobody's once the work is done.
#pragma once

#include <filesystem>
#include <string>

namespace plumb::harness {

class TemporaryFolder {
 public:
  /// A new one where the system keeps such, its name beginning with that. Throws UsageError where it cannot be made.
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();  ///< with all that is in it
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace plumb::harness
