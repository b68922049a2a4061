#include "base/temporary_folder.hpp"

#include <cstdlib>
#include <system_error>

#include "base/usage_error.hpp"

namespace plumb::harness {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const std::string& name) {
  std::string made = (fs::temp_directory_path() / (name + "-XXXXXX")).string();
  if (mkdtemp(made.data()) == nullptr)
    throw UsageError("cannot make a folder in " + fs::temp_directory_path().string());
  path_ = made;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace plumb::harness
