// Robustness: what holds in every scene without a truth, an engine a column.
#include "report/robustness.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

std::string cell_text(const PageContext& context, std::size_t backend, const std::optional<RobustnessCell>& cell) {
  if (!cell) return fmt::format(R"(<td class="e{} absent">{}</td>)", backend, no_value);
  const std::string scene = problem_title(*cell->row);
  return fmt::format(
      R"(<td class="e{}{}">{} <small>{}</small><span class="cfg">median {}; beyond in {} of {}</span></td>)", backend,
      cell->beyond == 0 ? " best" : "",
      row_link(*cell->row, short_number(cell->worst, 2), row_hover(context, *cell->row)), escape_html(scene),
      short_number(cell->median, 2), cell->beyond, cell->runs);
}

}  // namespace

std::string robustness_section(const PageContext& context) {
  const std::vector<RobustnessLine> lines = robustness(context.study);
  if (lines.empty()) return "";
  std::string out = section_start(context, "robust", "Robustness");
  out +=
      R"(<p class="about">Measures that need no truth of their own and hold in every scene, at each engine's defaults: )"
      R"(the worst and where, the median over scenes, and how many runs are beyond the bound (a reading aid, no )"
      R"(threshold of a scene). Set off: none is.</p><div class="scroll"><table class="numbers robust"><thead><tr>)"
      R"(<th scope="col">measure</th><th scope="col">bound</th>)";
  for (const std::string& backend : context.study.backends) {
    out += fmt::format(R"(<th scope="col" class="e{}">{}</th>)", context.backend_index(backend),
                       backend_label(context, backend));
  }
  out += "</tr></thead><tbody>";
  for (const RobustnessLine& line : lines) {
    std::string name = line.metric;
    std::replace(name.begin(), name.end(), '_', ' ');
    out += fmt::format(
        R"(<tr><th scope="row">{}{}</th><td>{}</td>)", escape_html(name),
        line.unit.empty() || line.unit == "1" ? "" : fmt::format(" <small>{}</small>", escape_html(line.unit)),
        limit_text(line.bound));
    for (std::size_t i = 0; i < line.cells.size(); ++i)
      out += cell_text(context, context.backend_index(context.study.backends[i]), line.cells[i]);
    out += "</tr>";
  }
  return out + "</tbody></table></div></section>";
}

}  // namespace plumb::harness
