#include "cell/cell_runner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>

#include "base/locate.hpp"
#include "cell/description.hpp"
#include "cell/general_metrics.hpp"
#include "cell/machine.hpp"
#include "cell/metric_rows.hpp"
#include "cell/request.hpp"
#include "cell/watched_backend.hpp"
#include "measure/registry/registry.hpp"
#include "record/recording.hpp"
#include "simulation/names.hpp"
#include "simulation/support.hpp"

namespace plumb::harness {

namespace {

/// Keeps Progress up to date: `step` is the one that is about to be done, so that a crash in it is told by its number.
class Tracker : public SimulationObserver {
 public:
  explicit Tracker(Progress& progress) : progress_(progress) {}
  [[nodiscard]] CellClock& clock() { return progress_.clock; }
  void started(Simulation& simulation) override {
    progress_.total = static_cast<std::uint64_t>(std::llround(simulation.scene().seconds / simulation.scene().dt));
    progress_.step = 1;
  }
  void stepped(Simulation& simulation) override { progress_.step = simulation.steps() + 1; }

 private:
  Progress& progress_;
};

/// What the cell's own simulation leaves behind when it ends.
struct Record {
  bool made = false;
  std::optional<StepStatistics> statistics;
  std::uint64_t hash = 0;
  std::size_t bodies = 0;
  Json settings = Json::object();
  std::vector<Metric> metrics;
  std::string trouble;  ///< why the end could not be read
};

Json settings_in_force(const Backend& backend, Simulation& simulation) {
  Json settings = Json::object();
  ISettings* extension = simulation.world().settings();
  for (const PlumbSettingInfo* info : backend.settings()) {
    PlumbSettingValue value = info->default_value;
    if (extension != nullptr) check(simulation.world(), extension->get_setting(info->name, value));
    settings[info->name] = json_of(value);
  }
  return settings;
}

class Recorder : public Tracker {
 public:
  Recorder(const Backend& backend, Progress& progress, Record& record, const RecordingRequest& recording,
           PlumbNeeds declared)
      : Tracker(progress), backend_(backend), record_(record), request_(recording), declared_(declared) {}

  void started(Simulation& simulation) override {
    Tracker::started(simulation);
    record_.bodies = simulation.poses().size();
    {
      const EngineAtWork at_work(&clock());
      record_.settings = settings_in_force(backend_, simulation);
    }
    general_.emplace(simulation);
    if (!request_.file.empty()) recording_.emplace(request_, simulation, backend_, declared_);
  }
  void stepped(Simulation& simulation) override {
    general_->stepped(simulation);
    if (recording_) recording_->stepped(simulation);
    Tracker::stepped(simulation);
  }
  void ended(Simulation& simulation) noexcept override {
    try {
      record_.statistics = simulation.statistics();
      if (recording_) recording_->finish();
      record_.metrics = general_->finish(simulation);
      record_.hash = simulation.state_hash();
    } catch (const std::exception& error) {
      record_.trouble = error.what();
    }
  }

 private:
  const Backend& backend_;
  Record& record_;
  RecordingRequest request_;
  PlumbNeeds declared_;
  std::optional<GeneralMetrics> general_;
  std::optional<Recording> recording_;
};

class CellContext : public MeasureContext {
 public:
  CellContext(Backend& backend, const Scene& scene, SimulationOptions options, Progress& progress,
              RecordingRequest recording)
      : backend_(backend),
        scene_(scene),
        options_(std::move(options)),
        progress_(progress),
        recording_(std::move(recording)) {}

  [[nodiscard]] const Scene& scene() const override { return scene_; }
  Simulation simulate(const Scene& scene) override { return simulate(scene, options_); }
  Simulation simulate(const Scene& scene, const SimulationOptions& options) override {
    SimulationOptions watched = options;
    watched.clock = &progress_.clock;
    if (record_.made) {
      watched.observer = std::make_shared<Tracker>(progress_);
      return {backend_, scene, watched};
    }
    record_.made = true;
    Scene seen = scene;
    if (!recording_.file.empty()) seen.needs |= needs_of_layers(backend_);
    const PlumbNeeds declared = seen.needs | (watched.needs_all ? needs_of(backend_) : 0);
    watched.observer = std::make_shared<Recorder>(backend_, progress_, record_, recording_, declared);
    return {backend_, seen, watched};
  }
  [[nodiscard]] const SimulationOptions& options() const override { return options_; }
  [[nodiscard]] Backend& backend() override { return backend_; }
  void add(Metric metric) override { metrics_.push_back(std::move(metric)); }

  [[nodiscard]] const Record& record() const { return record_; }
  /// The measure's, then the referee's where the measure has none of the name.
  [[nodiscard]] std::vector<Metric> metrics() const {
    std::vector<Metric> all = metrics_;
    for (const Metric& general : record_.metrics) {
      const bool is_new = std::none_of(metrics_.begin(), metrics_.end(),
                                       [&](const Metric& metric) { return metric.name == general.name; });
      if (is_new) all.push_back(general);
    }
    return all;
  }

