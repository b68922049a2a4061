// Times side by side: each engine relative to the fastest, and where in a step the time goes.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/format.hpp"
#include "report/ordered/default_run.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

/// Of those that pass: a wrong answer is no faster way to the right one.
std::optional<double> fastest(const PageContext& context, const Problem& problem) {
  std::optional<double> best;
  for (const std::string& backend : context.ordered.backends) {
    const Row* row = default_run(context.ordered, problem, backend);
    if (row && row->passes() && row->fair_ms() && (!best || *row->fair_ms() < *best)) best = row->fair_ms();
  }
  return best && *best > 0 ? best : std::nullopt;
}

/// Time and ratio of an engine on a problem.
void add_time_cells(const Row* row, const std::optional<double>& best, Json& cells) {
  if (!row || !row->completed() || !row->fair_ms()) {
    const std::string why = !row                                      ? std::string(no_value)
                            : row->completed() && row->time.contended ? "contended"
                                                                      : verdict_title(row->verdict());
    cells.push_back(cell(row ? row_link(*row, why) : why, {}, "quiet"));
    cells.push_back("");
    return;
  }
  cells.push_back(cell(row_link(*row, short_number(*row->fair_ms())) + failed_mark(*row), *row->fair_ms()));
  if (!best) {
    cells.push_back(cell(std::string(no_value), {}, "quiet"));
    return;
  }
  const double ratio = *row->fair_ms() / *best;
  cells.push_back(cell(ratio_text(ratio), ratio, row->passes() && ratio == 1 ? "best" : ""));
}

Table ratio_table(const PageContext& context) {
  Table table("times side by side");
  table.column({"scene", 9, Column::Kind::name});
  table.column({"bodies", 4});
  for (const std::string& backend : context.ordered.backends) {
    const std::size_t engine = context.backend_index(backend);
    table.column({backend_label(context, backend) + " <small>ms</small>", 6, Column::Kind::number, engine});
    table.column(
        {"&times; fastest", 4, Column::Kind::number, engine, false, backend + ", relative to the fastest that passes"});
  }
  for (const Problem& problem : context.ordered.problems) {
    const std::optional<double> best = fastest(context, problem);
    std::optional<double> bodies;
    bool any = false;
    Json times = Json::array();
    for (const std::string& backend : context.ordered.backends) {
      const Row* row = default_run(context.ordered, problem, backend);
      if (row && row->counts.bodies) bodies = row->counts.bodies;
      any = any || (row && row->completed() && row->fair_ms());
      add_time_cells(row, best, times);
    }
    if (!any) continue;
    Json cells = Json::array(
        {problem_label(context, problem), cell(bodies ? shortest_number(*bodies) : std::string(no_value), bodies)});
    cells.insert(cells.end(), times.begin(), times.end());
    table.row(std::move(cells), filter_key(context, problem));
  }
  return table;
}

/// Phases that any row has, in the order of a step.
std::vector<std::string> phases_of(const OrderedRows& ordered) {
  std::vector<std::string> names{"broad", "narrow", "islands", "solve", "integrate", "continuous", "output"};
  const std::size_t known = names.size();
  std::vector<bool> seen(known, false);
  for (const Row& row : ordered.rows) {
    for (const auto& [name, ms] : row.time.phase_ms) {
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

/// The step of a row as a bar, as long as its share of the slowest engine's.
std::string phase_bar(const Row& row, const std::vector<std::string>& phases, double sum, double total,
                      double longest) {
  std::string bar;
  const auto add = [&](const std::string& name, const std::string& style, double ms) {
    const double share = 100 * ms / total;
    bar += fmt::format(R"(<span class="{}" style="flex-basis:{:.2f}%" title="{}: {} ms, {:.0f} %"></span>)", style,
                       share, escape_html(name), short_number(ms), share);
  };
  for (std::size_t i = 0; i < phases.size(); ++i) {
    for (const auto& [name, ms] : row.time.phase_ms) {
      if (name == phases[i] && ms > 0) add(name, fmt::format("p{}", i % 8), ms);
    }
  }
  if (total - sum > 0.005 * total) add("not told", "rest", total - sum);
  return fmt::format(R"(<div class="bar" style="width:{:.1f}%">{}</div>)", 100 * std::max(0.02, total / longest), bar);
}

double phase_sum(const Row& row) {
  double sum = 0;
  for (const auto& [name, ms] : row.time.phase_ms) sum += std::max(ms, 0.0);
  return sum;
}

Table phase_table(const PageContext& context, const std::vector<std::string>& phases) {
  Table table("time by phase");
  table.column({"scene", 9, Column::Kind::name, {}, true});
  table.column({"backend", 7, Column::Kind::name});
  table.column({"ms per step", 5});
  table.column({"share of the slowest engine's step", 16, Column::Kind::text});
  for (const Problem& problem : context.ordered.problems) {
    double longest = 0;
    for (const std::string& backend : context.ordered.backends) {
      const Row* row = default_run(context.ordered, problem, backend);
      if (row && row->completed()) longest = std::max({longest, phase_sum(*row), row->fair_ms().value_or(0)});
    }
    for (const std::string& backend : context.ordered.backends) {
      const Row* row = default_run(context.ordered, problem, backend);
      if (!row || !row->completed() || row->time.contended || row->time.phase_ms.empty()) continue;
      const double sum = phase_sum(*row), total = std::max(sum, row->time.median_ms.value_or(sum));
      if (!(total > 0)) continue;
      const double shown = row->time.median_ms.value_or(sum);
      table.row(
          {problem_label(context, problem), backend_label(context, row->backend),
           cell(row_link(*row, short_number(shown)), shown), cell(phase_bar(*row, phases, sum, total, longest), total)},
          filter_key(context, problem, row->backend), context.backend_index(row->backend));
    }
  }
  return table;
}

}  // namespace

PageSection times_section(const PageContext& context) {
  PageSection section{"times", "Times side by side", ""};
  section.words = about(
      R"(Median milliseconds per step at each engine's defaults, and how many times that is of the fastest engine )"
      R"(whose run passes. A dagger marks a run that missed a threshold: its time bought a wrong answer, and it is the )"
      R"(fastest of nothing.)" +
      untimed_note(context));
  section.blocks.push_back(ratio_table(context).block());
  const std::vector<std::string> phases = phases_of(context.ordered);
  if (phases.empty()) return section;
  std::string legend;
  for (std::size_t i = 0; i < phases.size(); ++i)
    legend += fmt::format(R"(<span><i class="p{}"></i>{}</span>)", i % 8, escape_html(phases[i]));
  legend += R"(<span><i class="rest"></i>not told by the engine</span>)";
  section.blocks.push_back(group_block("Time by phase", "as each engine tells it", false,
                                       Json::array({words_block(fmt::format(R"(<p class="legend">{}</p>)", legend)),
                                                    phase_table(context, phases).block()})));
  return section;
}

}  // namespace plumb::harness
