// Distributions over seeds, an engine a column.
#include "report/distributions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

std::string cell_text(const PageContext& context, std::size_t backend, const DistributionLine& line,
                      const std::optional<DistributionCell>& cell) {
  if (!cell) return fmt::format(R"(<td class="e{} absent">{}</td>)", backend, no_value);
  const std::string middle = short_number(cell->median, 2);
  const std::string share = fmt::format("{} of {}", cell->passed, cell->runs);
  const std::string range =
      cell->median ? fmt::format("{} to {}", short_number(cell->least, 2), short_number(cell->most, 2)) : "";
  const std::string below = line.asked ? "" : line.scored ? fmt::format("{}; {}", middle, range) : range;
  return fmt::format(R"(<td class="e{}{}">{}<span class="cfg">{}</span></td>)", backend,
                     line.scored && cell->passed == cell->runs ? " best" : "",
                     row_link(*cell->row, line.scored ? share : middle, row_hover(context, *cell->row)), below);
}

}  // namespace

std::string distributions_section(const PageContext& context) {
  const std::vector<DistributionLine> lines = distributions(context.study);
  if (lines.empty()) return "";
  std::string out = section_start(context, "seeds", "Distributions over seeds");
  out +=
      R"(<p class="about">Scenes that were begun in several ways, at each engine's defaults: how many runs met the )"
      R"(threshold, with the median of the errors and their range; of what has no truth, the median of the values and )"
      R"(their range. A link leads to the run that lies farthest out. Set off: all runs met it.</p>)"
      R"(<div class="scroll"><table class="numbers robust"><thead><tr><th scope="col">scene</th>)"
      R"(<th scope="col" class="text">measure</th>)";
  for (const std::string& backend : context.study.backends) {
    out += fmt::format(R"(<th scope="col" class="e{}">{}</th>)", context.backend_index(backend),
                       backend_label(context, backend));
  }
  out += "</tr></thead><tbody>";
  const Problem* last = nullptr;
  for (const DistributionLine& line : lines) {
    std::string name = line.metric;
    std::replace(name.begin(), name.end(), '_', ' ');
    out += fmt::format(R"(<tr {}>{}<td class="text">{}{}</td>)", filter_key(context, *line.problem),
                       line.problem == last ? R"(<th scope="row"></th>)" : problem_header(context, *line.problem),
                       escape_html(name),
                       line.scored || line.unit.empty() || line.unit == "1"
                           ? ""
                           : fmt::format(" <small>{}</small>", escape_html(line.unit)));
    for (std::size_t i = 0; i < line.cells.size(); ++i)
      out += cell_text(context, context.backend_index(context.study.backends[i]), line, line.cells[i]);
    out += "</tr>";
    last = line.problem;
  }
  return out + "</tbody></table></div></section>";
}

}  // namespace plumb::harness
