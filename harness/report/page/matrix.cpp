// The pass matrix: every problem against every backend, with the number that decided.
#include <fmt/format.h>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

std::string cell_number(const ResultRow& row) {
  const MetricResult* worst = row.worst();
  if (!row.completed() || !worst) return "";
  return worst->error ? short_number(*worst->error, 2) : "not finite";
}

std::string cell(const PageContext& context, const Problem& problem, const std::string& backend) {
  const std::size_t index = context.backend_index(backend);
  const ResultRow* row = context.study.representative(problem, backend);
  if (!row) return fmt::format(R"(<td class="e{} absent" title="not run">{}</td>)", index, no_value);
  std::size_t cells = 0;
  for (const ResultRow* other : problem.rows) cells += other->backend == backend;
  const Verdict verdict = row->verdict();
  const std::string below = row->completed() ? cell_number(*row) : row->reason;
  std::string hover = row_hover(context, *row);
  if (cells > 1) hover += fmt::format("\n{} more cells with other settings", cells - 1);
  return fmt::format(R"(<td class="e{} {}" data-v="{}"><a href="#r{}" title="{}"><b>{}</b><span>{}</span></a></td>)",
                     index, verdict_word(verdict), static_cast<int>(verdict), row->index, escape_html(hover),
                     escape_html(verdict_title(verdict)), escape_html(below));
}

}  // namespace

std::string matrix_section(const PageContext& context) {
  std::string out =
      section_start(context, "matrix", "Pass matrix") +
      R"(<p class="about">Each engine at its defaults. The number is the )"
      R"(error of the metric that )"
      R"(comes closest to its threshold or exceeds it most; hover for all metrics, click for the run.</p>)";
  out += R"(<div class="scroll"><table class="matrix sortable"><thead><tr><th scope="col" data-sort>scene</th>)";
  for (const std::string& backend : context.study.backends) {
    out += fmt::format(R"(<th scope="col" class="e{}" data-sort>{}</th>)", context.backend_index(backend),
                       backend_label(context, backend));
  }
  out += "</tr></thead><tbody>";
  for (std::size_t i = 0; i < context.study.problems.size(); ++i) {
    const Problem& problem = context.study.problems[i];
    out += fmt::format(R"(<tr {}>{})", filter_key(context, problem), problem_header(context, problem));
    for (const std::string& backend : context.study.backends) out += cell(context, problem, backend);
    out += "</tr>";
  }
  return out + "</tbody></table></div></section>";
}

}  // namespace plumb::harness
