// plumb worlds: one scene in many worlds that are stepped together, what that costs and whether any is disturbed by it.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "cell/request.hpp"
#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/options/run_options.hpp"
#include "cli/output/output.hpp"
#include "cli/verbs/verbs.hpp"
#include "schedule/plan.hpp"
#include "worker/cell_workers.hpp"

namespace plumb::harness {

namespace {

struct WorldsOptions {
  RunRequest request;
  std::vector<std::uint32_t> counts = {1, 16, 256};
  std::uint32_t over = 0;
  bool json = false;
};

Json ask_once(WorkerProcess& worker, const Cell& cell, std::uint32_t count, const WorldsOptions& options) {
  Json request = request_of(cell, {});
  request["request"] = "worlds";
  request["count"] = count;
  request["over"] = options.over;
  const Answer answer = worker.ask(request, options.request.limits());
  Json row = answer.json;
  if (answer.status != "ok") row = {{"status", answer.status}, {"reason", answer.reason}, {"count", count}};
  if (row.at("status") == wrong_scene) throw UsageError(row.at("reason").get<std::string>());
  row["scene"] = cell.scene->id;
  row["parameters"] = harness::json_of(cell.parameters);
  row["backend"] = cell.backend->name;
  if (row.contains("step_ms")) row["us_per_world_step"] = 1e3 * row.at("step_ms").get<double>() / count;
  return row;
}

/// Of the repetitions the one with the median time, or the first that did not come to its end.
Json ask(std::unique_ptr<WorkerProcess>& worker, const Cell& cell, std::uint32_t count, const WorldsOptions& options) {
  std::vector<Json> rows;
  for (std::uint32_t i = 0; i < options.request.repeat; ++i) {
    if (!worker || !worker->alive()) worker = std::make_unique<WorkerProcess>(cell.backend->file);
    rows.push_back(ask_once(*worker, cell, count, options));
    if (rows.back().at("status") != "ok") return rows.back();
  }
  std::sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) { return a.at("step_ms") < b.at("step_ms"); });
  return rows[rows.size() / 2];
}

void print_row(const std::string& label, const Json& row) {
  const std::uint32_t count = row.at("count");
  if (row.at("status") != "ok") {
    std::cout << fmt::format("{:40} {:>7} {}: {}\n", label, count, row.at("status").get<std::string>(),
                             row.at("reason").get<std::string>());
    return;
  }
  const std::uint32_t differ = row.at("differ");
  std::cout << fmt::format("{:40} {:>7} {:>7} {:>10.4g} {:>12.4g}  {}\n", label, count,
                           row.at("over").get<std::uint32_t>(), row.at("step_ms").get<double>(),
                           row.at("us_per_world_step").get<double>(),
                           differ == 0 ? "all" : fmt::format("{} of {} NOT", differ, count));
}

int run_worlds_of(const WorldsOptions& options) {
  const Plan plan = make_plan(options.request);
  if (!options.json)
    std::cout << fmt::format("{:40} {:>7} {:>7} {:>10} {:>12}  {}\n", "scene and backend", "worlds", "threads",
                             "ms a step", "us a world", "as one alone");
  bool all_ran = true;
  for (const CellBlock& block : plan.blocks)
    for (const Cell& cell : block.cells) {
      std::unique_ptr<WorkerProcess> worker;
      for (const std::uint32_t count : options.counts) {
        const Json row = ask(worker, cell, count, options);
        all_ran = all_ran && row.at("status") == "ok";
        if (options.json)
          std::cout << line_of(row) << std::endl;
        else
          print_row(label_of(cell), row);
      }
    }
  return all_ran ? 0 : 1;
}

}  // namespace

void add_worlds(CLI::App& program, int& status) {
  const auto options = std::make_shared<WorldsOptions>();
  RunRequest& request = options->request;
  CLI::App* verb =
      program.add_subcommand("worlds", "Step a scene in many worlds at once, and see what each step costs");
  verb->add_option("SCENE", request.scenes, "Scenes: ids (D1), slugs (tower), groups or files")->required();
  verb->add_option("--count", options->counts, "Worlds, repeatable: each number is a row")
      ->type_name("N")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false)
      ->check(whole_number_within(1, 1000000))
      ->capture_default_str();
  verb->add_option("--over", options->over, "Threads over which worlds are spread; 0: as many as there are processors")
      ->check(whole_number_within(0, 4096))
      ->capture_default_str();
  add_backend_options(*verb, request);
  add_cell_options(*verb, request);
  verb->add_flag("--json", options->json, "One object a row, one a line, as they finish");
  add_examples(*verb, {{"plumb worlds tower --param H=20 --count 1 --count 1024", "a tower in each of so many worlds"},
                       {"plumb worlds I1 --backend impulse --over 1 --seconds 2", "machines, on one thread"}});
  verb->callback([options, &status] {
    catch_signals();
    status = run_worlds_of(*options);
  });
}

}  // namespace plumb::harness
