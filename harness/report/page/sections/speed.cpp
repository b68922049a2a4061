// One picture of all engines as they ship: how much slower than the fastest, and how far from the threshold.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "report/ordered/default_run.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {
namespace {

constexpr double smallest = 1e-4, largest = 1e4;  ///< of error over threshold: beyond, nothing more is said

struct Run {
  const Row* row;
  double ms, error;  ///< per step; over the threshold
};

std::optional<Run> run_of(const PageContext& context, const Problem& problem, const std::string& backend) {
  const Row* row = default_run(context.ordered, problem, backend);
  if (!row || !row->completed() || !row->fair_ms() || *row->fair_ms() <= 0) return std::nullopt;
  const MetricResult* worst = row->worst();
  const std::optional<double> badness = worst ? worst->badness() : std::nullopt;
  return badness ? std::optional<Run>({row, *row->fair_ms(), *badness}) : std::nullopt;
}

/// An engine's runs as it ships, a place for each problem.
struct EngineRuns {
  std::string engine;
  std::vector<std::optional<Run>> runs;
  std::size_t count = 0;  ///< of those that it has
};

/// Engines that a comparison is about: those that ran at least half of the scenes.
std::vector<EngineRuns> engines_of(const PageContext& context) {
  const std::vector<Problem>& problems = context.ordered.problems;
  std::vector<EngineRuns> engines;
  for (const std::string& backend : context.ordered.backends) {
    const auto ran = std::count_if(problems.begin(), problems.end(), [&](const Problem& p) {
      return context.ordered.representative(p, backend) != nullptr;
    });
    if (2 * static_cast<std::size_t>(ran) < problems.size()) continue;
    EngineRuns all{backend, {}};
    for (const Problem& problem : problems) {
      all.runs.push_back(run_of(context, problem, backend));
      all.count += all.runs.back().has_value();
    }
    engines.push_back(std::move(all));
  }
  return engines;
}

/// Problems that all of the engines ran to the end, in a time that counts, and one of them passes.
std::vector<std::size_t> common_problems(const std::vector<EngineRuns>& engines, std::size_t problems) {
  std::vector<std::size_t> common;
  for (std::size_t p = 0; p < problems; ++p) {
    const bool all = std::all_of(engines.begin(), engines.end(), [&](const EngineRuns& e) { return e.runs[p]; });
    const auto passes = [&](const EngineRuns& e) { return e.runs[p]->row->passes(); };
    if (all && std::any_of(engines.begin(), engines.end(), passes)) common.push_back(p);
  }
  return common;
}

/// Takes away those with the fewest runs until an eighth of the problems is common to the rest; names of those taken.
std::vector<std::string> drop_sparse(std::vector<EngineRuns>& engines, std::size_t problems) {
  std::vector<std::string> dropped;
  while (engines.size() > 2 && 8 * common_problems(engines, problems).size() < problems) {
    const auto sparse = std::min_element(engines.begin(), engines.end(),
                                         [](const EngineRuns& a, const EngineRuns& b) { return a.count < b.count; });
    dropped.push_back(sparse->engine);
    engines.erase(sparse);
  }
  return dropped;
}

/// The time of the fastest that passes: one that fails faster still sets no mark.
double fastest_pass(const std::vector<EngineRuns>& engines, std::size_t problem) {
  double fastest = std::numeric_limits<double>::infinity();
  for (const EngineRuns& engine : engines) {
    const Run& run = *engine.runs[problem];
    if (run.row->passes()) fastest = std::min(fastest, run.ms);
  }
  return fastest;
}

Interval quartiles(const std::vector<double>& values) {
  return {quantile(values, 0.25).value_or(0), quantile(values, 0.75).value_or(0)};
}

}  // namespace

Json speed_figure(const PageContext& context) {
  std::vector<EngineRuns> engines = engines_of(context);
  const std::size_t asked = engines.size(), problems = context.ordered.problems.size();
  // Only what all of them ran to the end: a median over what one engine can do says nothing beside another's.
  const std::vector<std::string> dropped = drop_sparse(engines, problems);
  const std::vector<std::size_t> common = common_problems(engines, problems);
  if (engines.size() < 2 || 2 * engines.size() < asked || common.empty()) return nullptr;
  Plot plot;
  plot.description =
      "time over that of the fastest engine that passes and error over the scene's threshold, every engine as it ships";
  plot.x.title = "times the step of the fastest engine that passes";
  plot.y = {"error over the scene's threshold", true, smallest, largest};
  plot.levels = {{1, "threshold"}};
  std::vector<PlotSeries> medians;
  for (const EngineRuns& engine : engines) {
    PlotSeries specks{engine.engine + ", a scene", context.backend_index(engine.engine)};
    specks.joined = false;
    specks.quiet = true;
    std::vector<double> times, errors;
    for (const std::size_t problem : common) {
      const Run& run = *engine.runs[problem];
      const double time = run.ms / fastest_pass(engines, problem);
      specks.points.push_back({time, run.error, run.row});
      times.push_back(time);
      errors.push_back(run.error);
    }
    PlotSeries middle{engine.engine + ", median", specks.engine};
    middle.joined = false;
    middle.large = true;
    middle.points.push_back({median(times).value_or(0), median(errors).value_or(0), nullptr, true, false,
                             quartiles(times), quartiles(errors)});
    plot.series.push_back(std::move(specks));
    medians.push_back(std::move(middle));
  }
  plot.series.insert(plot.series.end(), medians.begin(), medians.end());
  FigureData figure;
  figure.title = "";
  figure.plots = {std::move(plot)};
  figure.notes = fmt::format(
      R"(<p class="frame-note">Every engine as it ships, over the {} of {} scene variants that all of these ran to )"
      R"(the end and one passes: lower left is better, below the line is a pass. Large: the median, its bars the middle half; a )"
      R"(speck is a scene variant, on the edge if it lies beyond.{}</p>)",
      common.size(), problems,
      dropped.empty() ? ""
                      : fmt::format(" Not in it, for they have too few runs whose time counts: {}.",
                                    escape_html(fmt::format("{}", fmt::join(dropped, ", ")))));
  return figure_data(figure);
}

}  // namespace plumb::harness
