// Curves: error against cost as a knob is turned, a line a method and knob.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "base/format.hpp"
#include "report/ordered/order.hpp"
#include "report/page/parts/looks.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

/// Places of methods among those of their family of engines, which share a hue: by them a method has its shape. The
/// first are kept for engines without a choice of method, which look as they do everywhere.
std::vector<std::size_t> ranks_of(const std::vector<Method>& methods) {
  std::map<std::string_view, std::size_t> chosen;
  std::vector<std::size_t> ranks;
  for (const Method& method : methods) {
    ranks.push_back(method.label == method.backend ? look_of(method.backend).shade
                                                   : page_shades + chosen[engine_family(method.backend)]++);
  }
  return ranks;
}

class Figure {
 public:
  Figure(const PageContext& context, const std::vector<std::size_t>& ranks, const ProblemCurves& curves,
         const Questions& questions, std::string metric)
      : context_(context), ranks_(ranks), curves_(curves), questions_(questions), metric_(std::move(metric)) {
    plot_.description = fmt::format("{}, {}: error against cost along knobs", curves.problem->title(), metric_);
    plot_.x.title = "ms per simulated second";
    plot_.y = {metric_ + " error", true, std::nullopt, largest_error};
    for (const MethodCurves& method : curves.methods) {
      for (const Curve& curve : method.curves) add_line(method, curve);
    }
  }

  /// null where there is nothing to draw.
  [[nodiscard]] Json data() const {
    FigureData figure;
    const std::string& variant = curves_.problem->variant;
    figure.title = variant.empty() ? metric_ : variant + ", " + metric_;
    figure.key = filter_key(context_, *curves_.problem, metric_);
    figure.plots = {plot_};
    if (!orders_.empty()) {
      figure.notes = fmt::format(
          R"(<details class="how"><summary>power of the knob with which the error goes, with its 95 % interval</summary>)"
          R"(<ul>{}</ul></details>)",
          orders_);
    }
    figure.notes += figure_foot(context_, rows_, curves_.problem->title());
    return figure_data(figure);
  }

 private:
  void add_line(const MethodCurves& method, const Curve& curve) {
    const Method& of = context_.curves.methods[method.method];
    PlotSeries line{curve.knob.empty() ? of.label : of.label + " along " + curve.knob,
                    context_.backend_index(of.backend)};
    line.method = of.label;
    line.rank = ranks_[method.method];
    line.line = curve.knob;
    std::vector<OrderPoint> turned;
    for (const Row* row : curve.rows) {
      const MetricResult* metric = row->metric(metric_);
      if (!row->completed() || !metric || !row->ms_per_simulated_second()) continue;
      if (!metric->error && !metric->scored()) continue;
      line.points.push_back(point_of(curve.knob, *row, *metric));
      rows_.push_back(row);
      // What has failed has no accuracy to gain, and is no part of the slope.
      const bool counts = !curve.knob.empty() && metric->error && line.points.back().failed.empty();
      turned.push_back({counts ? row->settings.at(curve.knob).get<double>() : 0, metric->error.value_or(0)});
      if (plot_.levels.empty() && metric->threshold && *metric->threshold > 0)
        plot_.levels.emplace_back(*metric->threshold, "threshold " + limit_text(*metric->threshold));
    }
    if (const std::optional<Order> order = fit_order(turned)) {
      for (std::size_t i = 0; i < turned.size(); ++i) {
        if (turned[i].turned > 0) line.fit.emplace_back(line.points[i].x, order->at(turned[i].turned));
      }
      orders_ += fmt::format("<li>{} <small>{}</small> {}</li>", escape_html(of.label), escape_html(curve.knob),
                             order_text(*order));
    }
    plot_.series.push_back(std::move(line));
  }

  [[nodiscard]] PlotPoint point_of(const std::string& knob, const Row& row, const MetricResult& metric) const {
    // What is not finite is drawn as what lies beyond the frame, and not left out.
    PlotPoint point{*row.ms_per_simulated_second(), metric.error.value_or(std::numeric_limits<double>::infinity()),
                    &row};
    point.filled = knob.empty() || at_default(row, knob);
    point.marked = context_.ordered.is_default(row);
    point.failed = questions_.missed_by(row);
    if (row.time.ci95) point.x_band = Interval{row.time.ci95->low / *row.dt, row.time.ci95->high / *row.dt};
    return point;
  }

