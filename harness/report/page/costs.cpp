// Cost of accuracy: first how often each backend reaches an error at all, then every problem and metric.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

using LineRange = std::pair<std::vector<CostLine>::const_iterator, std::vector<CostLine>::const_iterator>;
using Cheapest = std::array<double, target_errors.size()>;

/// Lines of one problem and metric.
LineRange next_range(std::vector<CostLine>::const_iterator first, std::vector<CostLine>::const_iterator last) {
  return {first, std::find_if(first, last, [&](const CostLine& line) {
            return line.problem != first->problem || line.metric != first->metric;
          })};
}

/// " ±0.3" where the time has a band.
std::string band_text(const Reached& reached) {
  if (!reached.band) return "";
  const double half = std::max(reached.ms - reached.band->low, reached.band->high - reached.ms);
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
    table.column({"cheapest", 5});
  }
  for (const BackendOverview& overview : context.overviews) {
    Json cells = Json::array({backend_label(context, overview.backend), std::to_string(overview.cost_lines)});
    for (std::size_t t = 0; t < target_errors.size(); ++t) {
      const double share = overview.cost_lines > 0 ? 100.0 * overview.reached[t] / overview.cost_lines : 0;
      cells.push_back(cell(fmt::format(R"(<span class="share e{}" style="--share:{:.0f}%">{} <small>{:.0f} %</small></span>)",
                                       context.backend_index(overview.backend), share, overview.reached[t], share),
                           overview.reached[t]));
      cells.push_back(std::to_string(overview.cheapest[t]));
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
  const ResultRow& row = *line.representative;
  const std::string missed =
      Questions(context.study.scored_metrics(*line.problem), *line.problem).missed_by(row);
  const std::string why = !row.completed()  ? row.reason
                          : line.contended  ? "measured on a contended machine only: its times are left out"
                          : !missed.empty() ? "missed " + missed + ", so that its errors mean little"
                                            : "not finite or not measured";
  return fmt::format(R"(<span class="chip {}">{}</span> {})", verdict_word(row.verdict()),
                     row_link(row, verdict_title(row.verdict())), escape_html(why));
}

std::string configured(const PageContext& context, const Reached& reached) {
  return fmt::format(R"(<span class="cfg">{}</span>)", escape_html(context.study.configuration(*reached.row)));
}

Json line_cells(const PageContext& context, const CostLine& line, const Cheapest& cheapest) {
  Json cells = Json::array({metric_label(line), backend_label(context, line.backend)});
  if (!line.floor) {
    for (std::size_t t = 0; t < target_errors.size(); ++t) cells.push_back(cell(std::string(no_value), {}, "quiet"));
    cells.push_back(cell(why_nothing(context, line), {}, "why"));
    return cells;
  }
  for (std::size_t t = 0; t < target_errors.size(); ++t) {
    const std::optional<Reached>& at = line.at[t];
    cells.push_back(!at ? cell("never", {}, "quiet")
                        : cell(row_link(*at->row, short_number(at->ms)) + band_text(*at) + configured(context, *at), at->ms,
                               at->ms == cheapest[t] ? "best" : ""));
  }
  cells.push_back(cell(fmt::format("{} <small>at {} ms</small>{}",
                                   row_link(*line.floor->row, short_number(line.floor->error, 2)),
                                   short_number(line.floor->ms), configured(context, *line.floor)),
                       line.floor->error));
  return cells;
}

Table group_table(const PageContext& context, const std::string& group) {
  Table table("what accuracy costs: " + group_title(group));
  table.column({"scene, metric", 9, Column::Kind::name, {}, true});
  table.column({"backend", 6.5, Column::Kind::name});
  for (const double target : target_errors) table.column({fmt::format("{} %", limit_text(100 * target)), 8});
  table.column({"best error reached", 10});
  for (auto first = context.costs.begin(); first != context.costs.end();) {
    const auto [begin, end] = next_range(first, context.costs.end());
    first = end;
    if (begin->problem->group != group) continue;
    Cheapest cheapest;
    cheapest.fill(std::numeric_limits<double>::infinity());
    for (auto line = begin; line != end; ++line) {
      for (std::size_t t = 0; t < target_errors.size(); ++t) {
        if (line->at[t]) cheapest[t] = std::min(cheapest[t], line->at[t]->ms);
      }
    }
    // One backend alone is not the cheapest of anything.
    if (end - begin < 2) cheapest.fill(0);
    for (auto line = begin; line != end; ++line)
      table.row(line_cells(context, *line, cheapest),
                filter_key(context, *line->problem, line->metric + " " + line->backend),
                context.backend_index(line->backend));
  }
  return table;
}

}  // namespace

PageSection costs_section(const PageContext& context) {
  PageSection section{"cost", "What accuracy costs", ""};
  std::string words =
      R"(Wall-clock milliseconds per simulated )"
      R"(second of the cheapest configuration (time step, settings, threads, which stand below) among these results )"
      R"(that reaches the error. <b>Never</b>: none of them does. The cheapest engine of a metric is set off; the last )"
      R"(column is the smallest error reached, and what it costs. A run that missed one of its scene's yes/no )"
      R"(questions (a tower that fell) has reached nothing.)";
  const auto contended = std::count_if(context.study.rows.begin(), context.study.rows.end(),
                                       [](const ResultRow& row) { return row.contended.has_value(); });
  if (contended > 0) {
    words += fmt::format(R"( <b>{} of {} runs</b> were measured while the machine had more to do than cores: their )"
                         R"(errors count, and their times are left out here and in all diagrams.)",
                         contended, context.study.rows.size());
  }
  section.words = about(words);
  section.blocks.push_back(reach_table(context).block());
  const bool few = context.costs.size() <= 60;
  for (const std::string& group : context.study.groups) {
    const auto lines = std::count_if(context.costs.begin(), context.costs.end(),
                                     [&](const CostLine& line) { return line.problem->group == group; });
    if (lines == 0) continue;
    section.blocks.push_back(group_block(group_title(group), fmt::format("{} lines", lines),
                                         few || group == context.study.groups.front(),
                                         Json::array({group_table(context, group).block()})));
  }
  return section;
}

}  // namespace plumb::harness
