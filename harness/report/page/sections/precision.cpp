// Work-precision diagrams: what each run cost against how wrong it was.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/format.hpp"
#include "report/ordered/order.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

/// All that must be equal for points to be joined along dt; "" for default settings.
std::string method_of(const OrderedRows& ordered, const Row& row) {
  std::string out = row.profile == "default" ? "" : row.profile;
  for (const auto& [name, value] : ordered.changed_settings(row)) out += (out.empty() ? "" : ", ") + name + " " + value;
  if (row.threads && *row.threads != 1)
    out += fmt::format("{}{} threads", out.empty() ? "" : ", ", shortest_number(*row.threads));
  return out;
}

PlotPoint point_of(const PageContext& context, const Row& row, const Measured& cost, const Measured& error) {
  PlotPoint point{cost.value, error.value, &row, context.ordered.is_default(row)};
  point.x_band = cost.band;
  if (error.band && std::isfinite(error.band->high)) point.y_band = error.band;
  return point;
}

/// A line over dt as it is made, with what its order is fitted to.
struct DtLine {
  PlotSeries series;
  std::vector<OrderPoint> points;
};

/// By cost, which stands for the time step that it was paid for.
void sort_by_cost(DtLine& line) {
  std::vector<std::size_t> order(line.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return line.series.points[a].x < line.series.points[b].x; });
  const DtLine unsorted = line;
  for (std::size_t i = 0; i < order.size(); ++i) {
    line.series.points[i] = unsorted.series.points[order[i]];
    line.points[i] = unsorted.points[order[i]];
  }
}

/// Of one metric over a problem, or over all variants of a scene: those stand unjoined beside each other.
class OrderFigure {
 public:
  OrderFigure(const PageContext& context, const Problem& problem, const std::string& metric, std::string title,
              bool joined)
      : context_(context), problem_(problem), title_(std::move(title)) {
    plot_.description = fmt::format("{}: error against cost of each backend", title_);
    plot_.x.title = "ms per simulated second";
    plot_.y = {metric + " error", true, std::nullopt, largest_error};
    const Questions questions(context.ordered.scored_metrics(problem), problem);
    std::map<std::pair<std::size_t, std::string>, DtLine> lines;  // backend, method
    for (const Sample& sample : samples_of(problem, "")) {
      const Row& row = sample.row();
      const std::optional<Measured> error = sample.error(metric), cost = sample.cost();
      if (!error || !cost || context.curves.is_turned(row)) continue;
      const std::size_t backend = context.backend_index(row.backend);
      const std::string method = method_of(context.ordered, row);
      DtLine& line = lines[{backend, method}];
      line.series.name = method.empty() ? row.backend : fmt::format("{}, {}", row.backend, method);
      line.series.engine = backend;
      line.series.method = method;
      line.series.joined = joined;
      line.series.points.push_back(point_of(context, row, *cost, *error));
      // What fell down has no accuracy to gain, and is no part of the slope.
      const bool counts = questions.counts(sample, metric);
      if (!counts) line.series.points.back().failed = questions.missed_by(row);
      line.points.push_back({counts ? row.dt.value_or(0) : 0, error->value});
      rows_.insert(rows_.end(), sample.rows.begin(), sample.rows.end());
    }
    for (auto& [key, line] : lines) {
      sort_by_cost(line);
      if (joined) add_order(line, key.second, context.backends[key.first]);
      plot_.slopes = plot_.slopes || (joined && line.points.size() > 1);
      plot_.series.push_back(std::move(line.series));
    }
  }

  /// Yes/no questions have errors of 0 and 1 only: nothing to draw.
  [[nodiscard]] bool graded() const {
    for (const PlotSeries& series : plot_.series) {
      for (const PlotPoint& point : series.points) {
        if (point.y != 0 && point.y != 1) return true;
      }
    }
    return false;
  }

  [[nodiscard]] Json data() const {
    FigureData figure;
    figure.title = title_;
    figure.key = filter_key(context_, problem_, title_);
    figure.plots = {plot_};
    if (!orders_.empty()) {
      figure.notes = fmt::format(
          R"(<p class="frame-note">Order in dt, with its 95 % interval:</p><ul class="frame-list">{}</ul>)", orders_);
    }
    figure.notes += figure_foot(context_, rows_, problem_.title());
    return figure_data(figure);
  }

