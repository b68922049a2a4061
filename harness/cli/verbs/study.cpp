#include <fmt/format.h>

#include <iostream>
#include <map>
#include <memory>

#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/output/going_on.hpp"
#include "cli/output/output.hpp"
#include "cli/verbs/verbs.hpp"
#include "plumb/nearest.hpp"
#include "study/runner.hpp"
#include "study/study_record.hpp"
#include "worker/cell_workers.hpp"

namespace plumb::harness {

namespace {

struct StudyVerbOptions {
  std::string what, out = "plumb-results", budget;
  std::vector<std::string> backends;
  double confidence = 0;
  bool fixed = false, dry_run = false, print = false, json = false, strict = false;
};

StudyFile resolved_study(const StudyVerbOptions& options) {
  StudyFile study = find_study(options.what);
  if (!options.backends.empty()) {
    study.backends = options.backends;
    study.json["backends"] = options.backends;
  }
  if (options.fixed) study.budget.reset();
  if (!options.budget.empty()) {
    study.budget = parse_duration("--budget", options.budget);
    study.json["budget"] = options.budget;
  }
  if (options.confidence > 0) {
    study.confidence = options.confidence;
    study.json["confidence"] = options.confidence;
  }
  return study;
}

void print_plan(const StudyPlan& plan, const StudyFile& study) {
  const char* stages[] = {"as the scenes are", "other steps, methods, seeds, ends of ladders", "ladders between"};
  std::map<int, std::size_t> cells;
  for (const PlannedCell& planned : plan.cells) ++cells[planned.stage];
  for (const auto& [stage, count] : cells) fmt::print("{:6}  {}\n", count, stages[std::min(stage, 2)]);
  for (const std::vector<std::size_t>& batch : plan.batches) {
    for (const std::size_t place : batch) {
      const PlannedCell& planned = plan.cells[place];
      const Cell& cell = planned.cell;
      fmt::print("{} {} dt={:.6g} needs={} profile={} threads={} repeat={}..{}\n", planned.id, label_of(cell), cell.dt,
                 cell.needs, cell.profile, cell.threads, planned.repetitions.at_least, planned.repetitions.at_most);
    }
  }
  fmt::print("{} of the study {}{}\n", count_of(plan.cells.size(), "cell"), study.name,
             study.budget ? fmt::format(", at most {:g} s", *study.budget) : "");
}

/// One line a backend: how many cells ended how.
void print_summary(const std::map<std::string, std::map<std::string, std::size_t>>& statuses) {
  std::size_t width = 7;
  for (const auto& [backend, counts] : statuses) width = std::max(width, backend.size());
  for (const auto& [backend, counts] : statuses) {
    std::string text;
    for (const auto& [status, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, status);
    std::cout << column(backend, width + 2) << text << "\n";
  }
}

void print_outcome(const StudyOutcome& outcome) {
  fmt::print(stderr, "{} run, {} finished already, {} by other processes, {} put between others\n",
             count_of(outcome.run, "cell"), outcome.known, outcome.elsewhere, outcome.refined);
  if (outcome.idle > 0)
    fmt::print(stderr, "left out: {} whose knob does nothing there\n", count_of(outcome.idle, "cell"));
  if (outcome.out_of_time.empty()) return;
  constexpr std::size_t most = 5;
  fmt::print(stderr, "left out by the budget: {}; run the same line again to go on:\n",
             count_of(outcome.out_of_time.size(), "cell"));
  for (std::size_t i = 0; i < std::min(most, outcome.out_of_time.size()); ++i)
    fmt::print(stderr, "  {}\n", outcome.out_of_time[i]);
  if (outcome.out_of_time.size() > most) fmt::print(stderr, "  and {} more\n", outcome.out_of_time.size() - most);
}

int run_study_verb(const StudyVerbOptions& options) {
  if (options.print) {
    const auto preset = study_presets().find(options.what);
    if (preset == study_presets().end()) {
      std::vector<std::string> names;
      for (const auto& [name, text] : study_presets()) names.push_back(name);
      throw UsageError(
          fmt::format("--print {}: there is no such preset{}", options.what, suggestion(options.what, names)));
    }
    std::cout << preset->second;
    return 0;
  }
  const StudyFile study = resolved_study(options);
  const Ranks ranks = ranks_of_environment();
  catch_signals();
  StudyPlan plan = plan_study(study, options.fixed);
  if (options.dry_run) {
    if (ranks.speaks()) print_plan(plan, study);
    return 0;
  }
  ResultsFile results(options.out, ranks.results_name());
  if (ranks.speaks()) {
    write_study_record(results.folder(), study, typed_line());
    for (const BackendDescription& backend : plan.broken)
      fmt::print(stderr, "left out: backend {}: {}: {}\n", backend.name, backend.status, backend.error);
  }
  std::map<std::string, std::map<std::string, std::size_t>> statuses;
  bool missed = false;
  std::size_t finished = 0;
  StudyOutcome outcome;
  {
    ProgressBar bar(true);
    RunCallbacks callbacks;
    callbacks.finished = [&](const Row& row, bool is_new) {
      ++statuses[row.backend][row.status];
      ++finished;
      missed = missed || (row.status != "ok" && row.status != "unsupported");
      if (!options.json || (!is_new && !ranks.speaks())) return;
      bar.clear();
      std::cout << line_of(to_json(row)) << std::endl;  // whoever reads the pipe has it at once
    };
    if (ranks.speaks()) callbacks.progress = [&](const RunProgress& progress) { bar.draw(progress); };
    try {
      outcome = run_study_plan(plan, study, options.fixed, ranks, results, callbacks);
    } catch (const Interrupted&) {
      bar.clear();
      if (ranks.speaks()) say_how_to_go_on(finished, options.out);
      throw;
    }
  }
  if (ranks.speaks()) {
    print_outcome(outcome);
    if (!options.json) {
      print_summary(statuses);
      std::cout << "results in " << options.out << "; look at them with plumb report " << options.out
                << " --html report.html\n";
    }
  }
  return options.strict && missed ? 1 : 0;
}

}  // namespace

void add_study(CLI::App& program, int& status) {
  const auto options = std::make_shared<StudyVerbOptions>();
  CLI::App* verb = program.add_subcommand(
      "study", "Run a whole study: scenes, backends, knobs, steps and seeds as a file or a preset says");
  verb->add_option("STUDY", options->what, "A preset (quick, standard, full, scaling) or a study file")->required();
  verb->add_option("--out", options->out, "Folder for the results; what is finished there is not run again")
      ->type_name("DIR")
      ->capture_default_str();
  verb->add_option("--budget", options->budget, "Wall time of this start, in place of the study's: 90s, 20min, 2h")
      ->type_name("TIME");
  verb->add_option("--backend", options->backends, "Backend by name or file, repeatable; none: the study's")
      ->type_name("BACKEND")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb->add_option("--confidence", options->confidence,
                   "A cell is repeated until half of the 95 % interval of its time is below this share of it")
      ->check(number_within(0.0001, 0.99));
  verb->add_flag("--fixed", options->fixed,
                 "Nothing adapts to what is measured: the same cells, equally often, on every start and number of "
                 "ranks; no budget but that of --budget");
  verb->add_flag("--dry-run", options->dry_run, "Print the cells in their order and run none");
  verb->add_flag("--print", options->print, "Print the preset's file");
  verb->add_flag("--json", options->json, "One object a cell, one a line, as they finish");
  verb->add_flag("--strict", options->strict, "Exit with 1 when a threshold is missed");
  add_examples(*verb, {{"plumb study quick --out results", "five minutes; the same line goes on after a kill"},
                       {"plumb study quick --print", "the preset's file, a start for one's own"},
                       {"plumb study mine.json --out results --budget 20min", "a file of one's own, in that time"},
                       {"mpirun -n 4 plumb study mine.json --out results", "the cells shared among processes"}});
  verb->callback([options, &status] { status = run_study_verb(*options); });
}

}  // namespace plumb::harness
