// plumb conform: what backends claim against what they do, one check at a time, each backend in a process of its own.
#include <fmt/format.h>

#include <iostream>
#include <map>
#include <memory>

#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "conform/conformance.hpp"
#include "plumb/nearest.hpp"
#include "run/plan.hpp"

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

void print_text(const std::string& backend, const conform::Check& check, const Json& row) {
  const std::string outcome = row.at("outcome");
  std::cout << fmt::format("{:10} {:28} {:8} {}\n", backend, check.name, outcome,
                           outcome == "skipped" ? std::string(row.at("failures").at(0)) : check.doc);
  if (outcome != "failed") return;
  const Json& failures = row.at("failures");
  for (std::size_t i = 0; i < failures.size() && i < kShown; ++i)
    std::cout << "    " << std::string(failures.at(i)) << "\n";
  if (failures.size() > kShown) std::cout << fmt::format("    and {} more\n", failures.size() - kShown);
}

/// Runs the checks on one backend; a worker that ends uncleanly is a failed check, and the next check gets a new one.
void conform_backend(const std::string& name, const std::string& file, const ConformOptions& options,
                     std::map<std::string, int>& counts) {
  WorkerLimits limits = StudyRequest().limits();
  limits.seconds = options.timeout;
  std::unique_ptr<WorkerProcess> worker;
  for (const conform::Check& check : wanted_checks(options.checks)) {
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
    row.erase("status");
    ++counts[row.at("outcome")];
    if (options.json)
      std::cout << line_of(row) << std::endl;
    else
      print_text(name, check, row);
  }
}

}  // namespace

void add_conform(CLI::App& program, int& status) {
  const auto options = std::make_shared<ConformOptions>();
  CLI::App* verb = program.add_subcommand("conform", "Check what backends claim against what they do");
  verb->add_option("BACKEND", options->backends, "Names or files; none: all on the search path");
  verb->add_option("--check", options->checks, "Only this check, or this group of checks (\"joints\")");
  verb->add_option("--timeout", options->timeout, "Seconds that one check may take")->check(CLI::PositiveNumber);
  verb->add_flag("--list", options->list, "List the checks");
  verb->add_flag("--json", options->json, "One object a check, one a line");
  verb->callback([options, &status] {
    if (options->list) {
      for (const conform::Check& check : wanted_checks(options->checks))
        std::cout << fmt::format("{:28} {}\n", check.name, check.doc);
      status = 0;
      return;
    }
    (void)wanted_checks(options->checks);
    catch_signals();
    std::map<std::string, int> counts;
    for (const auto& [name, file] : backend_files(options->backends)) conform_backend(name, file, *options, counts);
    if (!options->json)
      std::cout << fmt::format("{} passed, {} failed, {} skipped\n", counts["passed"], counts["failed"],
                               counts["skipped"]);
    status = counts["failed"] == 0 ? 0 : 1;
  });
}

}  // namespace plumb::harness
