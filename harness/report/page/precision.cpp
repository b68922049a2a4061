// Work-precision diagrams: what each run cost against how wrong it was.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/plot.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

constexpr double largest_error = 10;  ///< beyond that nothing is told apart: all of it is wrong

/// All that must be equal for points to be joined along dt.
std::string method_of(const Study& study, const ResultRow& row) {
  std::string out = row.profile == "default" ? "" : row.profile;
  for (const auto& [name, value] : study.changed_settings(row)) out += (out.empty() ? "" : ", ") + name + " " + value;
  if (row.threads && *row.threads != 1)
    out += fmt::format("{}{} threads", out.empty() ? "" : ", ", shortest_number(*row.threads));
  return out.empty() ? "default settings" : out;
}

struct Figure {
  std::string title;
  Plot plot;
  std::vector<std::string> methods;  ///< by line pattern
};

PlotPoint point_of(const PageContext& context, const ResultRow& row, const MetricResult& metric) {
  PlotPoint point{*row.ms_per_simulated_second(), *metric.error, {}, {}, context.study.is_default(row), {},
                  fmt::format("#r{}", row.index)};
  if (row.min_ms && row.p99_ms && *row.min_ms > 0) {
    point.x_low = *row.min_ms / *row.dt;
    point.x_high = *row.p99_ms / *row.dt;
  }
  point.hover = fmt::format("{} {}\n{}\n{} {}\n{} ms per simulated second{}", row.backend, row.variant(),
                            context.study.configuration(row), metric.name, short_number(*metric.error),
                            short_number(point.x), point.filled ? "\ndefaults" : "");
  return point;
}

Figure make_figure(const PageContext& context, const std::vector<const ResultRow*>& rows,
                   const std::string& metric_name, const std::string& title) {
  Figure figure;
  figure.title = title;
  figure.plot.description = fmt::format("{}: error against cost of each backend", title);
  figure.plot.x.title = "ms per simulated second";
  figure.plot.y.title = "error";
  figure.plot.y.highest = largest_error;
  figure.plot.slopes = true;
  std::map<std::string, std::size_t> patterns;
  std::map<std::tuple<std::size_t, std::string, std::string>, PlotSeries> series;  // backend, method, variant
  for (const ResultRow* row : rows) {
    const MetricResult* metric = row->metric(metric_name);
    if (!row->completed() || !metric || !metric->error || !row->ms_per_simulated_second()) continue;
    if (context.curves.is_turned(*row)) continue;
    const std::size_t backend = context.backend_index(row->backend);
    const std::string method = method_of(context.study, *row);
    const auto [pattern, is_new] = patterns.try_emplace(method, patterns.size());
    if (is_new) figure.methods.push_back(method);
    PlotSeries& line = series[{backend, method, row->variant()}];
    line.colour = backend;
    line.pattern = pattern->second;
    line.hover = fmt::format("{}, {}", row->backend, method);
    line.points.push_back(point_of(context, *row, *metric));
  }
  for (auto& [key, line] : series) {
    std::sort(line.points.begin(), line.points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    figure.plot.series.push_back(std::move(line));
  }
  return figure;
}

/// Yes/no questions have errors of 0 and 1 only: nothing to draw.
bool graded(const Figure& figure) {
  for (const PlotSeries& series : figure.plot.series) {
    for (const PlotPoint& point : series.points) {
      if (point.y != 0 && point.y != 1) return true;
    }
  }
  return false;
}

std::string render_figure(const PageContext& context, const Problem& problem, const Figure& figure) {
  std::string legend;
  if (figure.methods.size() > 1) {
    for (std::size_t i = 0; i < std::min(figure.methods.size(), plot_patterns); ++i) {
      legend += fmt::format(R"(<span>{}{}</span>)", render_pattern(i), escape_html(figure.methods[i]));
    }
    if (figure.methods.size() > plot_patterns)
      legend += fmt::format("<span>and {} more</span>", figure.methods.size() - plot_patterns);
  }
  return fmt::format(R"(<figure {}><figcaption>{}</figcaption>{}<div class="methods">{}</div></figure>)",
                     filter_key(context, problem, figure.title), escape_html(figure.title), render_plot(figure.plot),
                     legend);
}

/// Consecutive problems of one scene.
std::string scene_figures(const PageContext& context, const Problem* first, const Problem* last) {
  // With a sweep each variant has a diagram; without, a point each of all variants shares one.
  const bool swept = std::any_of(first, last, [&](const Problem& problem) {
    std::map<std::string, int> cells;
    return std::any_of(problem.rows.begin(), problem.rows.end(), [&](const ResultRow* row) {
      return !context.curves.is_turned(*row) && ++cells[row->backend] > 1;
    });
  });
  std::string out;
  const auto add = [&](const Problem& problem, const std::vector<const ResultRow*>& rows, const std::string& metric,
                       const std::string& title) {
    const Figure figure = make_figure(context, rows, metric, title);
    if (graded(figure)) out += render_figure(context, problem, figure);
  };
  if (swept) {
    for (const Problem* problem = first; problem != last; ++problem) {
      for (const std::string& metric : context.study.scored_metrics(*problem))
        add(*problem, problem->rows, metric, problem->title() + ", " + metric);
    }
    return out;
  }
  Problem all{first->scene, first->group, "", {}};
  for (const Problem* problem = first; problem != last; ++problem)
    all.rows.insert(all.rows.end(), problem->rows.begin(), problem->rows.end());
  for (const std::string& metric : context.study.scored_metrics(all))
    add(*first, all.rows, metric, first->scene + ", " + metric);
  return out;
}

}  // namespace

std::string precision_section(const PageContext& context) {
  std::string out =
      R"(<section id="precision"><h2>Work and precision</h2><p class="about">Every run as a point: what a simulated )"
      R"(second cost, and the error. )";
  if (!context.curves.problems.empty()) out += R"(Runs with a knob turned are under <a href="#curves">Curves</a>. )";
  out += R"(Lower left is better. Points are joined along the time step at equal settings; filled: the engine's )"
         R"(defaults; bars: fastest to 99th )"
         R"(percentile of the steps; an arrow: the error is zero, or beyond the frame.</p><p class="legend">)";
  for (const std::string& backend : context.study.backends)
    out +=
        fmt::format(R"(<span class="e{}">{}</span>)", context.backend_index(backend), backend_label(context, backend));
  out += "</p>";
  bool any = false;
  const std::vector<Problem>& problems = context.study.problems;
  for (const std::string& group : context.study.groups) {
    std::string figures;
    for (std::size_t i = 0; i < problems.size();) {
      std::size_t end = i;
      while (end < problems.size() && problems[end].scene == problems[i].scene &&
             problems[end].group == problems[i].group)
        ++end;
      if (problems[i].group == group) figures += scene_figures(context, &problems[i], &problems[i] + (end - i));
      i = end;
    }
    if (figures.empty()) continue;
    out += fmt::format(R"(<details class="group"{}><summary>{}</summary><div class="figures">{}</div></details>)",
                       any ? "" : " open", escape_html(group_title(group)), figures);
    any = true;
  }
  if (!any) out += R"(<p class="about">No metric has an error and a time to draw.</p>)";
  return out + "</section>";
}

}  // namespace plumb::harness