 private:
  void add_order(DtLine& line, const std::string& method, const std::string& backend) {
    const std::optional<Order> order = fit_order(line.points);
    if (!order) return;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      if (line.points[i].turned > 0)
        line.series.fit.emplace_back(line.series.points[i].x, order->at(line.points[i].turned));
    }
    orders_ += fmt::format("<li>{} {}{}</li>", backend_label(context_, backend), order_text(*order),
                           method.empty() ? "" : fmt::format(" <small>{}</small>", escape_html(method)));
  }

  const PageContext& context_;
  const Problem& problem_;
  std::string title_;
  Plot plot_;
  std::vector<const Row*> rows_;  ///< that have a point
  std::string orders_;            ///< list items
};

/// Consecutive problems of one scene.
void add_scene_figures(const PageContext& context, const Problem* first, const Problem* last, Json& figures) {
  // With a sweep each variant has a diagram; without, a point each of all variants shares one.
  const bool swept = std::any_of(first, last, [&](const Problem& problem) {
    std::map<std::string, int> cells;
    return std::any_of(problem.rows.begin(), problem.rows.end(),
                       [&](const Row* row) { return !context.curves.is_turned(*row) && ++cells[row->backend] > 1; });
  });
  const auto add = [&](const Problem& problem, const std::string& metric, const std::string& title) {
    const OrderFigure figure(context, problem, metric, title, swept || last - first == 1);
    if (!figure.graded()) return;
    if (Json data = figure.data(); !data.is_null()) figures.push_back(std::move(data));
  };
  if (swept) {
    for (const Problem* problem = first; problem != last; ++problem) {
      for (const std::string& metric : context.ordered.scored_metrics(*problem))
        add(*problem, metric, problem->title() + ", " + metric);
    }
    return;
  }
  Problem all{first->scene, first->group, "", {}};
  for (const Problem* problem = first; problem != last; ++problem)
    all.rows.insert(all.rows.end(), problem->rows.begin(), problem->rows.end());
  for (const std::string& metric : context.ordered.scored_metrics(all)) add(all, metric, first->scene + ", " + metric);
}

}  // namespace

PageSection precision_section(const PageContext& context) {
  PageSection section{"precision", "Work and precision", ""};
  std::string words = "Every run as a point: what a simulated second cost, and the error: a share, without a unit. ";
  if (!context.curves.problems.empty())
    words += R"(Runs with a knob turned are under <a href="#curves)" + context.suffix + R"(">Curves</a>. )";
  words +=
      R"(Lower left is better. Points are joined along the time step at equal settings; filled: the engine's )"
      R"(defaults; bars across: 95 % interval of the time over repetitions, bars upwards: smallest to largest error )"
      R"(over seeds; thin broken lines: the fitted order in dt, whose number stands below; an arrow: the error is zero, )"
      R"(or beyond the frame.)";
  section.words = about(words +
                        " A cross: the run missed one of the scene's yes/no questions, so that its error means "
                        "little." +
                        untimed_note(context));
  const std::vector<Problem>& problems = context.ordered.problems;
  for (const std::string& group : context.ordered.groups) {
    Json figures = Json::array();
    for (std::size_t i = 0; i < problems.size();) {
      std::size_t end = i;
      while (end < problems.size() && problems[end].scene == problems[i].scene &&
             problems[end].group == problems[i].group)
        ++end;
      if (problems[i].group == group) add_scene_figures(context, &problems[i], &problems[i] + (end - i), figures);
      i = end;
    }
    if (figures.empty()) continue;
    const std::string count = fmt::format("{} {}", figures.size(), figures.size() == 1 ? "diagram" : "diagrams");
    section.blocks.push_back(group_block(group_title(group), count, figures.size() <= open_figures,
                                         Json::array({figures_block(std::move(figures))})));
  }
  if (section.blocks.empty()) section.words += about("No metric has an error and a time to draw.");
  return section;
}

}  // namespace plumb::harness
