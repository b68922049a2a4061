// The recorded trajectories of a results folder as replays for its page.
#pragma once

#include <filesystem>

#include "report/page/parts/page_options.hpp"

namespace plumb::harness {

struct ReplayLimits {
  std::size_t scenes = 1000;               ///< at most so many (scene, parameters), pairs of shapes apart
  std::size_t bytes_of_replay = 1u << 20;  ///< packed; 4/3 of it in the page
  std::size_t bytes_of_all = 9u << 19;
};

/// Sets options.replays, replays_note, and worlds, of those that impulse ran, from FOLDER/trajectories: of every scene
/// with its parameters one replay a backend, the one with the fewest settings changed. The smallest variant of each
/// scene comes first, then the others, smallest first, until the limits are reached. Files that cannot be read are told
/// on standard error.
void add_replays(const std::filesystem::path& folder, const ReplayLimits& limits, PageOptions& options);

}  // namespace plumb::harness
