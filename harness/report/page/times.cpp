// Times side by side: each engine relative to the fastest, and where in a step the time goes.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

std::optional<double> fastest(const PageContext& context, const Problem& problem) {
  std::optional<double> best;
  for (const std::string& backend : context.study.backends) {
    const ResultRow* row = context.study.representative(problem, backend);
    if (row && row->completed() && row->fair_ms() && (!best || *row->fair_ms() < *best)) best = row->fair_ms();
  }
  return best && *best > 0 ? best : std::nullopt;
}

std::string time_cells(const PageContext& context, const ResultRow* row, std::size_t index, double best) {
  if (!row || !row->completed() || !row->fair_ms()) {
    const std::string why = !row                                 ? std::string(no_value)
                            : row->completed() && row->contended ? "contended"
                                                                 : verdict_title(row->verdict());
    const std::string link = row ? row_link(*row, why, row_hover(context, *row)) : why;
    return fmt::format(R"(<td class="e{0} none">{1}</td><td class="e{0}"></td>)", index, link);
  }
  const double ratio = *row->fair_ms() / best;
  return fmt::format(
      R"(<td class="e{0}" data-v="{1}">{2}{3}</td><td class="e{0}{4}" data-v="{5}">{6}</td>)", index, *row->fair_ms(),
      row_link(*row, short_number(*row->fair_ms()), row_hover(context, *row)),
      row->verdict() == Verdict::failed ? R"(<sup title="failed: a threshold is missed">&#8224;</sup>)" : "",
      ratio == 1 ? " best" : "", ratio, ratio_text(ratio));
}

std::string ratio_table(const PageContext& context) {
  std::string out =
      R"(<div class="scroll"><table class="numbers times sortable"><thead><tr><th scope="col" data-sort>scene</th>)"
      R"(<th scope="col" data-sort>bodies</th>)";
  for (const std::string& backend : context.study.backends) {
    const std::size_t index = context.backend_index(backend);
    out += fmt::format(
        R"(<th scope="col" class="e{0}" data-sort>{1} <small>ms</small></th><th scope="col" class="e{0}" data-sort )"
        R"(title="relative to the fastest">&times;</th>)",
        index, backend_label(context, backend));
  }
  out += "</tr></thead><tbody>";
  for (const Problem& problem : context.study.problems) {
    const std::optional<double> best = fastest(context, problem);
    if (!best) continue;
    std::optional<double> bodies;
    std::string cells;
    for (const std::string& backend : context.study.backends) {
      const ResultRow* row = context.study.representative(problem, backend);
      if (row && row->bodies) bodies = row->bodies;
      cells += time_cells(context, row, context.backend_index(backend), *best);
    }
    out += fmt::format(R"(<tr {}>{}<td data-v="{}">{}</td>{}</tr>)", filter_key(context, problem),
                       problem_header(context, problem), bodies.value_or(0),
                       bodies ? shortest_number(*bodies) : std::string(no_value), cells);
  }
  return out + "</tbody></table></div>";
}

/// Phases that any row has, in the order of a step.
std::vector<std::string> phases_of(const Study& study) {
  std::vector<std::string> names{"broad", "narrow", "islands", "solve", "integrate", "continuous", "output"};
  const std::size_t known = names.size();
  std::vector<bool> seen(known, false);
  for (const ResultRow& row : study.rows) {
    for (const auto& [name, ms] : row.phase_ms) {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end()) {
        names.push_back(name);
        seen.push_back(true);
      } else {
        seen[static_cast<std::size_t>(found - names.begin())] = true;
      }
    }
  }
  std::vector<std::string> used;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (seen[i]) used.push_back(names[i]);
  }
  return used;
}

std::string phase_row(const PageContext& context, const Problem& problem, const ResultRow& row,
                      const std::vector<std::string>& phases, double longest) {
  double sum = 0;
  for (const auto& [name, ms] : row.phase_ms) sum += std::max(ms, 0.0);
  const double total = std::max(sum, row.median_ms.value_or(sum));
  if (!(total > 0)) return "";
  std::string bar;
  const auto add = [&](const std::string& name, const std::string& style, double ms) {
    const double share = 100 * ms / total;
    bar += fmt::format(R"(<span class="{}" style="flex-basis:{:.2f}%" title="{}: {} ms, {:.0f} %"></span>)", style,
                       share, escape_html(name), short_number(ms), share);
  };
  for (std::size_t i = 0; i < phases.size(); ++i) {
    for (const auto& [name, ms] : row.phase_ms) {
      if (name == phases[i] && ms > 0) add(name, fmt::format("p{}", i % 8), ms);
    }
  }
  if (total - sum > 0.005 * total) add("not told", "rest", total - sum);
  return fmt::format(R"(<tr class="e{}" {}>{}<td class="name">{}</td><td>{}</td><td class="phases"><div class="bar" )"
                     R"(style="width:{:.1f}%">{}</div></td></tr>)",
                     context.backend_index(row.backend), filter_key(context, problem, row.backend),
                     problem_header(context, problem), backend_label(context, row.backend),
                     row_link(row, short_number(row.median_ms ? *row.median_ms : sum), row_hover(context, row)),
                     100 * std::max(0.02, total / longest), bar);
}

std::string phase_table(const PageContext& context) {
  const std::vector<std::string> phases = phases_of(context.study);
  if (phases.empty()) return "";
  std::string rows;
  for (const Problem& problem : context.study.problems) {
    double longest = 0;
    for (const std::string& backend : context.study.backends) {
      const ResultRow* row = context.study.representative(problem, backend);
      if (!row || !row->completed()) continue;
      double sum = 0;
      for (const auto& [name, ms] : row->phase_ms) sum += std::max(ms, 0.0);
      longest = std::max({longest, sum, row->fair_ms().value_or(0)});
    }
    for (const std::string& backend : context.study.backends) {
      const ResultRow* row = context.study.representative(problem, backend);
      if (row && row->completed() && !row->contended && !row->phase_ms.empty())
        rows += phase_row(context, problem, *row, phases, longest);
    }
  }
  std::string legend;
  for (std::size_t i = 0; i < phases.size(); ++i)
    legend += fmt::format(R"(<span><i class="p{}"></i>{}</span>)", i % 8, escape_html(phases[i]));
  legend += R"(<span><i class="rest"></i>not told by the engine</span>)";
  return fmt::format(
      R"(<details class="group"><summary>Time by phase <small>{}</small></summary><p class="legend">{}</p><div )"
      R"(class="scroll"><table class="numbers phase-table">)"
      R"(<thead><tr><th scope="col">scene</th><th scope="col" class="name">backend</th><th scope="col">ms per )"
      R"(step</th>)"
      R"(<th scope="col" class="text">share of the slowest engine's step</th></tr></thead><tbody>{}</tbody></table>)"
      R"(</div></details>)",
      "as each engine tells it", legend, rows);
}

}  // namespace

std::string times_section(const PageContext& context) {
  return section_start(context, "times", "Times side by side") +
         R"(<p class="about">Median milliseconds per step at each )"
         R"(engine's defaults, and how many times the fastest )"
         R"(engine's that is. A dagger marks a run that missed a threshold: its time bought a wrong answer.</p>)" +
         ratio_table(context) + phase_table(context) + "</section>";
}

}  // namespace plumb::harness
