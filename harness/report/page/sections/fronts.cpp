// Pareto fronts: what no other configuration of any engine beats, and by whom the rest is beaten.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/format.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

PlotSeries loose_series(const PageContext& context, const std::string& backend) {
  PlotSeries series{backend, context.backend_index(backend)};
  series.joined = false;
  return series;
}

Plot diagram(const PageContext& context, const Front& front) {
  Plot plot;
  plot.description = fmt::format("{}, {}: Pareto front", front.problem->title(), front.metric);
  plot.x.title = "ms per simulated second";
  plot.y = {front.metric + " error", true, std::nullopt, largest_error};
  std::map<std::size_t, PlotSeries> beaten, best;
  for (const Dominated& other : front.others) {
    const Row& row = other.point.sample.row();
    PlotSeries& series =
        beaten.try_emplace(context.backend_index(row.backend), loose_series(context, row.backend)).first->second;
    series.points.push_back({other.point.ms, other.point.error, &row});
  }
  PlotSeries stairs{"Pareto front"};
  stairs.stepped = true;
  stairs.quiet = true;
  for (const FrontPoint& point : front.best) {
    const Row& row = point.sample.row();
    stairs.points.push_back({point.ms, point.error});
    PlotSeries& series =
        best.try_emplace(context.backend_index(row.backend), loose_series(context, row.backend)).first->second;
    series.points.push_back({point.ms, point.error, &row, true, context.ordered.is_default(row)});
  }
  for (auto& [backend, series] : beaten) {
    series.quiet = true;
    series.name += ", beaten";
    plot.series.push_back(std::move(series));
  }
  plot.series.push_back(std::move(stairs));
  for (auto& [backend, series] : best) plot.series.push_back(std::move(series));
  return plot;
}

/// Those on the front, cheapest first.
std::string front_table(const PageContext& context, const Front& front) {
  std::string rows;
  for (const FrontPoint& point : front.best) {
    const Row& row = point.sample.row();
    rows += fmt::format(R"(<tr class="of{}"><td>{}</td><td class="quiet">{}</td><td class="number">{} ms</td>)"
                        R"(<td class="number">{}</td></tr>)",
                        context.backend_index(row.backend), backend_label(context, row.backend),
                        escape_html(context.ordered.configuration(row)), row_link(row, short_number(point.ms)),
                        short_number(point.error, 2));
  }
  return fmt::format(R"(<table class="inner"><tbody>{}</tbody></table>)", rows);
}

Json figure(const PageContext& context, const Front& front) {
  FigureData figure;
  figure.title = front.problem->title() + ", " + front.metric;
  figure.key = filter_key(context, *front.problem, front.metric);
  figure.legend = false;
  figure.plots = {diagram(context, front)};
  std::vector<const Row*> rows;
  for (const FrontPoint& point : front.best)
    rows.insert(rows.end(), point.sample.rows.begin(), point.sample.rows.end());
  figure.notes = front_table(context, front) + figure_foot(context, rows, front.problem->title());
  for (const Dominated& other : front.others) {
    const FrontPoint& by = front.best[other.by];
    figure.beaten.push_back(
        {other.point.sample.row().origin.index, by.sample.row().origin.index, ratio_text(other.point.ms / by.ms)});
  }
  return figure_data(figure);
}

/// On how many fronts each engine stands, and how many it holds alone.
Table counts_table(const PageContext& context) {
  Table table("on how many fronts each engine stands");
  table.column({"backend", 8, Column::Kind::name});
  for (const char* title : {"fronts it has a passing run for", "is on", "holds alone", "has the cheapest point of",
                            "has the most exact point of"})
    table.column({title, 6});
  for (const std::string& backend : context.ordered.backends) {
    const FrontCount count = count_fronts(context.fronts, backend);
    Json cells = Json::array({backend_label(context, backend)});
    for (const std::size_t number : {count.ran, count.on, count.alone, count.cheapest, count.most_exact})
      cells.push_back(std::to_string(number));
    table.row(std::move(cells), "", context.backend_index(backend));
  }
  return table;
}

}  // namespace

PageSection fronts_section(const PageContext& context) {
  PageSection section{"fronts", "Pareto fronts", ""};
  std::vector<const Front*> fronts;
  for (const Front& front : context.fronts) {
    if (says_something(front)) fronts.push_back(&front);
  }
  const auto untimed =
      std::count_if(context.fronts.begin(), context.fronts.end(), [](const Front& front) { return front.untimed > 0; });
  if (fronts.empty()) return section;
  section.words = about(
      R"(Over all engines and settings: a configuration is )"
      R"(on the front of a scene and metric when no other is at least as cheap and as exact. Whoever uses anything )"
      R"(off the line pays more for the same error, or gets more error for the same price. Specks: the beaten ones, )"
      R"(which the list under each diagram names with the front's cheapest that is as exact; ringed: an engine as it )"
      R"(ships. Only runs that pass all thresholds of their scene are in the race.)" +
      (untimed == 0 ? ""
                    : fmt::format(" {} fronts are left out: runs in their race were measured while the machine had "
                                  "other work, and have no time that counts.",
                                  untimed)));
  section.blocks.push_back(counts_table(context).block());
  for (const std::string& group : context.ordered.groups) {
    Json figures = Json::array();
    for (const Front* front : fronts) {
      if (front->problem->group != group) continue;
      if (Json drawn = figure(context, *front); !drawn.is_null()) figures.push_back(std::move(drawn));
    }
    if (figures.empty()) continue;
    const std::string count = fmt::format("{} {}", figures.size(), figures.size() == 1 ? "front" : "fronts");
    section.blocks.push_back(group_block(group_title(group), count, figures.size() <= open_figures,
                                         Json::array({figures_block(std::move(figures))})));
  }
  return section;
}

}  // namespace plumb::harness
