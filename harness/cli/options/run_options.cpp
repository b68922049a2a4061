#include "cli/options/run_options.hpp"

#include <fmt/format.h>

#include <iostream>
#include <optional>

#include "cli/options/numbers.hpp"
#include "cli/output/going_on.hpp"
#include "report/text/csv.hpp"
#include "schedule/block_runner.hpp"

namespace plumb::harness {

namespace {

bool misses_something(const Row& row) { return row.status != "ok" && row.status != "unsupported"; }

void say_what_is_left_out(const Plan& plan) {
  for (const BackendDescription& backend : plan.broken)
    fmt::print(stderr, "left out: backend {}: {}: {}\n", backend.name, backend.status, backend.error);
}

}  // namespace

void add_cell_options(CLI::App& verb, RunRequest& request) {
  verb.add_option("--param", request.parameters,
                  "name=value of a scene's parameter, repeatable; \"50 cm\" and 1/60 are values")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb.add_option("--needs", request.needs,
                  "scene: declare what the scene needs; scene+sleeping: one more; all: whatever the engine has")
      ->type_name("NEEDS")
      ->capture_default_str();
  verb.add_option("--dt", request.dt, "Step in s instead of the scene's: 1/240 or 0.004")
      ->type_name("SECONDS")
      ->transform(evaluated);
  verb.add_option("--seconds", request.seconds, "Simulated time in s instead of the scene's")
      ->type_name("SECONDS")
      ->transform(evaluated);
  verb.add_option("--threads", request.threads, "Threads that a world may use")
      ->check(whole_number_within(1, 4096))
      ->capture_default_str();
  verb.add_option("--repeat", request.repeat, "Repetitions, in turns between backends")
      ->check(whole_number_within(1, 100000))
      ->capture_default_str();
  verb.add_option("--timeout", request.timeout, "Wall time in s that an engine may take for a cell")
      ->type_name("SECONDS")
      ->check(number_above_0())
      ->capture_default_str();
  verb.add_option("--judge-timeout", request.judge_timeout,
                  "Wall time in s that the referee may take for a cell; none: as --timeout, and at least 60")
      ->type_name("SECONDS")
      ->check(number_above_0());
  verb.add_option("--memory-limit", request.memory_limit_mb,
                  "Resident memory in MB that a worker may take; 0: 3/4 of the machine's")
      ->type_name("MB")
      ->check(number_from_0())
      ->capture_default_str();
}

void add_backend_options(CLI::App& verb, RunRequest& request) {
  verb.add_option("--backend", request.backends, "Backend by name or file, repeatable; none: all that load")
      ->type_name("BACKEND")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb.add_option("--set", request.settings, "[backend:]name=value of a backend's setting, repeatable")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb.add_option("--profile", request.profile,
                  "default: as the engine ships; matched: its own damping and sleeping off; tuned: its author's file")
      ->type_name("WORD:{default,matched,tuned}")
      ->capture_default_str();
}

void add_run_options(CLI::App& verb, RunOptions& options) {
  RunRequest& request = options.request;
  verb.add_option("SCENE", request.scenes, "Scenes: ids (D1), slugs (tower), groups (stacking, core, all) or files")
      ->required();
  add_backend_options(verb, request);
  add_cell_options(verb, request);
  verb.add_option("--out", request.out, "Folder for results.jsonl; cells that are finished there are not run again")
      ->type_name("DIR")
      ->capture_default_str();
  verb.add_flag("--record", request.record,
                "Run every cell once more and write its trajectory to the folder of --out, for replays in the report");
  verb.add_flag("--layers", request.layers,
                "With --record: also what the engine shows of its inside, such as the boxes of its trees; files grow")
      ->needs("--record");
  verb.add_flag("--trace", request.trace,
                "Write every call to the folder of --out, for plumb replay; times include that");
  verb.add_flag("--timeline", request.timeline,
                "Write how long every call and phase took to the folder of --out, for Perfetto; times include that");
  verb.add_flag("--json", options.output.json, "One object a cell, one a line, as they finish");
  verb.add_flag("--csv", options.output.csv, "One line a metric")->excludes("--json");
  verb.add_flag("--strict", options.strict, "Exit with 1 when a threshold is missed");
}

int run_and_print(const RunOptions& options, PrintRows print) {
  const RunRequest& request = options.request;
  if (request.record && request.out.empty())
    throw UsageError("--record writes trajectories to a folder: name it with --out DIR");
  if (request.trace && request.out.empty())
    throw UsageError("--trace writes traces to a folder: name it with --out DIR");
  if (request.timeline && request.out.empty())
    throw UsageError("--timeline writes timelines to a folder: name it with --out DIR");
  catch_signals();
  const Plan plan = make_plan(request);
  say_what_is_left_out(plan);
  std::optional<ResultsFile> results;
  if (!request.out.empty()) results.emplace(request.out);

  std::vector<Row> rows;
  std::size_t known = 0, finished = 0;
  bool missed = false;
  const auto show = [&] {
    if (options.output.csv) {
      write_csv(std::cout, rows);
    } else if (!options.output.json) {
      print(std::cout, rows, terminal_width(), wants_colour());
    }
    if (!results) return;
    // Behind a table for people; beside lines for programs.
    const std::string where = "results in " + (results->folder() / "results.jsonl").string() + "\n";
    (options.output.json || options.output.csv ? std::cerr : std::cout) << where;
  };
  {
    ProgressBar bar;
    RunCallbacks callbacks;
    callbacks.finished = [&](const Row& row, bool is_new) {
      ++finished;
      if (!is_new) ++known;
      missed = missed || misses_something(row);
      if (options.output.json) {
        bar.clear();
        std::cout << line_of(to_json(row)) << std::endl;  // whoever reads the pipe has it at once
      } else {
        rows.push_back(row);
        rows.back().origin.index = rows.size() - 1;
      }
    };
    callbacks.progress = [&](const RunProgress& progress) { bar.draw(progress); };
    try {
      run_blocks(plan, request, results ? &*results : nullptr, callbacks);
    } catch (const Interrupted&) {
      bar.clear();
      if (!rows.empty()) show();
      say_how_to_go_on(finished, request.out);
      throw;
    } catch (...) {
      bar.clear();
      if (!rows.empty()) show();
      throw;
    }
  }
  if (known > 0) fmt::print(stderr, "{} cells were finished already in {}\n", known, request.out);
  show();
  return options.strict && missed ? 1 : 0;
}

}  // namespace plumb::harness
