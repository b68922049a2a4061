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

std::string reached_hover(const PageContext& context, const Reached& reached, const std::string& metric) {
  return fmt::format("{}: error {} at {} ms per simulated second\n{}", metric, short_number(reached.error),
                     short_number(reached.ms), context.study.configuration(*reached.row));
}

/// Counts over all problems: what an engine reaches at all, and where it is the cheapest.
std::string reach_table(const PageContext& context) {
  std::string out =
      R"(<div class="scroll"><table class="numbers reach"><thead><tr><th scope="col">backend</th><th scope="col">)"
      R"(metrics</th>)";
  for (const double target : target_errors)
    out += fmt::format(R"(<th scope="col">reaches {} %</th><th scope="col">cheapest</th>)", limit_text(100 * target));
  out += "</tr></thead><tbody>";
  for (const BackendOverview& overview : context.overviews) {
    out += fmt::format(R"(<tr class="e{}"><th scope="row">{}</th><td>{}</td>)", context.backend_index(overview.backend),
                       backend_label(context, overview.backend), overview.cost_lines);
    for (std::size_t t = 0; t < target_errors.size(); ++t) {
      const double share = overview.cost_lines > 0 ? 100.0 * overview.reached[t] / overview.cost_lines : 0;
      out += fmt::format(R"(<td class="share" style="--share:{:.0f}%">{} <small>{:.0f} %</small></td><td>{}</td>)",
                         share, overview.reached[t], share, overview.cheapest[t]);
    }
    out += "</tr>";
  }
  return out + "</tbody></table></div>";
}

/// The cell that names problem and metric, beside all lines of it. The script moves it to the first line that is shown.
std::string label_cell(const CostLine& line, std::ptrdiff_t lines) {
  return fmt::format(
      R"(<th scope="row" class="label" rowspan="{}"><b>{}</b> <span class="variant">{}</span> <span class="metric">)"
      R"({}</span></th>)",
      lines, escape_html(line.problem->scene), escape_html(line.problem->variant), escape_html(line.metric));
}

std::string line_row(const PageContext& context, const CostLine& line, const std::string& label,
                     const std::array<double, target_errors.size()>& cheapest) {
  std::string out = fmt::format(R"(<tr class="e{}">{})", context.backend_index(line.backend), label);
  out += fmt::format("<td class=\"name\">{}</td>", backend_label(context, line.backend));
  if (!line.floor) {
    const Verdict verdict = line.representative->verdict();
    const bool ran = line.representative->completed();
    const std::string missed =
        Questions(context.study.scored_metrics(*line.problem), *line.problem).missed_by(*line.representative);
    const std::string why = !ran              ? line.representative->reason
                            : line.contended  ? "measured on a contended machine only: its times are left out"
                            : !missed.empty() ? "missed " + missed + ", so that its errors mean little"
                                              : "not finite or not measured";
    return out +
           fmt::format(R"(<td colspan="4" class="none"><span class="chip {}">{}</span> {}</td></tr>)",
                       verdict_word(verdict),
                       row_link(*line.representative, verdict_title(verdict), row_hover(context, *line.representative)),
                       escape_html(why));
  }
  for (std::size_t t = 0; t < target_errors.size(); ++t) {
    if (!line.at[t]) {
      out += R"(<td class="never">never</td>)";
      continue;
    }
    out += fmt::format(
        R"(<td{}>{}{}<span class="cfg">{}</span></td>)", line.at[t]->ms == cheapest[t] ? " class=\"best\"" : "",
        row_link(*line.at[t]->row, short_number(line.at[t]->ms), reached_hover(context, *line.at[t], line.metric)),
        band_text(*line.at[t]), escape_html(context.study.configuration(*line.at[t]->row)));
  }
  return out + fmt::format(R"(<td>{} <small>at {} ms</small><span class="cfg">{}</span></td></tr>)",
                           row_link(*line.floor->row, short_number(line.floor->error, 2),
                                    reached_hover(context, *line.floor, line.metric)),
                           short_number(line.floor->ms), escape_html(context.study.configuration(*line.floor->row)));
}

std::string group_table(const PageContext& context, const std::string& group) {
  std::string out =
      R"(<div class="scroll tall"><table class="numbers costs"><thead><tr><th scope="col">scene, metric</th><th )"
      R"(scope="col" class="name">backend</th>)";
  for (const double target : target_errors)
    out += fmt::format(R"(<th scope="col">{} %</th>)", limit_text(100 * target));
  out += R"(<th scope="col">best error reached</th></tr></thead>)";
  for (auto first = context.costs.begin(); first != context.costs.end();) {
    const auto [begin, end] = next_range(first, context.costs.end());
    first = end;
    if (begin->problem->group != group) continue;
    std::array<double, target_errors.size()> cheapest;
    cheapest.fill(std::numeric_limits<double>::infinity());
    for (auto line = begin; line != end; ++line) {
      for (std::size_t t = 0; t < target_errors.size(); ++t) {
        if (line->at[t]) cheapest[t] = std::min(cheapest[t], line->at[t]->ms);
      }
    }
    // One backend alone is not the cheapest of anything.
    if (end - begin < 2) cheapest.fill(0);
    out += fmt::format("<tbody {}>", filter_key(context, *begin->problem, begin->metric));
    for (auto line = begin; line != end; ++line)
      out += line_row(context, *line, line == begin ? label_cell(*line, end - begin) : "", cheapest);
    out += "</tbody>";
  }
  return out + "</table></div>";
}

}  // namespace

std::string costs_section(const PageContext& context) {
  std::string out =
      section_start(context, "cost", "What accuracy costs") +
      R"(<p class="about">Wall-clock milliseconds per simulated )"
      R"(second of the cheapest configuration (time step, settings, threads, which stand below) among these results )"
      R"(that reaches the error. <b>Never</b>: none of them does. The cheapest engine of a metric is set off; the last )"
      R"(column is the smallest error reached, and what it costs. A run that missed one of its scene's yes/no )"
      R"(questions (a tower that fell) has reached nothing.)";
  const auto contended = std::count_if(context.study.rows.begin(), context.study.rows.end(),
                                       [](const ResultRow& row) { return row.contended.has_value(); });
  if (contended > 0) {
    out += fmt::format(R"( <b>{} of {} runs</b> were measured while the machine had more to do than cores: their )"
                       R"(errors count, and their times are left out here and in all diagrams.)",
                       contended, context.study.rows.size());
  }
  out += "</p>";
  out += reach_table(context);
  const bool few = context.costs.size() <= 60;
  for (const std::string& group : context.study.groups) {
    const auto lines = std::count_if(context.costs.begin(), context.costs.end(),
                                     [&](const CostLine& line) { return line.problem->group == group; });
    if (lines == 0) continue;
    out += fmt::format(R"(<details class="group"{}><summary>{} <small>{} lines</small></summary>)",
                       few || group == context.study.groups.front() ? " open" : "", escape_html(group_title(group)),
                       lines);
    out += group_table(context, group) + "</details>";
  }
  return out + "</section>";
}

}  // namespace plumb::harness