 private:
  Backend& backend_;
  const Scene& scene_;
  SimulationOptions options_;
  Progress& progress_;
  RecordingRequest recording_;
  Record record_;
  std::vector<Metric> metrics_;
};

RecordingRequest recording_of(const Json& request) {
  return {request.value("trajectory", ""), request.value("layers", false), request.value("about", Json::object())};
}

// Steps before the window warm caches and warm starts up and let the scene settle.
void add_times(Json& answer, const StepStatistics& statistics) {
  const std::size_t steps = statistics.step_ms.size(), first = steps / 2;
  answer["steps"] = steps;
  answer["setup_ms"] = statistics.setup_ms;
  answer["window"] = steps == 0 ? Json::array() : Json{first + 1, steps};
  answer["step_ms"] =
      std::vector<double>(statistics.step_ms.begin() + static_cast<std::ptrdiff_t>(first), statistics.step_ms.end());
  for (std::size_t phase = 0; phase < phase_words().size() && phase < statistics.phase_ms.size(); ++phase) {
    if (std::isfinite(statistics.phase_ms[phase]))
      answer["phase_ms"][phase_words()[phase]] = statistics.phase_ms[phase];
  }
}

Json empty_answer() {
  return {{"status", "ok"},
          {"reason", ""},
          {"metrics", Json::object()},
          {"settings", Json::object()},
          {"step_ms", Json::array()},
          {"window", Json::array()},
          {"steps", 0},
          {"setup_ms", nullptr},
          {"phase_ms", Json::object()},
          {"counts", Json::object()},
          {"hash", ""},
          {"peak_mb", nullptr}};
}

void add_record(Json& answer, const Record& record) {
  answer["settings"] = record.settings;
  const StepStatistics none;
  const StepStatistics& statistics = record.statistics ? *record.statistics : none;
  if (record.statistics) add_times(answer, statistics);
  answer["counts"] = {{"bodies", record.bodies},
                      {"contacts_max", statistics.contacts_max},
                      {"dropped", statistics.dropped},
                      {"nonfinite", statistics.nonfinite}};
  if (record.statistics && record.trouble.empty()) answer["hash"] = fmt::format("{:016x}", record.hash);
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

/// What a run that came to its end is worth. Where less time was asked for than the scene takes, and something did not
/// come about in it, there is no telling whether the engine would have missed it.
Outcome verdict_on(const CellContext& context, const SceneFile& file) {
  const Scene& scene = context.scene();
  Judgement judgement = judge(context.metrics(), scene.metrics, general_metric_specs());
  const auto& statistics = context.record().statistics;
  if (statistics && statistics->nonfinite != 0) {
    judgement.missed.push_back(fmt::format("{} bodies became NaN or infinite", statistics->nonfinite));
  } else if (!judgement.silent.empty()) {
    const double whole = file.outline(scene.parameters, {scene.dt, std::nullopt}).seconds;
    if (scene.seconds < whole)
      return {"unjudged", fmt::format("{:g} s are too short to measure {}: the scene takes {:g} s", scene.seconds,
                                      fmt::join(judgement.silent, ", "), whole)};
  }
  return judgement.missed.empty() ? Outcome{} : Outcome{"failed", joined(judgement.missed)};
}

}  // namespace

Json run_cell(Backend& backend, const Json& request, Progress& progress) {
  Json answer = empty_answer();
  reset_peak_memory();
  std::optional<SceneFile> file;
  std::optional<Scene> scene;
  std::optional<WatchedBackend> watched;
  std::optional<CellContext> context;
  const RecordingRequest recording = recording_of(request);
  if (!recording.file.empty()) std::filesystem::remove(recording.file);
  Outcome outcome = outcome_of(file, [&] {
    file.emplace(scene_file_of(request));
    scene.emplace(scene_of(*file, request));
    const SimulationOptions options = options_of(backend, request);
    watched.emplace(backend, request);
    context.emplace(watched->backend(), *scene, options, progress, recording);
    find_measure(*file).run(*context);
  });
  if (outcome.status == "ok" && !context->record().trouble.empty()) outcome = {"error", context->record().trouble};
  if (context) {
    add_record(answer, context->record());
    if (outcome.status == "ok") outcome = verdict_on(*context, *file);
    const bool judged = outcome.status == "ok" || outcome.status == "failed";
    answer["metrics"] = to_json(
        judge(context->metrics(), judged ? scene->metrics : std::vector<MetricSpec>{}, general_metric_specs()).metrics);
  }
  answer["status"] = outcome.status;
  answer["reason"] = outcome.reason;
  answer["peak_mb"] = peak_memory_mb();
  if (scene && !recording.file.empty() && !std::filesystem::exists(recording.file) && scene->lacks.empty())
    record_start(recording, *scene);
  if (context && !recording.file.empty())
    end_trajectory(recording.file, {{"status", answer["status"]},
                                    {"reason", answer["reason"]},
                                    {"hash", answer["hash"]},
                                    {"metrics", answer["metrics"]}});
  return answer;
}

}  // namespace plumb::harness
