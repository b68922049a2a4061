// The pass matrix: every problem against every backend, with the number that decided.
#include <fmt/format.h>

#include "base/format.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

std::string cell_number(const Row& row) {
  const MetricResult* worst = row.worst();
  if (!row.completed() || !worst) return "";
  return worst->error ? short_number(*worst->error, 2) : "not finite";
}

Json matrix_cell(const PageContext& context, const Problem& problem, const std::string& backend) {
  const Row* row = context.ordered.representative(problem, backend);
  if (!row) return cell(std::string(no_value), {}, "quiet");
  const Verdict verdict = row->verdict();
  std::string below = row->completed() ? cell_number(*row) : row->reason;
  if (!context.ordered.is_default(*row)) below += " with " + context.ordered.configuration(*row);
  return cell(fmt::format(R"(<a href="#r{}"><b>{}</b><span>{}</span></a>)", row->origin.index,
                          escape_html(verdict_title(verdict)), escape_html(below)),
              static_cast<double>(verdict), fmt::format("verdict {}", verdict_word(verdict)));
}

}  // namespace

PageSection matrix_section(const PageContext& context) {
  PageSection section{"matrix", "Pass matrix", ""};
  section.words = about(
      R"(Each engine at its defaults, or with the settings that are told where it ran with others only. The number is the error of the metric that )"
      R"(comes closest to its threshold or exceeds it most; hover for all metrics, click for the run.)");
  Table table("the pass matrix", "matrix");
  table.column({"scene", 11, Column::Kind::name});
  add_backend_columns(context, table, 7);
  for (const Problem& problem : context.ordered.problems) {
    Json cells = Json::array({problem_label(context, problem)});
    std::string verdicts;
    for (const std::string& backend : context.ordered.backends) {
      const Row* row = context.ordered.representative(problem, backend);
      if (row) verdicts += " " + verdict_title(row->verdict());
      cells.push_back(matrix_cell(context, problem, backend));
    }
    table.row(std::move(cells), filter_key(context, problem, verdicts));
  }
  section.blocks.push_back(table.block());
  return section;
}

}  // namespace plumb::harness
