#include "cli/duel/duel_replays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/format.hpp"
#include "replay/bundle.hpp"
#include "replay/parting.hpp"

namespace plumb::harness {
namespace {

using Recordings = std::array<std::optional<Trajectory>, 2>;

std::optional<Trajectory> recording_of(const Row& row, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "trajectories" / (row.origin.cell + ".plt");
  std::error_code ignored;
  if (row.origin.cell.empty() || !std::filesystem::exists(file, ignored)) return std::nullopt;
  try {
    return read_trajectory(file);
  } catch (const Error& error) {
    fmt::print(stderr, "plumb: a replay is left out: {}\n", error.what());
    return std::nullopt;
  }
}

std::string moment_text(const Parting& parting) {
  const std::string time = fmt::format("{:.3g} s", parting.seconds);
  if (std::isinf(parting.distance))
    return fmt::format("They part at {}: there {} is lost in one of them.", time, parting.body);
  const std::string where =
      fmt::format("{} is {} m from where the other engine has it", parting.body, short_number(parting.distance, 2));
  return parting.visible
             ? fmt::format("They part at {}: there {}.", time, where)
             : fmt::format("The eye does not tell them apart; they are farthest at {}, when {}.", time, where);
}

}  // namespace

void add_duel_replays(const Duel& duel, const std::filesystem::path& folder, const ReplayLimits& limits,
                      DuelPageOptions& options) {
  const std::size_t count = std::min(limits.scenes, duel.apart.size());
  if (count == 0) return;
  const std::size_t room = std::min(limits.bytes_of_replay, limits.bytes_of_all / (2 * count));
  const std::array<std::size_t, 2> colours = duel_colours(duel.names);
  std::vector<std::string> missing;
  for (std::size_t rank = 0; rank < count; ++rank) {
    const DuelPair& pair = duel.apart[rank].best.pair;
    const std::string title = pair.title();
    Recordings recordings{recording_of(*pair.rows[0], folder), recording_of(*pair.rows[1], folder)};
    if (!recordings[0] || !recordings[1]) {
      missing.push_back(title);
      continue;
    }
    if (const std::optional<Parting> parting = parting_of(*recordings[0], *recordings[1]))
      options.moments[title] = {parting->seconds, moment_text(*parting)};
    for (std::size_t side = 0; side < 2; ++side) {
      recordings[side]->header["backend"] = duel.names[side];
      options.page.replays.push_back({title, duel.names[side], bounded_bundle(*recordings[side], room), colours[side]});
    }
  }
  if (!missing.empty())
    options.page.replays_note = fmt::format(
        "Not recorded by both: {}. Runs with --record, and duels without --from, record.", fmt::join(missing, ", "));
}

}  // namespace plumb::harness
