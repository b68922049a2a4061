// The backends of a run: which files, and what each says of itself, asked in a worker of its own.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cell/description.hpp"
#include "worker/worker_process.hpp"

namespace plumb::harness {

/// Asks a worker of its own what a backend is; whatever goes wrong stands in the description.
[[nodiscard]] BackendDescription ask_description(const std::string& name, const std::string& file,
                                                 const WorkerLimits& limits);

/// The files of backends that were asked for by name or path, or all on the search path. Throws UsageError.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> backend_files(const std::vector<std::string>& asked);

/// Those that load, and those that do not and were not asked for by name.
struct OpenedBackends {
  std::vector<BackendDescription> usable, broken;
};
/// asked: names or files; none: all. Throws UsageError when there are none at all.
[[nodiscard]] OpenedBackends open_backends(const std::vector<std::string>& asked, const WorkerLimits& limits);

/// A backend's description and its build id: what all cells of it share.
struct BuiltBackend {
  std::shared_ptr<const BackendDescription> description;
  std::string build;
};
[[nodiscard]] std::vector<BuiltBackend> build_ids(std::vector<BackendDescription> backends);

}  // namespace plumb::harness
