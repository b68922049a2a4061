// plumb conform: what backends claim against what they do, one check at a time, each backend in a process of its own.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/output/output.hpp"
#include "cli/verbs/verbs.hpp"
#include "conform/conformance.hpp"
#include "plumb/nearest.hpp"
#include "schedule/plan.hpp"

namespace plumb::harness {

namespace {

struct ConformOptions {
  std::vector<std::string> backends, checks;
  bool json = false, list = false;
  double timeout = 120;
};

/// Failures that are printed of one check; the rest is counted.
constexpr std::size_t kShown = 12;

std::vector<conform::Check> wanted_checks(const std::vector<std::string>& names) {
  const std::vector<conform::Check> all = conform::all_checks();
  if (names.empty()) return all;
  std::vector<conform::Check> wanted;
  std::vector<std::string> known;
  for (const conform::Check& check : all) known.push_back(check.name);
  for (const std::string& name : names) {
    const std::size_t before = wanted.size();
    for (const conform::Check& check : all)
      if (name == check.name || std::string_view(check.name).starts_with(name + ".")) wanted.push_back(check);
    if (wanted.size() == before)
      throw UsageError(fmt::format("there is no check \"{}\"{}", name, suggestion(name, known)));
  }
  return wanted;
}

std::vector<std::string> failures_of(const Json& row) { return row.at("failures"); }

void print_failed(const Json& row) {
  const std::vector<std::string> failures = failures_of(row);
  for (std::size_t i = 0; i < failures.size() && i < kShown; ++i) std::cout << "    " << failures[i] << "\n";
  if (failures.size() > kShown) std::cout << fmt::format("    and {} more\n", failures.size() - kShown);
}

/// What the backend does not claim, and so nobody looked at: the reasons, those of most checks first.
void print_untested(const std::string& backend, const std::vector<Json>& rows) {
  std::map<std::string, std::vector<std::string>> checks;  // by reason
  std::size_t untested = 0;
  for (const Json& row : rows)
    if (row.at("outcome") == "skipped") {
      ++untested;
      checks[failures_of(row).at(0)].push_back(row.at("check"));
    }
  if (untested == 0) return;
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons(checks.begin(), checks.end());
  std::stable_sort(reasons.begin(), reasons.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  std::cout << fmt::format("{}: {} of {} checks are NOT TESTED, for it claims none of what they ask:\n", backend,
                           untested, rows.size());
  for (const auto& [reason, names] : reasons) std::cout << fmt::format("    {}: {}\n", reason, fmt::join(names, ", "));
}

/// What is untested, what failed, what passed; and all three in one line.
void print_text(const std::string& backend, const std::vector<Json>& rows) {
  print_untested(backend, rows);
  std::map<std::string, int> counts;
  for (const char* outcome : {"failed", "passed"})
    for (const Json& row : rows) {
      if (row.at("outcome") != outcome) continue;
      ++counts[outcome];
      std::cout << fmt::format("{:10} {:28} {:8} {}\n", backend, std::string(row.at("check")), outcome,
                               std::string(row.at("doc")));
      if (row.at("outcome") == "failed") print_failed(row);
    }
  const int untested = static_cast<int>(rows.size()) - counts["passed"] - counts["failed"];
  std::cout << fmt::format("{}: {}{} passed, {} failed\n", backend,
                           untested == 0 ? "" : fmt::format("{} of {} NOT TESTED, ", untested, rows.size()),
                           counts["passed"], counts["failed"]);
}

/// A line that the next one overwrites, for who waits at a terminal.
void show_progress(const std::string& backend, const std::string& check) {
  if (isatty(STDERR_FILENO) != 0) std::cerr << fmt::format("\r\x1b[K{}: {}", backend, check) << std::flush;
}

/// Runs the checks on one backend; a worker that ends uncleanly is a failed check, and the next check gets a new one.
std::vector<Json> conform_backend(const std::string& name, const std::string& file, const ConformOptions& options) {
  WorkerLimits limits = RunRequest().limits();
  limits.engine_seconds = options.timeout;
  std::unique_ptr<WorkerProcess> worker;
  std::vector<Json> rows;
  for (const conform::Check& check : wanted_checks(options.checks)) {
    show_progress(name, check.name);
    if (!worker || !worker->alive()) worker = std::make_unique<WorkerProcess>(file);
    const Answer answer = worker->ask({{"request", "conform"}, {"check", check.name}}, limits);
    Json row = answer.json;
    const bool answered = answer.status == "ok" && row.contains("outcome");
    if (!answered) {
      const std::string reason =
          answer.status == "ok" ? row.value("reason", "no answer") : answer.status + ": " + answer.reason;
      row = {{"outcome", "failed"}, {"expectations", 0}, {"failures", {reason}}};
    }
    row["backend"] = name;
    row["check"] = check.name;
    row["doc"] = check.doc;
    row.erase("status");
    if (options.json) std::cout << line_of(row) << std::endl;
    rows.push_back(std::move(row));
  }
  show_progress("", "");
  return rows;
}

}  // namespace

void add_conform(CLI::App& program, int& status) {
  const auto options = std::make_shared<ConformOptions>();
  CLI::App* verb = program.add_subcommand("conform", "Check what backends claim against what they do");
  verb->add_option("BACKEND", options->backends, "Names or files; none: all on the search path");
  verb->add_option("--check", options->checks, "Only this check, or this group of checks (\"joints\")")
      ->type_name("CHECK");
  verb->add_option("--timeout", options->timeout, "Seconds that one check may take")
      ->type_name("SECONDS")
      ->check(number_above_0());
  verb->add_flag("--list", options->list, "List the checks");
  verb->add_flag("--json", options->json, "One object a check, one a line");
  add_examples(*verb, {{"plumb conform ode", "what a backend claims against what it does"},
                       {"plumb conform build/plumb-mine.so --check joints", "one group of checks, of a file"},
                       {"plumb conform --list", "the checks"}});
  verb->callback([options, &status] {
    if (options->list) {
      for (const conform::Check& check : wanted_checks(options->checks))
        std::cout << fmt::format("{:28} {}\n", check.name, check.doc);
      status = 0;
      return;
    }
    (void)wanted_checks(options->checks);
    catch_signals();
    bool failed = false, tested = false;
    for (const auto& [name, file] : backend_files(options->backends)) {
      const std::vector<Json> rows = conform_backend(name, file, *options);
      if (!options->json) print_text(name, rows);
      for (const Json& row : rows) {
        failed = failed || row.at("outcome") == "failed";
        tested = tested || row.at("outcome") != "skipped";
      }
    }
    status = failed || !tested ? 1 : 0;
  });
}

}  // namespace plumb::harness
