// Pareto fronts: what no other configuration of any engine beats, and by whom the rest is beaten.
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

constexpr double largest_error = 10;      ///< beyond that nothing is told apart: all of it is wrong
constexpr std::size_t fewest_points = 3;  ///< of which a front says something

std::string hover(const PageContext& context, const FrontPoint& point, const std::string& metric) {
  const ResultRow& row = point.sample.row();
  return fmt::format("{}\n{}\n{} {}\n{} ms per simulated second", row.backend, context.study.configuration(row), metric,
                     short_number(point.error), short_number(point.ms));
}

std::string diagram(const PageContext& context, const Front& front) {
  Plot plot;
  plot.description = fmt::format("{}, {}: Pareto front", front.problem->title(), front.metric);
  plot.x.title = "ms per simulated second";
  plot.y.title = "error";
  plot.y.highest = largest_error;
  std::map<std::size_t, PlotSeries> specks;
  for (const Dominated& other : front.others) {
    PlotSeries& series = specks[context.backend_index(other.point.sample.row().backend)];
    series.points.push_back({other.point.ms, other.point.error, {}, {}, false, {}, {}});
  }
  for (auto& [backend, series] : specks) {
    series.colour = backend;
    series.joined = false;
    series.quiet = true;
    plot.series.push_back(std::move(series));
  }
  PlotSeries stairs;
  stairs.colour = no_colour;
  stairs.stepped = true;
  stairs.quiet = true;
  stairs.hover = "Pareto front";
  std::map<std::size_t, PlotSeries> best;
  for (const FrontPoint& point : front.best) {
    const ResultRow& row = point.sample.row();
    const std::size_t backend = context.backend_index(row.backend);
    stairs.points.push_back({point.ms, point.error, {}, {}, false, {}, {}});
    PlotSeries& series = best[backend];
    series.colour = backend;
    series.joined = false;
    PlotPoint drawn{
        point.ms, point.error, {}, {}, true, hover(context, point, front.metric), fmt::format("#r{}", row.index)};
    drawn.marked = context.study.is_default(row);
    series.points.push_back(std::move(drawn));
  }
  plot.series.push_back(std::move(stairs));
  for (auto& [backend, series] : best) plot.series.push_back(std::move(series));
  return render_plot(plot);
}

/// Those on the front, cheapest first.
std::string front_table(const PageContext& context, const Front& front) {
  std::string out = R"(<div class="inner"><table class="numbers front-table"><tbody>)";
  for (const FrontPoint& point : front.best) {
    const ResultRow& row = point.sample.row();
    out +=
        fmt::format(R"(<tr class="e{}"><td class="name">{}</td><td class="text">{}</td><td>{} ms</td><td>{}</td></tr>)",
                    context.backend_index(row.backend), backend_label(context, row.backend),
                    escape_html(context.study.configuration(row)), row_link(row, short_number(point.ms), ""),
                    short_number(point.error, 2));
  }
  return out + "</tbody></table></div>";
}

/// Row, the row that beats it, and how many times dearer it is: the script makes the list from them when it is opened.
std::string dominated_list(const Front& front) {
  if (front.others.empty()) return "";
  std::string data;
  for (const Dominated& other : front.others) {
    const FrontPoint& by = front.best[other.by];
    data += fmt::format("{}{},{},{}", data.empty() ? "" : ";", other.point.sample.row().index, by.sample.row().index,
                        short_number(other.point.ms / by.ms));
  }
  return fmt::format(
      R"(<details class="how beaten" data-beaten="{}"><summary>{} beaten, and by whom</summary></details>)", data,
      front.others.size());
}

std::string figure(const PageContext& context, const Front& front) {
  const std::string plot = diagram(context, front);
  if (plot.empty()) return "";
  std::vector<const ResultRow*> rows;
  for (const FrontPoint& point : front.best)
    rows.insert(rows.end(), point.sample.rows.begin(), point.sample.rows.end());
  const std::string title = front.problem->title() + ", " + front.metric;
  return fmt::format(R"(<figure {}><figcaption>{}</figcaption>{}{}{}{}</figure>)",
                     filter_key(context, *front.problem, front.metric), escape_html(title), plot,
                     front_table(context, front), dominated_list(front),
                     figure_foot(context, rows, front.problem->title()));
}

/// On how many fronts each engine stands, and how many it holds alone.
std::string counts_table(const PageContext& context, const std::vector<const Front*>& fronts) {
  std::string rows;
  for (const std::string& backend : context.study.backends) {
    std::size_t ran = 0, on = 0, alone = 0, cheapest = 0, exact = 0;
    for (const Front* front : fronts) {
      const auto is_of = [&](const FrontPoint& point) { return point.sample.row().backend == backend; };
      const bool present = std::any_of(front->best.begin(), front->best.end(), is_of);
      ran += present || std::any_of(front->others.begin(), front->others.end(),
                                    [&](const Dominated& other) { return is_of(other.point); });
      on += present;
      alone += std::all_of(front->best.begin(), front->best.end(), is_of);
      cheapest += is_of(front->best.front());
      exact += is_of(front->best.back());
    }
    rows += fmt::format(
        R"(<tr class="e{}"><th scope="row">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>)",
        context.backend_index(backend), backend_label(context, backend), ran, on, alone, cheapest, exact);
  }
  return R"(<div class="scroll"><table class="numbers reach"><thead><tr><th scope="col">backend</th><th scope="col">)"
         R"(fronts it ran for</th><th scope="col">is on</th><th scope="col">holds alone</th><th scope="col">has the )"
         R"(cheapest point of</th><th scope="col">has the most exact point of</th></tr></thead><tbody>)" +
         rows + "</tbody></table></div>";
}

}  // namespace

std::string fronts_section(const PageContext& context) {
  std::vector<const Front*> fronts;
  for (const Front& front : context.fronts) {
    if (front.best.size() + front.others.size() >= fewest_points) fronts.push_back(&front);
  }
  if (fronts.empty()) return "";
  std::string out =
      section_start(context, "fronts", "Pareto fronts") +
      R"(<p class="about">Over all engines and settings: a configuration is )"
      R"(on the front of a scene and metric when no other is at least as cheap and as exact. Whoever uses anything )"
      R"(off the line pays more for the same error, or gets more error for the same price. Specks: the beaten ones, )"
      R"(which the list under each diagram names with the front's cheapest that is as exact; ringed: an engine as it )"
      R"(ships. Runs that missed a yes/no question are not in the race.</p>)";
  out += counts_table(context, fronts);
  bool any = false;
  for (const std::string& group : context.study.groups) {
    std::string figures;
    for (const Front* front : fronts) {
      if (front->problem->group == group) figures += figure(context, *front);
    }
    if (figures.empty()) continue;
    out += fmt::format(R"(<details class="group"{}><summary>{}</summary><div class="figures">{}</div></details>)",
                       any ? "" : " open", escape_html(group_title(group)), figures);
    any = true;
  }
  return out + "</section>";
}

}  // namespace plumb::harness
