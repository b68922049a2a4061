// Curves: error against cost as a knob is turned, a line a method and knob.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "report/format.hpp"
#include "report/order.hpp"
#include "report/page/markup.hpp"
#include "report/page/plot.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

constexpr double largest_error = 10;  ///< beyond that nothing is told apart: all of it is wrong

std::string knob_text(const ResultRow& row, const std::string& knob) {
  return knob.empty() ? "" : fmt::format(", {} {}", knob, value_text(row.settings.at(knob)));
}

class Figure {
 public:
  Figure(const PageContext& context, const ProblemCurves& curves, const Questions& questions, std::string metric)
      : context_(context), curves_(curves), questions_(questions), metric_(std::move(metric)) {
    plot_.description = fmt::format("{}, {}: error against cost along knobs", curves.problem->title(), metric_);
    plot_.x.title = "ms per simulated second";
    plot_.y.title = "error";
    plot_.y.highest = largest_error;
    for (const MethodCurves& method : curves.methods) {
      for (const Curve& curve : method.curves) add_line(method, curve);
    }
  }

  [[nodiscard]] std::string render() const {
    const std::string plot = render_plot(plot_);
    if (plot.empty()) return "";
    std::string knobs;
    for (std::size_t i = 0; i < std::min(knobs_.size(), plot_patterns); ++i)
      knobs += fmt::format("<span>{}{}</span>", render_pattern(i), escape_html(knobs_[i]));
    const std::string orders =
        orders_.empty()
            ? ""
            : R"(<p class="frame-note">Power of the knob with which the error goes, with its 95 % interval:</p>)"
              R"(<ul class="frame-list">)" +
                  orders_ + "</ul>";
    return fmt::format(R"(<figure {}><figcaption>{}</figcaption>{}<div class="methods">{}</div>{}{}</figure>)",
                       filter_key(context_, *curves_.problem, metric_), escape_html(title()), plot, knobs, orders,
                       figure_foot(context_, rows_, curves_.problem->title()));
  }

 private:
  [[nodiscard]] std::string title() const {
    const std::string& variant = curves_.problem->variant;
    return variant.empty() ? metric_ : variant + ", " + metric_;
  }

  std::size_t pattern_of(const std::string& knob) {
    const auto known = std::find(knobs_.begin(), knobs_.end(), knob);
    if (known != knobs_.end()) return static_cast<std::size_t>(known - knobs_.begin());
    knobs_.push_back(knob);
    return knobs_.size() - 1;
  }

  void add_line(const MethodCurves& method, const Curve& curve) {
    PlotSeries line;
    line.colour = context_.method_index(method.method);
    if (!curve.knob.empty()) line.pattern = pattern_of(curve.knob);
    const std::string& label = context_.curves.methods[method.method].label;
    line.hover = curve.knob.empty() ? label : label + " along " + curve.knob;
    std::vector<OrderPoint> turned;
    for (const ResultRow* row : curve.rows) {
      const MetricResult* metric = row->metric(metric_);
      if (!row->completed() || !metric || !row->ms_per_simulated_second()) continue;
      if (!metric->error && !metric->scored()) continue;
      line.points.push_back(point_of(label, curve.knob, *row, *metric));
      rows_.push_back(row);
      // What has failed has no accuracy to gain, and is no part of the slope.
      const bool counts = !curve.knob.empty() && metric->error && !line.points.back().failed;
      turned.push_back({counts ? row->settings.at(curve.knob).get<double>() : 0, metric->error.value_or(0)});
      if (plot_.levels.empty() && metric->threshold && *metric->threshold > 0)
        plot_.levels.emplace_back(*metric->threshold, "threshold " + limit_text(*metric->threshold));
    }
    if (const std::optional<Order> order = fit_order(turned)) add_order(*order, line, turned, label, curve.knob);
    plot_.series.push_back(std::move(line));
  }

  void add_order(const Order& order, PlotSeries& line, const std::vector<OrderPoint>& turned, const std::string& label,
                 const std::string& knob) {
    for (std::size_t i = 0; i < turned.size(); ++i) {
      if (turned[i].turned > 0) line.fit.emplace_back(line.points[i].x, order.at(turned[i].turned));
    }
    line.fit_hover = fmt::format("{}: error goes with {} to the power {}", label, knob, order_text(order));
    orders_ += fmt::format(R"(<li class="e{}">{}{} <small>{}</small> {}</li>)", line.colour,
                           render_marker(line.colour, true), escape_html(label), escape_html(knob), order_text(order));
  }

