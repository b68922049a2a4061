#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "cli/duel/duel_engine.hpp"
#include "cli/duel/duel_replays.hpp"
#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/options/run_options.hpp"
#include "cli/output/draft_file.hpp"
#include "cli/output/going_on.hpp"
#include "cli/output/output.hpp"
#include "cli/verbs/earlier_rows.hpp"
#include "cli/verbs/verbs.hpp"
#include "report/text/duel_text.hpp"
#include "schedule/block_runner.hpp"

namespace plumb::harness {
namespace {

constexpr std::int64_t most_replays = 12;  ///< browsers take the oldest pictures away from a page with more than 16

struct DuelOptions {
  std::string first, second;
  RunRequest request;  ///< of both; its backends, profile and settings are theirs
  std::string from, html;
  ReplayLimits replays;
};

using Engines = std::array<DuelEngine, 2>;
using EngineRows = std::array<std::vector<Row>, 2>;

void refuse_twins(const Engines& engines) {
  throw UsageError(
      fmt::format("{} and {} are the same engine: give two, or one with two profiles or settings ({}:tuned)",
                  engines[0].typed, engines[1].typed, engines[0].backend));
}

/// Nothing but letters, digits, dots and hyphens, which any file system takes.
std::string file_word(std::string text) {
  for (char& c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.') c = '-';
  }
  return text;
}

std::string page_file(const DuelOptions& options, const std::array<std::string, 2>& names) {
  if (!options.html.empty()) return options.html;
  const std::string name = fmt::format("duel-{}-{}.html", file_word(names[0]), file_word(names[1]));
  return options.from.empty() ? (std::filesystem::path(options.request.out) / name).string() : name;
}

// ---- running ----

/// Both engines' cells, those of a variant in one block; and whose each cell is.
struct DuelPlan {
  Plan plan;
  std::map<std::string, std::size_t> side_of;  ///< by cell
};

std::vector<CellBlock> blocks_of(const DuelEngine& engine, RunRequest request) {
  request.profile = engine.profile;
  request.settings = engine.settings;
  std::vector<BackendDescription> backends = open_backends({engine.backend}, request.limits()).usable;
  const BackendDescription& backend = backends.front();
  if (!backend.error.empty())
    throw UsageError(fmt::format("{} cannot be loaded: {}; there is no duel with it", engine.typed, backend.error));
  return plan_blocks(request, build_ids(std::move(backends)));
}

DuelPlan duel_plan(const Engines& engines, const RunRequest& request) {
  DuelPlan duel;
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<CellBlock> blocks = blocks_of(engines[side], request);
    duel.plan.blocks.resize(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      for (Cell& cell : blocks[i].cells) {
        if (!duel.side_of.emplace(cell_id(cell), side).second) refuse_twins(engines);
        duel.plan.blocks[i].cells.push_back(std::move(cell));
      }
    }
  }
  return duel;
}

/// What is missing is run; whose results are there already are taken.
EngineRows run_duel(const DuelPlan& duel, const RunRequest& request, ResultsFile& results) {
  EngineRows rows;
  std::size_t known = 0, finished = 0;
  ProgressBar bar;
  RunCallbacks callbacks;
  callbacks.finished = [&](const Row& row, bool is_new) {
    ++finished;
    if (!is_new) ++known;
    rows[duel.side_of.at(row.origin.cell)].push_back(row);
  };
  callbacks.progress = [&](const RunProgress& progress) { bar.draw(progress); };
  try {
    run_blocks(duel.plan, request, &results, callbacks);
  } catch (const Interrupted&) {
    bar.clear();
    say_how_to_go_on(finished, request.out);
    throw;
  }
  bar.clear();
  if (known > 0) fmt::print(stderr, "{} were finished already in {}\n", count_of(known, "cell"), request.out);
  return rows;
}

/// Runs the cells of the first scenes that tell the engines apart once more, and records them.
void record_scenes(const Duel& duel, const DuelPlan& all, std::size_t scenes, RunRequest request,
                   ResultsFile& results) {
  Plan plan;
  for (std::size_t rank = 0; rank < std::min(scenes, duel.apart.size()); ++rank) {
    const std::string& cell = duel.apart[rank].best.pair.rows[0]->origin.cell;
    for (const CellBlock& block : all.plan.blocks) {
      const bool has = std::any_of(block.cells.begin(), block.cells.end(),
                                   [&](const Cell& other) { return cell_id(other) == cell; });
      if (has) plan.blocks.push_back(block);
    }
  }
  request.record = true;
  ProgressBar bar;
  RunCallbacks callbacks;
  callbacks.finished = [](const Row&, bool) {};
  callbacks.progress = [&](const RunProgress& progress) { bar.draw(progress); };
  run_blocks(plan, request, &results, callbacks);
}

// ---- showing ----

void write_page_of(const Duel& duel, const DuelOptions& options, const std::string& folder, DraftFile& file) {
  DuelPageOptions page;
  page.page.written = date_of_page();
  page.page.source = folder;
  page.page.scenes = scene_texts();
  page.command = typed_line();
  add_duel_replays(duel, folder, options.replays, page);
  std::ostringstream out;
  write_duel_page(out, duel, page);
  file.write(out.str());
}

void show(const Duel& duel, const DuelOptions& options, const std::string& folder, const std::string& name,
          DraftFile& file) {
  write_page_of(duel, options, folder, file);
  print_duel(std::cout, duel, terminal_width(), wants_colour());
  std::cout << "page in " << name << "\n";
}

void require_a_pair(const Duel& duel, const std::string& where) {
  if (duel.pairs > 0) return;
  throw UsageError(
      fmt::format("the results in {} have no run of {} that could be held against one of {}: the same scene variant, "
                  "step, duration "
                  "and machine",
                  where, duel.names[0], duel.names[1]));
}

int duel_of_earlier_rows(const DuelOptions& options, const Engines& engines) {
  const std::array<std::string, 2> names = duel_names(engines);
  const std::string name = page_file(options, names);
  const std::vector<Row> all = earlier_rows(options.from);
  EngineRows rows;
  for (std::size_t side = 0; side < 2; ++side)
    rows[side] = rows_of_scenes(rows_of_engine(all, engines[side], options.from), options.request.scenes, options.from);
  const Duel duel = duel_of(names, rows[0], rows[1]);
  require_a_pair(duel, options.from);
  DraftFile file(name);
  show(duel, options, options.from, name, file);
  return 0;
}

int duel_of_runs(const DuelOptions& options, const Engines& engines) {
  RunRequest request = options.request;
  if (request.scenes.empty()) request.scenes = {"core"};
  catch_signals();
  const DuelPlan plan = duel_plan(engines, request);
  const std::array<std::string, 2> names = duel_names(engines);
  ResultsFile results(request.out);
  const std::string name = page_file(options, names);
  DraftFile file(name);  // nobody runs for a page that cannot be written
  const EngineRows rows = run_duel(plan, request, results);
  const Duel duel = duel_of(names, rows[0], rows[1]);
  record_scenes(duel, plan, options.replays.scenes, request, results);
  show(duel, options, request.out, name, file);
  return 0;
}

int duel(const DuelOptions& options) {
  const Engines engines{parse_duel_engine(options.first), parse_duel_engine(options.second)};
  if (engines[0].backend == engines[1].backend && engines[0].profile == engines[1].profile &&
      engines[0].settings == engines[1].settings)
    refuse_twins(engines);
  return options.from.empty() ? duel_of_runs(options, engines) : duel_of_earlier_rows(options, engines);
}

}  // namespace