  const PageContext& context_;
  const std::vector<std::size_t>& ranks_;
  const ProblemCurves& curves_;
  const Questions& questions_;
  std::string metric_;
  Plot plot_;
  std::vector<const Row*> rows_;  ///< that have a point
  std::string orders_;            ///< list items
};

/// What diagrams cannot show, said once for all variants of a scene that it holds for.
class Notes {
 public:
  void add(const std::string& html, const Problem& problem) {
    const auto known = std::find_if(notes_.begin(), notes_.end(), [&](const auto& n) { return n.first == html; });
    if (known == notes_.end()) {
      notes_.push_back({html, {problem.variant}});
    } else {
      known->second.push_back(problem.variant);
    }
  }
  /// problems: of the scene, all of which need not be named.
  [[nodiscard]] std::string render(std::size_t problems) const {
    std::string out;
    for (const auto& [html, variants] : notes_) {
      const bool all = variants.size() == problems;
      out += fmt::format(R"(<p class="figure-note">{}{}</p>)",
                         all ? "" : escape_html(fmt::format("{}: ", fmt::join(variants, "; "))), html);
    }
    return out;
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> notes_;
};

/// Knobs that do nothing, and cells that did not come through.
void add_notes(const PageContext& context, const ProblemCurves& curves, Notes& notes) {
  std::map<std::string, std::string> idle;  // methods by knob
  for (const MethodCurves& method : curves.methods) {
    const std::string& label = context.curves.methods[method.method].label;
    for (const std::string& knob : method.idle) idle[knob] += (idle[knob].empty() ? "" : "; ") + label;
  }
  for (const auto& [knob, methods] : idle)
    notes.add(fmt::format("{} changes nothing with {}.", escape_html(knob), escape_html(methods)), *curves.problem);
  for (const MethodCurves& method : curves.methods) {
    for (const Row* row : method.broken) {
      notes.add(
          fmt::format("No point of {} ({}): {}{}.", escape_html(context.curves.methods[method.method].label),
                      escape_html(context.ordered.configuration(*row)), row_link(*row, verdict_title(row->verdict())),
                      row->reason.empty() ? "" : ", " + escape_html(row->reason)),
          *curves.problem);
    }
  }
}

using ProblemIterator = std::vector<ProblemCurves>::const_iterator;

/// Consecutive problems of one scene.
Json scene_block(const PageContext& context, const std::vector<std::size_t>& ranks, bool open, ProblemIterator first,
                 ProblemIterator last) {
  Json figures = Json::array();
  Notes notes;
  for (auto curves = first; curves != last; ++curves) {
    const Questions questions(context.ordered.scored_metrics(*curves->problem), *curves->problem);
    for (const std::string& metric : questions.graded()) {
      if (Json figure = Figure(context, ranks, *curves, questions, metric).data(); !figure.is_null())
        figures.push_back(std::move(figure));
    }
    add_notes(context, *curves, notes);
  }
  const std::string& scene = first->problem->scene;
  const auto text = context.options.scenes.find(scene);
  Json blocks = Json::array();
  if (const std::string said = notes.render(static_cast<std::size_t>(last - first)); !said.empty())
    blocks.push_back(words_block(said));
  if (!figures.empty()) blocks.push_back(figures_block(std::move(figures)));
  return group_block(scene, text == context.options.scenes.end() ? "" : text->second.title, open, std::move(blocks));
}

}  // namespace

PageSection curves_section(const PageContext& context) {
  PageSection section{"curves", "Curves", ""};
  if (context.curves.problems.empty()) return section;
  section.words = about(
      R"(What turning a knob costs and buys, scene by scene: a )"
      R"(line a method, its points along one setting of the role quality. Costs are of the settled second half of a )"
      R"(run; lower left is better. The hue is the engine's, the shape the method's, the dashes are the knob's. Filled: )"
      R"(the knob at the engine's own value; ringed: all settings there; a cross: the run missed one of the scene's )"
      R"(yes/no questions, so that its error means little; an arrow: the error is zero, beyond the frame or not finite.)" +
      untimed_note(context));
  const std::vector<std::size_t> ranks = ranks_of(context.curves.methods);
  const std::vector<ProblemCurves>& problems = context.curves.problems;
  for (auto first = problems.begin(); first != problems.end();) {
    const auto last = std::find_if(first, problems.end(), [&](const ProblemCurves& curves) {
      return curves.problem->scene != first->problem->scene;
    });
    section.blocks.push_back(scene_block(context, ranks, first == problems.begin(), first, last));
    first = last;
  }
  return section;
}

}  // namespace plumb::harness
