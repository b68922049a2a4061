#include "hosts/gazebo/world/engine.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <map>

namespace plumb::gazebo {
namespace {

namespace fs = std::filesystem;

/// The host's program may be anywhere, so the loader, which looks beside it, may find nothing.
fs::path folder_beside_plugin() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&open_engine), &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code error;
  return fs::weakly_canonical(info.dli_fname, error).parent_path() / "plumb";
}

std::map<std::string, std::string> installed() {
  std::map<std::string, std::string> files;
  for (const FoundBackend& found : find_backends()) files.emplace(found.name, found.file);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_beside_plugin(), error)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".so" && stem.starts_with("plumb-"))
      files.emplace(stem.substr(6), entry.path().string());
  }
  return files;
}

}  // namespace

std::string default_engine() {
  const char* given = std::getenv("PLUMB_GAZEBO_BACKEND");
  return given != nullptr && *given != '\0' ? given : "impulse";
}

Backend open_engine(const std::string& name) {
  if (fs::path(name).has_parent_path()) return open_backend(name);
  const auto files = installed();
  if (const auto found = files.find(name); found != files.end()) return open_backend(found->second);
  std::string names;
  for (const auto& [other, file] : files) names += (names.empty() ? "" : ", ") + other;
  throw Error(PLUMB_E_INVALID_ARGUMENT,
              "no backend is called \"" + name + "\"; " +
                  (names.empty() ? "none was found: set PLUMB_BACKEND_PATH to the folder that holds plumb-*.so"
                                 : "set PLUMB_GAZEBO_BACKEND to one of those installed: " + names));
}

}  // namespace plumb::gazebo
