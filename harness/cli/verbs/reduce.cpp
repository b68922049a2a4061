// plumb reduce: from a scene that an engine gets wrong to the smallest that it still does, for who has to mend it.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <optional>

#include "base/format.hpp"
#include "base/shown.hpp"
#include "base/temporary_folder.hpp"
#include "cli/manual/examples.hpp"
#include "cli/options/one_scene.hpp"
#include "cli/options/run_options.hpp"
#include "cli/output/draft_file.hpp"
#include "cli/output/output.hpp"
#include "cli/verbs/verbs.hpp"
#include "convert/scene_text.hpp"
#include "plumb/nearest.hpp"
#include "reduce/plain_scene.hpp"
#include "reduce/reduction.hpp"
#include "schedule/bench.hpp"

namespace plumb::harness {
namespace {

struct ReduceOptions {
  std::string scene, to, backend, against, metric;
  RunRequest request;
};

bool has_lost_bodies(const Row& row) { return row.counts.nonfinite.value_or(0) > 0; }

/// What a run has to do to be wrong in the same way.
struct Failure {
  std::string status, metric;  ///< metric: of a run that came to its end; else ""
  bool loses_bodies = false;   ///< some become NaN or infinite, whatever the metrics say

  [[nodiscard]] bool is_of(const Row& row) const {
    if (row.status != status) return false;
    if (loses_bodies) return has_lost_bodies(row);
    if (metric.empty()) return true;
    const MetricResult* result = row.metric(metric);
    return result != nullptr && result->badness().value_or(0) > 1;
  }
  /// The run came to its end, and what is wrong elsewhere is right.
  [[nodiscard]] bool is_absent_from(const Row& row) const {
    if (!row.completed()) return false;
    if (loses_bodies) return !has_lost_bodies(row);
    if (metric.empty()) return true;
    const MetricResult* result = row.metric(metric);
    return result != nullptr && result->badness() && *result->badness() <= 1;
  }
};

/// One scene after the other on one backend.
class Trials {
 public:
  Trials(const ReduceOptions& options, const std::string& backend_name, const std::string& slug)
      : request_(options.request) {
    request_.parameters.clear();  // scenes have their numbers, and their times
    request_.dt.reset();
    request_.seconds.reset();
    request_.scenes = {(folder_.path() / (slug + ".json")).string()};
    backends_ = build_ids(open_backends({backend_name}, request_.limits()).usable);
    const BackendDescription& backend = *backends_.front().description;
    if (!backend.error.empty()) throw UsageError(fmt::format("{} cannot be loaded: {}", backend_name, backend.error));
  }

  /// Throws UsageError where the scene is none.
  Row run(const Json& scene) {
    ++runs_;
    DraftFile(request_.scenes.front()).write(scene_text(scene));
    const Cell cell = plan_blocks(request_, backends_).front().cells.front();
    std::vector<Answer> answers;
    for (std::uint32_t i = 0; i < request_.repeat; ++i)
      answers.push_back(bench_.repeat_quietly(cell, {}, request_.limits()));
    return bench_.row_of(cell, answers);
  }
  [[nodiscard]] std::size_t runs() const { return runs_; }

