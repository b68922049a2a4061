// A cell: one scene with its parameters on one backend with its settings. What a study is made of, and what a results
// file is asked for.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cell/description.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

struct Cell {
  std::shared_ptr<const SceneFile> scene;
  Parameters parameters;  ///< all values
  Parameters shown;       ///< those by which the cell differs from its siblings: the variant's and the user's
  std::shared_ptr<const BackendDescription> backend;
  std::string backend_build;       ///< of library and engine together
  Json settings = Json::object();  ///< asked for
  std::string profile = "default";
  std::string needs = "scene";  ///< or "all", or "scene+NAME"
  double dt = 0, seconds = 0;
  std::uint32_t threads = 1;
};

[[nodiscard]] Json json_of(const Parameters& parameters);

/// The scene with these times in place of its file's, seen by everything in the file that is worked out from them.
[[nodiscard]] Scene instantiate_with(const SceneFile& file, const Parameters& parameters, std::optional<double> dt,
                                     std::optional<double> seconds);

/// 16 hexadecimal digits over everything that makes the cell what it is: scene text, parameters, backend build,
/// settings, profile, needs, dt, seconds, threads. Equal in every process.
[[nodiscard]] std::string cell_id(const Cell& cell);

/// Files that a repetition writes; "" is none.
struct CellFiles {
  std::string trajectory, trace, timeline;
  bool layers = false;  ///< in the trajectory also what plumb.debug/1 shows
};

/// What run_cell takes.
[[nodiscard]] Json request_of(const Cell& cell, const CellFiles& files);

/// Of a library's bytes and what it says of itself, so that a rebuilt adapter is another backend.
[[nodiscard]] std::string build_id(const BackendDescription& backend);

}  // namespace plumb::harness