  [[nodiscard]] PlotPoint point_of(const std::string& label, const std::string& knob, const ResultRow& row,
                                   const MetricResult& metric) const {
    const std::string missed = questions_.missed_by(row);
    // What is not finite is drawn as what lies beyond the frame, and not left out.
    const double error = metric.error.value_or(std::numeric_limits<double>::max());
    PlotPoint point{*row.ms_per_simulated_second(), error, {}, {}, false, {}, {}};
    point.filled = knob.empty() || at_default(row, knob);
    point.marked = context_.study.is_default(row);
    point.failed = !missed.empty();
    point.link = fmt::format("#r{}", row.index);
    if (row.ci95) {
      point.x_low = row.ci95->low / *row.dt;
      point.x_high = row.ci95->high / *row.dt;
    }
    point.hover = fmt::format("{}{}\n{} {}\n{} ms per simulated second", label, knob_text(row, knob), metric_,
                              metric.error ? short_number(*metric.error) : "not finite", short_number(point.x));
    if (point.marked) point.hover += fmt::format("\n{} as it ships", row.backend);
    if (point.failed) point.hover += "\nfailed: " + missed;
    return point;
  }

  const PageContext& context_;
  const ProblemCurves& curves_;
  const Questions& questions_;
  std::string metric_;
  Plot plot_;
  std::vector<std::string> knobs_;      ///< by line pattern
  std::vector<const ResultRow*> rows_;  ///< that have a point
  std::string orders_;                  ///< list items
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
    for (const ResultRow* row : method.broken) {
      notes.add(fmt::format("No point of {} ({}): {}{}.", escape_html(context.curves.methods[method.method].label),
                            escape_html(context.study.configuration(*row)),
                            row_link(*row, verdict_title(row->verdict()), row_hover(context, *row)),
                            row->reason.empty() ? "" : ", " + escape_html(row->reason)),
                *curves.problem);
    }
  }
}

using ProblemIterator = std::vector<ProblemCurves>::const_iterator;

/// Consecutive problems of one scene.
std::string render_scene(const PageContext& context, ProblemIterator first, ProblemIterator last) {
  std::string figures;
  Notes notes;
  for (auto curves = first; curves != last; ++curves) {
    const Questions questions(context.study.scored_metrics(*curves->problem), *curves->problem);
    for (const std::string& metric : questions.graded())
      figures += Figure(context, *curves, questions, metric).render();
    add_notes(context, *curves, notes);
  }
  const std::string& scene = first->problem->scene;
  const auto text = context.options.scenes.find(scene);
  return fmt::format(
      R"(<details class="group" open><summary>{} <small>{}</small></summary>{}<div class="figures">{}</div></details>)",
      escape_html(scene), text == context.options.scenes.end() ? "" : escape_html(text->second.title),
      notes.render(static_cast<std::size_t>(last - first)), figures);
}

}  // namespace

std::string curves_section(const PageContext& context) {
  if (context.curves.problems.empty()) return "";
  std::string out =
      section_start(context, "curves", "Curves") +
      R"(<p class="about">What turning a knob costs and buys, scene by scene: a )"
      R"(line a method, its points along one setting of the role quality. Costs are of the settled second half of a )"
      R"(run; lower left is better. Filled: the knob at )"
      R"(the engine's own value; ringed: all settings there; a cross: the run missed one of the scene's yes/no )"
      R"(questions, so that its error means little; an arrow: the error is zero, beyond the frame or not finite.</p><p )"
      R"(class="legend">)";
  std::map<std::string, std::size_t> by_label;
  for (std::size_t i = 0; i < context.curves.methods.size(); ++i) by_label.emplace(context.curves.methods[i].label, i);
  for (const auto& [label, i] : by_label) {
    out += fmt::format(R"(<span class="e{0}">{1}{2}</span>)", context.method_index(i),
                       render_marker(context.method_index(i), true), escape_html(label));
  }
  out += "</p>";
  const std::vector<ProblemCurves>& problems = context.curves.problems;
  for (auto first = problems.begin(); first != problems.end();) {
    const auto last = std::find_if(first, problems.end(), [&](const ProblemCurves& curves) {
      return curves.problem->scene != first->problem->scene;
    });
    out += render_scene(context, first, last);
    first = last;
  }
  return out + "</section>";
}

}  // namespace plumb::harness