 private:
  RunRequest request_;
  TemporaryFolder folder_{"plumb-reduce"};
  std::vector<BuiltBackend> backends_;
  RunCallbacks callbacks_;
  Bench bench_{nullptr, Ranks{}, callbacks_};
  std::size_t runs_ = 0;
};

Failure failure_of(const Row& row, const ReduceOptions& options) {
  if (row.status == "unsupported")
    throw UsageError(fmt::format("{} lacks what the scene needs: {}", options.backend, row.reason));
  if (row.status != "ok" && row.status != "failed") {
    if (!options.metric.empty())
      throw UsageError(fmt::format("--metric {}: the run has none, it ended: {}", options.metric, row.status));
    return {row.status, ""};
  }
  if (options.metric.empty() && has_lost_bodies(row)) return {row.status, "", true};
  std::string metric = options.metric;
  if (metric.empty() && row.status == "failed") metric = row.worst()->name;
  std::vector<std::string> known;
  for (const MetricResult& one : row.metrics)
    if (one.badness()) known.push_back(one.name);
  if (!metric.empty() && std::find(known.begin(), known.end(), metric) == known.end())
    throw UsageError(fmt::format("--metric {}: nothing of that name is judged{}", metric, suggestion(metric, known)));
  Failure failure{"failed", metric};
  if (metric.empty() || !failure.is_of(row))
    throw UsageError(fmt::format("{} gets it right{}: there is nothing to reduce", options.backend,
                                 metric.empty() ? "" : ", as far as " + metric + " goes"));
  return failure;
}

std::string text_of(const Failure& failure, const Row& row) {
  if (failure.metric.empty()) return failure.status + ": " + row.reason;
  const MetricResult& metric = *row.metric(failure.metric);
  return fmt::format("{} {} > {}", metric.name, short_number(metric.error), limit_text(metric.threshold.value_or(0)));
}

int reduce(const ReduceOptions& options) {
  catch_signals();
  if (!options.to.ends_with(".json"))
    throw UsageError(fmt::format("cannot write {}: a scene's file ends with .json", shortened(options.to, 200)));
  DraftFile out(options.to);
  const SceneFile file = one_scene_file(options.scene);
  const Scene scene = one_scene(file, options.request.parameters, {options.request.dt, options.request.seconds});
  Trials trials(options, options.backend, scene.slug);
  std::optional<Trials> others;
  if (!options.against.empty()) {
    ReduceOptions as_it_is = options;
    as_it_is.request.settings.clear();  // they are the other's
    others.emplace(as_it_is, options.against, scene.slug);
  }
  const Json whole = plain_scene(scene, file);
  const Row first = trials.run(whole);
  const Failure failure = failure_of(first, options);
  if (others && !failure.is_absent_from(others->run(whole)))
    throw UsageError(
        fmt::format("--against {}: it gets the scene wrong, too: name one that gets it right", options.against));
  const auto fails = [&](const Json& candidate) {
    throw_if_interrupted();
    try {
      return failure.is_of(trials.run(candidate)) && (!others || failure.is_absent_from(others->run(candidate)));
    } catch (const UsageError&) {
      return false;  // no scene any more
    }
  };
  const auto shrunk = [&](const Json& smallest) {
    fmt::print(stderr, "run {}: {}\n", trials.runs(), size_text(smallest));
  };
  fmt::print(stderr, "run 1: {}: {}\n", size_text(whole), text_of(failure, first));
  const Json small = reduced(whole, fails, shrunk);
  out.write(scene_text(small));
  const Row last = trials.run(small);
  std::cout << fmt::format("{}: {}, of {}, in {} runs: {}\n", options.to, size_text(small), size_text(whole),
                           trials.runs(), text_of(failure, last));
  return 0;
}

}  // namespace

void add_reduce(CLI::App& program, int& status) {
  const auto options = std::make_shared<ReduceOptions>();
  CLI::App* verb = program.add_subcommand(
      "reduce", "Make of a scene that a backend gets wrong the smallest that it still gets wrong in the same way");
  verb->add_option("SCENE", options->scene, "Id, slug or file of one scene, of which the first variant counts")
      ->required();
  verb->add_option("TO", options->to, "Scene file to write, as in small.json")->type_name("FILE")->required();
  verb->add_option("--backend", options->backend, "Backend by name or file")->type_name("BACKEND")->required();
  verb->add_option(
          "--against", options->against,
          "Another backend, by name or file, which has to get right what is left: so that nothing is taken out "
          "without which nobody could, such as the ground")
      ->type_name("BACKEND");
  verb->add_option("--metric", options->metric,
                   "What has to stay wrong; left out: that bodies become NaN, what is worst, or how the run ends")
      ->type_name("METRIC");
  verb->add_option("--set", options->request.settings, "name=value of a backend's setting, repeatable")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  add_cell_options(*verb, options->request);
  add_examples(
      *verb, {{"plumb reduce random/R17-random.json small.json --backend ode", "what is left is for a bug report"},
              {"plumb reduce I3 small.json --backend ode --against impulse", "what one gets wrong and the other right"},
              {"plumb reduce D2 small.json --backend bullet --metric drift --param N=10",
               "a scene of the catalogue, and which of its metrics"}});
  verb->callback([options, &status] { status = reduce(*options); });
}

}  // namespace plumb::harness
