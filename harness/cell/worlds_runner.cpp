#include "cell/worlds_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "base/median.hpp"
#include "cell/machine.hpp"
#include "cell/request.hpp"
#include "plumb/helpers/worlds.hpp"

namespace plumb::harness {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::uint64_t hash_of_one(Backend& backend, const Scene& scene, const SimulationOptions& options) {
  Simulation alone(backend, scene, options);
  alone.run();
  return alone.state_hash();
}

std::vector<Simulation> make_worlds(Backend& backend, const Scene& scene, const SimulationOptions& options,
                                    std::size_t count) {
  std::vector<Simulation> worlds;
  std::vector<IPhysicsWorld*> others;
  for (std::size_t i = 0; i < count; ++i) {
    worlds.emplace_back(backend, scene, options);
    if (i != 0) others.push_back(&worlds.back().world());
  }
  IPhysicsWorld& first = worlds.front().world();
  if (IWorlds* extension = first.worlds(); extension != nullptr) check(first, extension->group(others));
  return worlds;
}

/// Steps all to the end. Returns the time of each step of all, ms.
std::vector<double> run_together(std::vector<Simulation>& worlds, helpers::StepTogether& together, Progress& progress) {
  std::vector<double> times;
  for (bool goes_on = true; goes_on;) {
    const auto start = Clock::now();
    std::vector<char> begun(worlds.size());
    together.each(worlds.size(), [&](std::size_t i) { begun[i] = worlds[i].begin_step() ? 1 : 0; });
    goes_on = begun.front() != 0;
    if (!goes_on) break;
    together.each(worlds.size(), [&](std::size_t i) { worlds[i].finish_step(); });
    times.push_back(milliseconds_since(start));
    progress.step = times.size() + 1;
  }
  return times;
}

}  // namespace

Json run_worlds(Backend& backend, const Json& request, Progress& progress) {
  const std::size_t count = request.at("count");
  Json answer{{"status", "ok"}, {"reason", ""}, {"count", count}};
  reset_peak_memory();
  std::optional<SceneFile> file;
  const Outcome outcome = outcome_of(file, [&] {
    file.emplace(scene_file_of(request));
    const Scene scene = scene_of(*file, request);
    const SimulationOptions options = options_of(backend, request);
    const std::uint64_t alone = hash_of_one(backend, scene, options);
    helpers::StepTogether together(request.at("over").get<std::uint32_t>());
    const auto start = Clock::now();
    std::vector<Simulation> worlds = make_worlds(backend, scene, options, count);
    answer["setup_ms"] = milliseconds_since(start);
    progress.total = static_cast<std::uint64_t>(scene.seconds / scene.dt);
    const std::vector<double> times = run_together(worlds, together, progress);
    answer["over"] = together.threads();
    answer["bodies"] = scene.bodies.size();
    answer["steps"] = times.size();
    answer["step_ms"] = median({times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end()});
    answer["differ"] =
        std::count_if(worlds.begin(), worlds.end(), [&](Simulation& world) { return world.state_hash() != alone; });
    answer["hash"] = fmt::format("{:016x}", alone);
  });
  answer["status"] = outcome.status;
  answer["reason"] = outcome.reason;
  answer["peak_mb"] = peak_memory_mb();
  return answer;
}

}  // namespace plumb::harness
