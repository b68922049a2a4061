// Work-precision diagrams: what each run cost against how wrong it was.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "report/format.hpp"
#include "report/order.hpp"
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
  std::vector<std::string> methods;    ///< by line pattern
  std::string orders;                  ///< list items
  std::vector<const ResultRow*> rows;  ///< that have a point
};

PlotPoint point_of(const PageContext& context, const Sample& sample, const std::string& metric, const Measured& cost,
                   const Measured& error) {
  const ResultRow& row = sample.row();
  PlotPoint point{cost.value, error.value, {}, {}, context.study.is_default(row), {}, fmt::format("#r{}", row.index)};
  if (cost.band) {
    point.x_low = cost.band->low;
    point.x_high = cost.band->high;
  }
  if (error.band && std::isfinite(error.band->high)) {
    point.y_low = error.band->low;
    point.y_high = error.band->high;
  }
  point.hover = fmt::format("{} {}\n{}\n{} {}\n{} ms per simulated second{}", row.backend, row.problem_variant(),
                            context.study.configuration(row), metric, short_number(point.y), short_number(point.x),
                            point.filled ? "\ndefaults" : "");
  if (sample.rows.size() > 1) point.hover += fmt::format("\n{} seeds", sample.rows.size());
  return point;
}

/// A line over dt as it is made, with what its order is fitted to.
struct DtLine {
  PlotSeries series;
  std::vector<OrderPoint> points;
  std::string backend, method, variant;
};

/// The fitted line where the points are: at their cost, which stands for the time step that it was paid for.
void add_order(const PageContext& context, DtLine& line, bool one_method, Figure& figure) {
  const std::optional<Order> order = fit_order(line.points);
  if (!order) return;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    line.series.fit.emplace_back(line.series.points[i].x, order->at(line.points[i].turned));
  std::string name = line.variant;
  if (!one_method) name += (name.empty() ? "" : ", ") + line.method;
  line.series.fit_hover = fmt::format("{}: error falls with dt to the power {}", line.backend, order_text(*order));
  figure.orders += fmt::format(R"(<li class="e{}">{} {}{}</li>)", context.backend_index(line.backend),
                               backend_label(context, line.backend), order_text(*order),
                               name.empty() ? "" : fmt::format(" <small>{}</small>", escape_html(name)));
}

Figure make_figure(const PageContext& context, const Problem& problem, const std::string& metric,
                   const std::string& title) {
  Figure figure;
  figure.title = title;
  figure.plot.description = fmt::format("{}: error against cost of each backend", title);
  figure.plot.x.title = "ms per simulated second";
  figure.plot.y.title = "error";
  figure.plot.y.highest = largest_error;
  figure.plot.slopes = true;
  std::map<std::string, std::size_t> patterns;
  std::map<std::tuple<std::size_t, std::string, std::string>, DtLine> lines;  // backend, method, variant
  for (const Sample& sample : samples_of(problem, "")) {
    const ResultRow& row = sample.row();
    const std::optional<Measured> error = sample.error(metric), cost = sample.cost();
    if (!error || !cost || context.curves.is_turned(row)) continue;
    const std::size_t backend = context.backend_index(row.backend);
    const std::string method = method_of(context.study, row);
    const auto [pattern, is_new] = patterns.try_emplace(method, patterns.size());
    if (is_new) figure.methods.push_back(method);
    DtLine& line = lines[{backend, method, row.problem_variant()}];
    line.backend = row.backend;
    line.method = method;
    line.variant = problem.variant.empty() ? row.problem_variant() : "";
    line.series.colour = backend;
    line.series.pattern = pattern->second;
    line.series.hover = fmt::format("{}, {}", row.backend, method);
    line.series.points.push_back(point_of(context, sample, metric, *cost, *error));
    line.points.push_back({row.dt.value_or(0), error->value});
    figure.rows.insert(figure.rows.end(), sample.rows.begin(), sample.rows.end());
  }
  for (auto& [key, line] : lines) {
    std::vector<std::size_t> order(line.points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return line.series.points[a].x < line.series.points[b].x; });
    DtLine sorted = line;
    for (std::size_t i = 0; i < order.size(); ++i) {
      sorted.series.points[i] = std::move(line.series.points[order[i]]);
      sorted.points[i] = line.points[order[i]];
    }
    add_order(context, sorted, patterns.size() < 2, figure);
    figure.plot.series.push_back(std::move(sorted.series));
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
  const std::string orders =
      figure.orders.empty()
          ? ""
          : R"(<p class="frame-note">Order in dt, with its 95 % interval:</p><ul class="frame-list">)" + figure.orders +
                "</ul>";
  return fmt::format(R"(<figure {}><figcaption>{}</figcaption>{}<div class="methods">{}</div>{}{}</figure>)",
                     filter_key(context, problem, figure.title), escape_html(figure.title), render_plot(figure.plot),
                     legend, orders, figure_foot(context, figure.rows, problem.title()));
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
  const auto add = [&](const Problem& problem, const std::string& metric, const std::string& title) {
    const Figure figure = make_figure(context, problem, metric, title);
    if (graded(figure)) out += render_figure(context, problem, figure);
  };
  if (swept) {
    for (const Problem* problem = first; problem != last; ++problem) {
      for (const std::string& metric : context.study.scored_metrics(*problem))
        add(*problem, metric, problem->title() + ", " + metric);
    }
    return out;
  }
  Problem all{first->scene, first->group, "", {}};
  for (const Problem* problem = first; problem != last; ++problem)
    all.rows.insert(all.rows.end(), problem->rows.begin(), problem->rows.end());
  for (const std::string& metric : context.study.scored_metrics(all)) add(all, metric, first->scene + ", " + metric);
  return out;
}

}  // namespace

std::string precision_section(const PageContext& context) {
  std::string out = section_start(context, "precision", "Work and precision") +
                    R"(<p class="about">Every run as a point: what a simulated )"
                    R"(second cost, and the error. )";
  if (!context.curves.problems.empty())
    out += R"(Runs with a knob turned are under <a href="#curves)" + context.suffix + R"(">Curves</a>. )";
  out +=
      R"(Lower left is better. Points are joined along the time step at equal settings; filled: the engine's )"
      R"(defaults; bars across: 95 % interval of the time over repetitions, bars upwards: smallest to largest error )"
      R"(over seeds; broken lines: the fitted order in dt, whose number stands below; an arrow: the error is zero, or )"
      R"(beyond the frame.</p><p class="legend">)";
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
