// plumb pairs: what backends find between all pairs of shapes, as recordings for the report's viewer.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/verbs/verbs.hpp"
#include "plumb/nearest.hpp"
#include "record/pair_tour.hpp"
#include "worker/backends.hpp"

namespace plumb::harness {

namespace {

struct PairsOptions {
  std::string out = "plumb-results";
  std::vector<std::string> backends, pairs;
  double timeout = 60;
};

/// The tour's name, or its shapes the other way round.
bool is_called(const PairTour& tour, const std::string& name) {
  const auto& bodies = tour.scene.bodies;
  return name == tour.name || name == bodies[1].name + "-" + bodies[0].name;
}

std::vector<PairTour> wanted_tours(const std::vector<std::string>& asked) {
  std::vector<PairTour> tours = all_pair_tours();
  for (const std::string& name : asked) {
    if (std::any_of(tours.begin(), tours.end(), [&](const PairTour& tour) { return is_called(tour, name); })) continue;
    std::vector<std::string> names;
    for (const PairTour& tour : tours) names.push_back(tour.name);
    throw UsageError("--pair " + name + ": there is no such pair" + suggestion(name, names));
  }
  if (asked.empty()) return tours;
  std::erase_if(tours, [&](const PairTour& tour) {
    return std::none_of(asked.begin(), asked.end(), [&](const std::string& name) { return is_called(tour, name); });
  });
  return tours;
}

void record_pairs(const PairsOptions& options) {
  const std::vector<PairTour> tours = wanted_tours(options.pairs);
  const auto files = backend_files(options.backends);
  const std::filesystem::path folder = std::filesystem::path(options.out) / "trajectories";
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw UsageError("--out " + options.out + ": " + failure.message());
  const auto file_of = [&](const PairTour& tour, const std::string& who) {
    return std::filesystem::absolute(folder / ("pair-" + tour.name + "-" + who + ".plt")).string();
  };
  for (const PairTour& tour : tours) record_pair_of_referee(tour, file_of(tour, "referee"));
  for (const auto& [name, file] : files) {
    std::unique_ptr<WorkerProcess> worker;
    std::size_t recorded = 0;
    for (const PairTour& tour : tours) {
      if (!worker || !worker->alive()) worker = std::make_unique<WorkerProcess>(file);
      const Answer answer =
          worker->ask({{"request", "pairs"}, {"pair", tour.name}, {"file", file_of(tour, name)}}, {options.timeout});
      const bool answered = answer.status == "ok";
      const std::string status = answered ? answer.json.value("status", "error") : answer.status;
      if (status == "ok") {
        ++recorded;
      } else {
        std::cout << fmt::format("{} {}: {}: {}\n", name, tour.name, status,
                                 answered ? answer.json.value("reason", "") : answer.reason);
      }
    }
    std::cout << fmt::format("{}: {} of {} pairs\n", name, recorded, tours.size());
  }
  std::cout << "recordings in " << folder.string() << "\n";
}

}  // namespace

void add_pairs(CLI::App& program, int& status) {
  const auto options = std::make_shared<PairsOptions>();
  CLI::App* verb = program.add_subcommand(
      "pairs", "Record what backends find between all pairs of shapes as one passes around and into the other");
  verb->add_option("--backend,BACKEND", options->backends,
                   "Names or files, with or without --backend; none: all on the search path")
      ->type_name("BACKEND");
  verb->add_option("--out", options->out, "Results folder: its report shows them")
      ->type_name("DIR")
      ->capture_default_str();
  verb->add_option("--pair", options->pairs, "Only this pair, such as box-capsule or capsule-box; repeatable")
      ->type_name("PAIR")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb->add_option("--timeout", options->timeout, "Seconds that one pair may take")
      ->type_name("SECONDS")
      ->check(number_above_0());
  add_examples(*verb, {{"plumb pairs --out pairs", "all backends; then plumb report pairs --html pairs.html"},
                       {"plumb pairs ode --pair box-capsule --out pairs", "one backend, one pair"}});
  verb->callback([options, &status] {
    catch_signals();
    record_pairs(*options);
    status = 0;
  });
}

}  // namespace plumb::harness
