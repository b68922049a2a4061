#include "worker/cell_workers.hpp"

#include <fmt/format.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>

#include "cell/request.hpp"

namespace plumb::harness {

namespace {

double own_processor_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

std::string label_of(const Cell& cell) {
  std::string label = cell.scene->id;
  for (const auto& [name, value] : cell.shown)
    label += " " + name + "=" + std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
  label += " " + cell.backend->name;
  for (const auto& [name, value] : cell.settings.items()) label += fmt::format(" {}={}", name, typed_text(value));
  return label;
}

std::string cell_file(const std::filesystem::path& results, const Cell& cell, const char* kind, const char* suffix) {
  const std::filesystem::path folder = results / kind;
  std::filesystem::create_directories(folder);
  return std::filesystem::absolute(folder / (cell_id(cell) + suffix)).string();
}

std::string trajectory_of(const std::filesystem::path& results, const Cell& cell) {
  return cell_file(results, cell, "trajectories", ".plt");
}

bool wants_recording(const std::filesystem::path& results, const Cell& cell, const Row& row, bool is_new) {
  if (row.status == "timeout" || row.status == "unjudged" || row.status == "out_of_memory") return false;
  return is_new || !std::filesystem::exists(trajectory_of(results, cell));
}

Answer CellWorkers::ask(const Cell& cell, const CellFiles& files, const WorkerLimits& limits,
                        const std::function<void(const Progress&)>& tick) {
  Answer answer;
  if (!cell.backend->error.empty()) {
    answer.status = cell.backend->status;
    answer.reason = cell.backend->error;
    return answer;
  }
  answer = ask_once(cell, files, limits, tick);
  // Somebody ended the worker, perhaps together with this program: that says nothing of the engine, so once more.
  if (!answer.killed_from_outside) return answer;
  answer = ask_once(cell, files, limits, tick);
  answer.restarted = true;
  return answer;
}

Answer CellWorkers::ask_once(const Cell& cell, const CellFiles& files, const WorkerLimits& limits,
                             const std::function<void(const Progress&)>& tick) {
  std::unique_ptr<WorkerProcess>& worker = workers_[cell.backend->file];
  if (!worker || !worker->alive()) worker = std::make_unique<WorkerProcess>(cell.backend->file);
  const auto start = std::chrono::steady_clock::now();
  const double before = worker->processor_seconds();
  Answer answer = worker->ask(request_of(cell, files), limits, tick);
  if (answer.status == "ok" && answer.json.value("status", "") == wrong_scene)
    throw UsageError(answer.json.value("reason", ""));
  answer.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!worker->alive()) {
    watch_ = LoadWatch();  // what the dead one has used nobody can tell any more
    workers_time_ = 0;
    return answer;
  }
  workers_time_ += worker->processor_seconds() - before;
  const Load load = watch_.since(start, workers_time_ + own_processor_time());
  // A launcher that binds each process to cores of its own has shared them out already, where there are enough.
  const unsigned cores = usable_cores();
  const unsigned online = static_cast<unsigned>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
  const bool apart = cores < online && cell.threads * ranks_ <= online;
  answer.contended = contended(load, cores, cell.threads, apart ? 1 : ranks_);
  return answer;
}

}  // namespace plumb::harness
