// Recordings of a duel's scenes as replays of its page, and the moment where they part.
#pragma once

#include <filesystem>

#include "cli/verbs/page_replays.hpp"
#include "report/page/duel_page.hpp"

namespace plumb::harness {

/// Sets replays, moments and the note of the options from FOLDER/trajectories for the first limits.scenes scenes that
/// tell the engines apart, both engines in equal room. A scene of which a recording is missing has no replay. Files
/// that cannot be read are told on standard error.
void add_duel_replays(const Duel& duel, const std::filesystem::path& folder, const ReplayLimits& limits,
                      DuelPageOptions& options);

}  // namespace plumb::harness
