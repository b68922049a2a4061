#include "cli/verbs/page_replays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/format.hpp"
#include "cli/live/page_worlds.hpp"
#include "replay/bundle.hpp"
#include "replay/title.hpp"

namespace plumb::harness {

namespace {

constexpr std::size_t least_room = 64 << 10;  // bytes: less shows nothing that moves well

struct Recorded {
  std::filesystem::path file;
  std::string label;
};
struct RecordedScene {
  std::string id, title;
  std::map<std::string, Recorded> backends;
  std::uintmax_t bytes = 0;
  bool is_pair = false;   ///< of shapes, from plumb pairs
  std::size_t place = 0;  ///< among those of the same id, smallest first
};

std::vector<RecordedScene> recorded_scenes(const std::filesystem::path& folder) {
  std::map<std::string, RecordedScene> by_title;
  std::vector<std::filesystem::path> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "trajectories", none))
    if (entry.path().extension() == ".plt") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    try {
      const Json header = read_trajectory_header(file);
      RecordedScene& scene = by_title[replay_title(header)];
      scene.id = header.value("scene", "");
      scene.title = replay_title(header);
      scene.is_pair = header.value("kind", "") == "pairs";
      const std::string label = header.value("label", "");
      Recorded& mine = scene.backends[header.value("backend", "")];
      if (mine.file.empty() || label.size() < mine.label.size()) mine = {file, label};
    } catch (const Error& error) {
      fmt::print(stderr, "plumb: a replay is left out: {}\n", error.what());
    }
  }
  std::vector<RecordedScene> scenes;
  for (auto& [title, scene] : by_title) {
    for (const auto& [backend, recorded] : scene.backends) scene.bytes += std::filesystem::file_size(recorded.file);
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

void put_in_order(std::vector<RecordedScene>& scenes) {
  std::stable_sort(scenes.begin(), scenes.end(), [](const auto& a, const auto& b) { return a.bytes < b.bytes; });
  std::map<std::string, std::size_t> places;
  for (RecordedScene& scene : scenes) scene.place = places[scene.id]++;
  std::stable_sort(scenes.begin(), scenes.end(), [](const auto& a, const auto& b) { return a.place < b.place; });
}

}  // namespace

void add_replays(const std::filesystem::path& folder, const ReplayLimits& limits, PageOptions& options) {
  std::vector<RecordedScene> scenes = recorded_scenes(folder);
  put_in_order(scenes);
  std::size_t taken = 0, bytes = 0;
  std::vector<std::string> left_out;
  std::vector<Json> run_by_impulse;
  for (const RecordedScene& scene : scenes) {
    std::vector<PageReplay> replays;
    std::size_t size = 0;
    std::optional<Json> by_impulse;
    // The room that is left is for all engines alike: a replay alone has nothing to be compared with.
    const std::size_t room = std::min(limits.bytes_of_replay, (limits.bytes_of_all - bytes) / scene.backends.size());
    for (const auto& [backend, recorded] : scene.backends) {
      if ((taken == limits.scenes && !scene.is_pair) || room < least_room) break;
      const Trajectory trajectory = read_trajectory(recorded.file);
      replays.push_back({scene.title, backend, bounded_bundle(trajectory, room)});
      size += replays.back().bundle.size();
      if (backend == "impulse" && !scene.is_pair) by_impulse = trajectory.header;
    }
    if (replays.empty() || bytes + size > limits.bytes_of_all) {
      left_out.push_back(scene.title);
      continue;
    }
    if (!scene.is_pair) ++taken;
    bytes += size;
    if (by_impulse) run_by_impulse.push_back(std::move(*by_impulse));
    std::move(replays.begin(), replays.end(), std::back_inserter(options.replays));
  }
  std::stable_sort(options.replays.begin(), options.replays.end(), [](const PageReplay& a, const PageReplay& b) {
    return a.scene != b.scene && natural_less(a.scene, b.scene);
  });
  options.worlds = worlds_of_recordings(run_by_impulse);
  if (!left_out.empty())
    options.replays_note =
        fmt::format("Recorded, too, but left out to keep the page small: {}.", fmt::join(left_out, ", "));
}

}  // namespace plumb::harness
