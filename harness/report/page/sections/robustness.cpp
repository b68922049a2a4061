// Robustness: what holds in every scene without a truth, an engine a column.
#include "report/findings/robustness.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/format.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

Json robustness_cell(const std::optional<RobustnessCell>& runs) {
  if (!runs) return cell(std::string(no_value), {}, "quiet");
  return cell(
      fmt::format(
          R"({} <small>{}</small><span class="cfg">median {}</span><span class="cfg">beyond in {} of {}{}</span>)",
          row_link(*runs->row, short_number(runs->worst, 2)), escape_html(problem_title(*runs->row)),
          short_number(runs->median, 2), runs->beyond, runs->runs,
          runs->lost > 0 ? fmt::format("; {} without a result", runs->lost) : ""),
      runs->worst, runs->beyond == 0 && runs->lost == 0 ? "best" : "");
}

}  // namespace

PageSection robustness_section(const PageContext& context) {
  PageSection section{"robust", "Robustness", ""};
  const std::vector<RobustnessLine> lines = robustness(context.ordered);
  if (lines.empty()) return section;
  section.words =
      about(R"(Measures that need no truth of their own and hold in every scene, at each engine's defaults: )"
            R"(the worst and where, the median over scenes, and how many runs are beyond the bound (a reading aid, no )"
            R"(threshold of a scene). Set off: none is, and all have a result.)");
  Table table("measures that hold in every scene");
  table.column({"measure", 9, Column::Kind::name});
  table.column({"bound", 4});
  add_backend_columns(context, table, 9);
  for (const RobustnessLine& line : lines) {
    std::string name = line.metric;
    std::replace(name.begin(), name.end(), '_', ' ');
    name = escape_html(name);
    if (!line.unit.empty() && line.unit != "1") name += fmt::format(" <small>{}</small>", escape_html(line.unit));
    Json cells = Json::array({name, cell(limit_text(line.bound), line.bound)});
    for (const auto& runs : line.cells) cells.push_back(robustness_cell(runs));
    table.row(std::move(cells));
  }
  section.blocks.push_back(table.block());
  return section;
}

}  // namespace plumb::harness
