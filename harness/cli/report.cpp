#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "cli/output.hpp"
#include "cli/page_replays.hpp"
#include "cli/verbs.hpp"
#include "report/csv.hpp"
#include "report/markdown.hpp"
#include "report/page/page.hpp"
#include "report/results_file.hpp"
#include "report/terminal.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness {

namespace {

struct ReportOptions {
  std::string folder, html;
  bool markdown = false, csv = false, json = false;
  bool no_replays = false;
  ReplayLimits replays;
};

/// Titles of the scenes that are at hand: without them (results from elsewhere, a broken file) a page shows ids alone.
std::map<std::string, SceneText> scene_texts() {
  std::map<std::string, SceneText> texts;
  try {
    for (const SceneFile& file : all_scenes()) texts[file.id] = {file.title, file.doc};
  } catch (const UsageError& error) {
    fmt::print(stderr, "plumb: the page goes without the titles of scenes: {}\n", error.what());
  }
  return texts;
}

/// Written beside and moved into place, so that a reader never sees half a page.
void write_page_file(const std::string& file, const PageOptions& options, const std::vector<Json>& rows) {
  const std::string draft = file + ".part";
  {
    std::ofstream out(draft, std::ios::binary);
    write_page(out, rows, options);
    out.close();
    if (!out) {
      std::error_code ignored;
      std::filesystem::remove(draft, ignored);
      throw UsageError("cannot write " + file + "; name a file in a folder that is there and may be written to");
    }
  }
  std::error_code failure;
  std::filesystem::rename(draft, file, failure);
  if (failure) {
    std::error_code ignored;
    std::filesystem::remove(draft, ignored);
    throw UsageError("cannot write " + file + ": " + failure.message());
  }
}

void report(const ReportOptions& options) {
  const Results results = read_results(std::filesystem::path(options.folder));
  for (const std::size_t line : results.unreadable_lines) {
    fmt::print(stderr, "plumb: line {} of the results in {} is no JSON object and is left out\n", line, options.folder);
  }
  if (results.rows.empty())
    throw UsageError("there are no results in " + options.folder + "; make some with plumb run --out " +
                     options.folder);
  if (!options.html.empty()) {
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    PageOptions page{fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(now)), options.folder, scene_texts()};
    if (!options.no_replays) add_replays(options.folder, options.replays, page);
    write_page_file(options.html, page, results.rows);
    fmt::print(stderr, "wrote {}\n", options.html);
  }
  if (options.markdown) write_markdown(std::cout, results.rows);
  if (options.csv) write_csv(std::cout, results.rows);
  if (options.json) {
    for (const Json& row : results.rows) std::cout << line_of(row) << '\n';
  }
  if (options.html.empty() && !options.markdown && !options.csv && !options.json) {
    print_comparison(std::cout, results.rows, terminal_width(), wants_colour());
  }
}

}  // namespace

void add_report(CLI::App& program, int& status) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* verb =
      program.add_subcommand("report", "Show results that were made before: tables, or a page for a browser");
  verb->add_option("DIR", options->folder, "Folder with results.jsonl, or such a file")->required();
  verb->add_option("--html", options->html, "Write one self-contained page to this file");
  verb->add_option("--replays", options->replays.scenes,
                   "At most so many scenes as replays in the page, pairs of shapes apart");
  verb->add_flag("--no-replays", options->no_replays, "No replays in the page")->excludes("--replays");
  CLI::Option* markdown = verb->add_flag("--md", options->markdown, "Print Markdown");
  CLI::Option* csv = verb->add_flag("--csv", options->csv, "Print CSV, a line a metric");
  CLI::Option* json = verb->add_flag("--json", options->json, "Print one JSON object a cell, one a line");
  markdown->excludes(csv)->excludes(json);
  csv->excludes(json);
  verb->callback([options, &status] {
    report(*options);
    status = 0;
  });
}

}  // namespace plumb::harness
