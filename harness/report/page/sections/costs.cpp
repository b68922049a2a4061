// Cost of accuracy: first how often each backend reaches an error at all, then every problem and metric.
#include <fmt/format.h>

#include <algorithm>

#include "base/format.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

/// " ±0.3" where the time has a band.
std::string band_text(const Reached& reached) {
  if (!reached.band) return "";
  const double half = std::max(*reached.ms - reached.band->low, reached.band->high - *reached.ms);
  return fmt::format(R"(<small title="95 % of the median: {} to {}"> &#177;{}</small>)",
                     short_number(reached.band->low), short_number(reached.band->high), short_number(half, 2));
}

/// Counts over all problems: what an engine reaches at all, and where it is the cheapest.
Table reach_table(const PageContext& context) {
  Table table("how often each engine reaches an error");
  table.column({"backend", 8, Column::Kind::name});
  table.column({"metrics", 4});
  for (const double target : target_errors) {
    table.column({fmt::format("reaches {} %", limit_text(100 * target)), 6});
    table.column({fmt::format("cheapest at {} %", limit_text(100 * target)), 5});
  }
  for (const BackendOverview& overview : context.overviews) {
    Json cells = Json::array({backend_label(context, overview.backend), std::to_string(overview.reach.front().tests)});
    for (const ReachCount& count : overview.reach) {
      const auto reached = static_cast<double>(count.reached);
      const double share = count.tests > 0 ? 100 * reached / static_cast<double>(count.tests) : 0;
      cells.push_back(
          cell(fmt::format(R"(<span class="share e{}" style="--share:{:.0f}%">{} <small>{:.0f} %</small></span>)",
                           context.backend_index(overview.backend), share, count.reached, share),
               reached));
      cells.push_back(
          count.compared == 0 && count.reached > 0
              ? cell(context.overviews.size() > 1 ? "not known" : std::string(no_value), {}, "quiet")
              : cell(std::to_string(count.cheapest) +
                         (count.compared < count.reached ? fmt::format(" <small>of {}</small>", count.compared) : ""),
                     static_cast<double>(count.cheapest)));
    }
    table.row(std::move(cells), "", context.backend_index(overview.backend));
  }
  return table;
}

std::string metric_label(const CostLine& line) {
  return fmt::format(R"(<b>{}</b> <span class="variant">{}</span> <span class="metric">{}</span>)",
                     escape_html(line.problem->scene), escape_html(line.problem->variant), escape_html(line.metric));
}

/// Why nothing was reached.
std::string why_nothing(const PageContext& context, const CostLine& line) {
  const Row& row = *line.representative;
  const std::string missed = Questions(context.ordered.scored_metrics(*line.problem), *line.problem).missed_by(row);
  const std::string why = !row.completed()  ? row.reason
                          : !missed.empty() ? "missed " + missed + ", so that its errors mean little"
                                            : "not finite or not measured";
  return fmt::format(R"(<span class="chip {}">{}</span> {})", verdict_word(row.verdict()),
                     row_link(row, verdict_title(row.verdict())), escape_html(why));
}

std::string configured(const PageContext& context, const Reached& reached) {
  return fmt::format(R"(<span class="cfg">{}</span>)", escape_html(context.ordered.configuration(*reached.row)));
}

std::string ms_cell(const Reached& reached) {
  if (!reached.ms) return "not timed";
  return (reached.untimed > 0 ? "\u2264 " : "") + short_number(*reached.ms);
}

std::string price_text(const Reached& reached) {
  return reached.ms ? fmt::format("at {} ms", ms_cell(reached)) : ms_cell(reached);
}

Json line_cells(const PageContext& context, const CostTest& test, const CostLine& line) {
  Json cells = Json::array({metric_label(line), backend_label(context, line.backend)});
  if (!line.floor) {
    for (std::size_t t = 0; t < target_errors.size(); ++t) cells.push_back(cell(std::string(no_value), {}, "quiet"));
    cells.push_back(cell(why_nothing(context, line), {}, "why"));
    return cells;
  }
  for (std::size_t t = 0; t < target_errors.size(); ++t) {
    const std::optional<Reached>& at = line.at[t] ? line.at[t] : line.failing[t];
    cells.push_back(
        !at ? cell("never", {}, "quiet")
            : cell(row_link(*at->row, ms_cell(*at)) + failed_mark(*at->row) + band_text(*at) + configured(context, *at),
                   at->ms, test.is_cheapest(line, t) ? "best" : ""));
  }
  cells.push_back(
      cell(fmt::format("{}{} <small>{}</small>{}", row_link(*line.floor->row, short_number(line.floor->error, 2)),
                       failed_mark(*line.floor->row), price_text(*line.floor), configured(context, *line.floor)),
           line.floor->error));
  return cells;
}

Table group_table(const PageContext& context, const std::string& group) {
  Table table("what accuracy costs: " + group_title(group));
  table.column({"scene, metric", 9, Column::Kind::name, {}, true});
  table.column({"backend", 6.5, Column::Kind::name});
  for (const double target : target_errors) table.column({fmt::format("ms for {} %", limit_text(100 * target)), 8});
  table.column({"best error reached", 10});
  for (const CostTest& test : tests_of(context.costs)) {
    if (test.lines.front().problem->group != group) continue;
    for (const CostLine& line : test.lines)
      table.row(line_cells(context, test, line), filter_key(context, *line.problem, line.metric + " " + line.backend),
                context.backend_index(line.backend));
  }
  return table;
}

}  // namespace

PageSection costs_section(const PageContext& context) {
  PageSection section{"cost", "What accuracy costs", ""};
  std::string words =
      R"(Wall-clock milliseconds per simulated )"
      R"(second of the cheapest configuration (time step, settings, threads, which stand below) among these results )"
      R"(that reaches the error and passes all thresholds of its scene. A dagger: only runs that miss one reach it, )"
      R"(which counts nowhere. <b>Never</b>: none does. The cheapest engine of a metric is set off; the last )"
      R"(column is the smallest error reached, and what it costs. A run that missed one of its scene's yes/no )"
      R"(questions (a tower that fell) has reached nothing.)";
  const auto contended = std::count_if(context.ordered.rows.begin(), context.ordered.rows.end(),
                                       [](const Row& row) { return row.time.contended.has_value(); });
  if (contended > 0) {
    words += fmt::format(
        R"( <b>{} of {} runs</b> were measured while the machine had more to do than cores: their )"
        R"(errors count, and their times are left out here and in all diagrams. <b>Not timed</b>: no run that reaches )"
        R"(it has a time that counts. &#8804;: some of the runs that )"
        R"(reach it have no time that counts, and nobody is called the cheapest there.)",
        contended, context.ordered.rows.size());
  }
  section.words = about(words);
  section.blocks.push_back(reach_table(context).block());
  const bool few = context.costs.size() <= 60;
  for (const std::string& group : context.ordered.groups) {
    const auto lines = std::count_if(context.costs.begin(), context.costs.end(),
                                     [&](const CostLine& line) { return line.problem->group == group; });
    if (lines == 0) continue;
    section.blocks.push_back(group_block(group_title(group), fmt::format("{} lines", lines),
                                         few || group == context.ordered.groups.front(),
                                         Json::array({group_table(context, group).block()})));
  }
  return section;
}

}  // namespace plumb::harness
