#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/output/draft_file.hpp"
#include "cli/output/output.hpp"
#include "cli/verbs/earlier_rows.hpp"
#include "cli/verbs/page_replays.hpp"
#include "cli/verbs/verbs.hpp"
#include "report/page/page.hpp"
#include "report/text/against_text.hpp"
#include "report/text/csv.hpp"
#include "report/text/failures.hpp"
#include "report/text/markdown.hpp"
#include "report/text/scorecard_text.hpp"
#include "report/text/terminal.hpp"
#include "rows/results_folder.hpp"
#include "rows/results_reader.hpp"

namespace plumb::harness {

namespace {

struct ReportOptions {
  std::vector<std::string> folders;
  std::string html, against;
  AgainstLimits limits;
  bool markdown = false, csv = false, json = false, failures = false, strict = false;
  bool no_replays = false;
  ReplayLimits replays;
};

std::string page_text(const std::vector<Row>& rows, PageOptions page) {
  page.written = date_of_page();
  page.scenes = scene_texts();
  std::ostringstream out;
  write_page(out, rows, page);
  return out.str();
}

/// What `plumb pairs` makes by itself: recordings, which a page shows, and no rows.
bool has_recordings_alone(const std::string& folder) {
  std::error_code ignored;
  return results_files(folder).empty() && std::filesystem::is_directory(folder + "/trajectories", ignored);
}

PageOptions page_options(const ReportOptions& options, const std::vector<Row>& baseline) {
  PageOptions page{{}, fmt::format("{}", fmt::join(options.folders, ", ")), {}, {}, {}};
  for (const std::string& folder : options.folders) {
    const Json study = read_study(folder);
    const auto text = [&](const char* name) {
      const auto found = study.find(name);
      return found != study.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    if (study.is_object()) page.studies.push_back({text("name"), text("command")});
  }
  if (!options.against.empty()) page.against = AgainstPart{options.against, baseline, options.limits};
  return page;
}

/// Prints what changed, in the form that was asked for, and returns whether something got worse.
bool report_against(const ReportOptions& options, const std::vector<Row>& rows, const std::vector<Row>& baseline) {
  const OrderedRows before(baseline), after(rows);
  const Comparison comparison = compare_results(before.rows, after.rows, options.limits);
  if (options.markdown) {
    write_against_markdown(std::cout, comparison, before, after, options.against, options.limits);
    write_scorecard_markdown(std::cout, rows, &baseline, options.limits);
  } else if (options.json) {
    std::cout << line_of(against_json(comparison, options.against, options.limits)) << '\n';
  } else {
    print_against(std::cout, comparison, before, after, options.against, options.limits, terminal_width(),
                  wants_colour());
    print_scorecard(std::cout, rows, &baseline, options.limits, terminal_width(), wants_colour());
  }
  return comparison.count(Sense::worse) > 0;
}

int report(const ReportOptions& options) {
  std::optional<DraftFile> file;
  if (!options.html.empty()) file.emplace(options.html);
  std::vector<Row> rows;
  for (const std::string& folder : options.folders) {
    if (file && has_recordings_alone(folder)) continue;
    for (Row& row : earlier_rows(folder)) {
      row.origin.index = rows.size();
      rows.push_back(std::move(row));
    }
  }
  const std::vector<Row> baseline = options.against.empty() ? std::vector<Row>() : earlier_rows(options.against);
  if (file) {
    PageOptions page = page_options(options, baseline);
    // Of several machines one was looked at, if any.
    for (const std::string& folder : options.folders)
      if (!options.no_replays && page.replays.empty()) add_replays(folder, options.replays, page);
    file->write(page_text(rows, std::move(page)));
    fmt::print(stderr, "wrote {}\n", options.html);
  }
  if (!options.against.empty()) return report_against(options, rows, baseline) && options.strict ? 1 : 0;
  if (options.markdown) write_markdown(std::cout, rows);
  if (options.failures) write_failures(std::cout, rows);
  if (options.csv) write_csv(std::cout, rows);
  if (options.json) {
    for (const Row& row : rows) std::cout << line_of(to_json(row)) << '\n';
  }
  if (options.html.empty() && !options.markdown && !options.csv && !options.json && !options.failures) {
    print_comparison(std::cout, rows, terminal_width(), wants_colour());
    print_scorecard(std::cout, rows, nullptr, options.limits, terminal_width(), wants_colour());
  }
  return 0;
}

}  // namespace

void add_report(CLI::App& program, int& status) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* verb =
      program.add_subcommand("report", "Show results that were made before: tables, or a page for a browser");
  verb->add_option("DIR", options->folders,
                   "Folders with results*.jsonl, or such files; those of several machines are told apart")
      ->required();
  verb->add_option("--html", options->html, "Write one self-contained page to this file")->type_name("FILE");
  verb->add_option("--replays", options->replays.scenes,
                   "At most so many scenes as replays in the page, pairs of shapes apart")
      ->check(whole_number_within(0, 1000000));
  verb->add_flag("--no-replays", options->no_replays, "No replays in the page")->excludes("--replays");
  CLI::Option* markdown = verb->add_flag("--md", options->markdown, "Print Markdown");
  CLI::Option* csv = verb->add_flag("--csv", options->csv, "Print CSV, a line a metric");
  CLI::Option* json = verb->add_flag("--json", options->json, "Print one JSON object a cell, one a line");
  CLI::Option* failures =
      verb->add_flag("--failures", options->failures,
                     "Print as Markdown what each engine does not pass at its defaults, and by how much");
  CLI::Option* against = verb->add_option("--against", options->against,
                                          "Say what got better or worse than in this folder of earlier results")
                             ->type_name("DIR");
  verb->add_flag("--strict", options->strict, "Exit with 1 when something got worse")->needs(against);
  verb->add_option("--error-limit", options->limits.error, "Relative change of an error that counts")
      ->needs(against)
      ->check(number_from_0())
      ->capture_default_str();
  CLI::Option* time_limit = verb->add_option("--time-limit", options->limits.single_time,
                                             "Relative change of a time that counts where it was measured once")
                                ->needs(against)
                                ->check(number_from_0())
                                ->capture_default_str();
  verb->add_flag_callback(
          "--ignore-times", [options] { options->limits.ignore_times(); },
          "No time counts: for machines that others use, too")
      ->needs(against)
      ->excludes(time_limit);
  markdown->excludes(csv)->excludes(json)->excludes(failures);
  csv->excludes(json)->excludes(against)->excludes(failures);
  failures->excludes(json)->excludes(against);
  add_examples(*verb, {{"plumb report results", "the table again"},
                       {"plumb report results --html page.html", "one page that needs no network"},
                       {"plumb report new --against old --strict", "for CI: status 1 when something got worse"},
                       {"plumb report xeon h200 --md", "two machines, as Markdown"}});
  verb->callback([options, &status] { status = report(*options); });
}

}  // namespace plumb::harness
