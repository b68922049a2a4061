// Runs the program and gathers what it said.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.hpp"

namespace plumb::harness::testing {

struct Finished {
  int status = -1;  ///< exit status, or 128 + signal
  std::string out, err;
  [[nodiscard]] std::vector<Json> rows() const;  ///< of lines of out
};

using Environment = std::vector<std::pair<std::string, std::string>>;

/// Runs `plumb ARGUMENTS` to its end.
[[nodiscard]] Finished plumb(const std::vector<std::string>& arguments, const Environment& environment = {});

/// Starts it and does not wait; its output goes nowhere. The caller waits for the process.
[[nodiscard]] pid_t start_plumb(const std::vector<std::string>& arguments, const Environment& environment = {});

/// A new empty folder for one test.
[[nodiscard]] std::filesystem::path fresh_folder(const std::string& name);

/// A scene of falling particles that any backend can run: a file in `folder`.
[[nodiscard]] std::string particle_scene(const std::filesystem::path& folder);

}  // namespace plumb::harness::testing
