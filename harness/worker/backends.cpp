#include "worker/backends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/usage_error.hpp"
#include "cell/cell.hpp"
#include "plumb/loader.hpp"
#include "plumb/nearest.hpp"

namespace plumb::harness {

BackendDescription ask_description(const std::string& name, const std::string& file, const WorkerLimits& limits) {
  WorkerProcess worker(file);
  const Answer answer = worker.ask({{"request", "describe"}}, limits);
  if (answer.status != "ok") return broken_backend(name, file, answer.status, answer.reason);
  try {
    if (answer.json.at("status") != "ok")
      return broken_backend(name, file, answer.json.at("status"), answer.json.at("reason"));
    return read_description(answer.json);
  } catch (const Json::exception& error) {
    return broken_backend(name, file, "error", std::string("its description is malformed: ") + error.what());
  }
}

std::vector<std::pair<std::string, std::string>> backend_files(const std::vector<std::string>& asked) {
  const std::vector<FoundBackend> found = find_backends();
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<std::string> names;
  for (const FoundBackend& backend : found) names.push_back(backend.name);
  if (asked.empty()) {
    for (const FoundBackend& backend : found) files.emplace_back(backend.name, backend.file);
    return files;
  }
  for (const std::string& what : asked) {
    const bool is_file = what.find('/') != std::string::npos || what.ends_with(".so");
    if (is_file) {
      const std::filesystem::path path(what);
      if (!std::filesystem::exists(path)) throw UsageError("--backend " + what + ": there is no such file");
      std::string name = path.stem().string();
      if (name.starts_with("plumb-")) name.erase(0, 6);
      files.emplace_back(name, std::filesystem::absolute(path).string());
      continue;
    }
    const auto at = std::find(names.begin(), names.end(), what);
    if (at == names.end()) throw UsageError(fmt::format("there is no backend \"{}\"{}", what, suggestion(what, names)));
    files.emplace_back(what, found[static_cast<std::size_t>(at - names.begin())].file);
  }
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

OpenedBackends open_backends(const std::vector<std::string>& asked, const WorkerLimits& limits) {
  OpenedBackends opened;
  for (const auto& [name, file] : backend_files(asked)) {
    BackendDescription backend = ask_description(name, file, limits);
    const bool unasked = asked.empty() && !backend.error.empty();
    (unasked ? opened.broken : opened.usable).push_back(std::move(backend));
  }
  if (opened.usable.empty()) {
    std::string folders;
    for (const auto& folder : backend_path()) folders += (folders.empty() ? "" : ", ") + folder;
    throw UsageError("no backend loads; looked in " + (folders.empty() ? "no folder" : folders) +
                     "; name one by --backend FILE or set PLUMB_BACKEND_PATH");
  }
  return opened;
}

std::vector<BuiltBackend> build_ids(std::vector<BackendDescription> backends) {
  std::vector<BuiltBackend> built;
  for (BackendDescription& backend : backends) {
    std::string build = build_id(backend);
    built.push_back({std::make_shared<const BackendDescription>(std::move(backend)), std::move(build)});
  }
  return built;
}

}  // namespace plumb::harness