void add_duel(CLI::App& program, int& status) {
  const auto options = std::make_shared<DuelOptions>();
  options->request.repeat = 3;
  options->request.out = "plumb-results";
  options->replays.scenes = 6;
  CLI::App* verb =
      program.add_subcommand("duel", "Hold two engines against each other: what tells them apart, on one page");
  add_cell_options(*verb, options->request);
  verb->add_option("--out", options->request.out,
                   "Folder for results and recordings; what is finished there is not run again")
      ->type_name("DIR")
      ->capture_default_str();
  const std::vector<CLI::Option*> of_runs = verb->get_options();
  verb->add_option(
          "A", options->first,
          "An engine: a backend by name or file, and after a colon a profile or settings: bullet, bullet:tuned, "
          "impulse:solver=si,substeps=8")
      ->required();
  verb->add_option("B", options->second, "The other one")->required();
  verb->add_option(
      "SCENE", options->request.scenes,
      "Scenes: ids (D1), slugs (tower), groups (stacking, core, all) or files; none: core, with --from all "
      "that are there");
  CLI::Option* from =
      verb->add_option("--from", options->from, "Run nothing: take the rows of this folder or file")->type_name("DIR");
  for (CLI::Option* option : of_runs) {
    if (option != verb->get_help_ptr()) from->excludes(option);
  }
  verb->add_option("--html", options->html, "The page; none: duel-A-B.html in the folder of --out, with --from here")
      ->type_name("FILE");
  verb->add_option("--replays", options->replays.scenes,
                   "At most so many scenes as replays, each engine's once recorded")
      ->check(whole_number_within(0, most_replays))
      ->capture_default_str();
  add_examples(*verb,
               {{"plumb duel impulse bullet stacking", "two engines on a group of scenes"},
                {"plumb duel ode ode:tuned D1 E1 --html ode.html", "an engine as it ships against its author's file"},
                {"plumb duel impulse bullet --from results", "of results that were made before"}});
  verb->callback([options, &status] { status = duel(*options); });
}

}  // namespace plumb::harness
