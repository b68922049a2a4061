// One picture of all engines as they ship: how much slower than the fastest, and how far from the threshold.
#include <fmt/format.h>

#include <algorithm>

#include "report/ordered/default_run.hpp"
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

/// Engines that a comparison is about: those that ran at least half of the scenes.
std::vector<std::string> engines_of(const PageContext& context) {
  std::vector<std::string> engines;
  for (const std::string& backend : context.ordered.backends) {
    const auto ran =
        std::count_if(context.ordered.problems.begin(), context.ordered.problems.end(),
                      [&](const Problem& p) { return context.ordered.representative(p, backend) != nullptr; });
    if (2 * static_cast<std::size_t>(ran) >= context.ordered.problems.size()) engines.push_back(backend);
  }
  return engines;
}

Interval quartiles(const std::vector<double>& values) {
  return {quantile(values, 0.25).value_or(0), quantile(values, 0.75).value_or(0)};
}

}  // namespace

Json speed_figure(const PageContext& context) {
  const std::vector<std::string> engines = engines_of(context);
  std::vector<std::vector<Run>> runs(engines.size());
  // Only what all of them ran to the end: a median over what one engine can do says nothing beside another's. Time is
  // told by the fastest that passes: one that fails faster still sets no mark.
  for (const Problem& problem : context.ordered.problems) {
    std::vector<Run> beside;
    for (const std::string& engine : engines) {
      if (const std::optional<Run> run = run_of(context, problem, engine)) beside.push_back(*run);
    }
    if (beside.empty() || beside.size() < engines.size()) continue;
    std::optional<double> fastest;
    for (const Run& run : beside) {
      if (run.row->passes() && (!fastest || run.ms < *fastest)) fastest = run.ms;
    }
    if (!fastest) continue;
    for (std::size_t i = 0; i < engines.size(); ++i)
      runs[i].push_back({beside[i].row, beside[i].ms / *fastest, beside[i].error});
  }
  if (engines.size() < 2 || runs.front().empty()) return nullptr;
  Plot plot;
  plot.description =
      "time over that of the fastest engine that passes and error over the scene's threshold, every engine as it ships";
  plot.x.title = "times the step of the fastest engine that passes";
  plot.y = {"error over the scene's threshold", true, smallest, largest};
  plot.levels = {{1, "threshold"}};
  std::vector<PlotSeries> medians;
  for (std::size_t i = 0; i < engines.size(); ++i) {
    PlotSeries specks{engines[i] + ", a scene", context.backend_index(engines[i])};
    specks.joined = false;
    specks.quiet = true;
    std::vector<double> times, errors;
    for (const Run& run : runs[i]) {
      specks.points.push_back({run.ms, run.error, run.row});
      times.push_back(run.ms);
      errors.push_back(run.error);
    }
    PlotSeries middle{engines[i] + ", median", specks.engine};
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
      R"(speck is a scene variant, on the edge if it lies beyond.</p>)",
      runs.front().size(), context.ordered.problems.size());
  return figure_data(figure);
}

}  // namespace plumb::harness
