// Distributions over seeds, an engine a column.
#include "report/findings/distributions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/format.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

Json distribution_cell(const DistributionLine& line, const std::optional<DistributionCell>& runs) {
  if (!runs) return cell(std::string(no_value), {}, "quiet");
  const std::string middle = short_number(runs->median, 2);
  const std::string share = fmt::format("{} of {}", runs->passed, runs->runs);
  const std::string range =
      runs->median ? fmt::format("{} to {}", short_number(runs->least, 2), short_number(runs->most, 2)) : "";
  const std::string below = line.asked ? "" : line.scored ? fmt::format("{}; {}", middle, range) : range;
  return cell(
      fmt::format(R"({}<span class="cfg">{}</span>)", row_link(*runs->row, line.scored ? share : middle), below),
      line.scored ? static_cast<double>(runs->passed) / static_cast<double>(runs->runs) : runs->median.value_or(0),
      line.scored && runs->passed == runs->runs ? "best" : "");
}

}  // namespace

PageSection distributions_section(const PageContext& context) {
  PageSection section{"seeds", "Distributions over seeds", ""};
  const std::vector<DistributionLine> lines = distributions(context.ordered);
  if (lines.empty()) return section;
  section.words = about(
      R"(Scenes that were begun in several ways, at each engine's defaults: how many runs met the )"
      R"(threshold, with the median of the errors and their range; of what has no truth, the median of the values and )"
      R"(their range. A link leads to the run that lies farthest out. Set off: all runs met it.)");
  Table table("distributions over seeds");
  table.column({"scene", 10, Column::Kind::name, {}, true});
  table.column({"measure", 8, Column::Kind::text});
  add_backend_columns(context, table, 8);
  for (const DistributionLine& line : lines) {
    std::string name = line.metric;
    std::replace(name.begin(), name.end(), '_', ' ');
    name = escape_html(name);
    if (!line.scored && !line.unit.empty() && line.unit != "1")
      name += fmt::format(" <small>{}</small>", escape_html(line.unit));
    Json cells = Json::array({problem_label(context, *line.problem), name});
    for (const auto& runs : line.cells) cells.push_back(distribution_cell(line, runs));
    table.row(std::move(cells), filter_key(context, *line.problem, line.metric));
  }
  section.blocks.push_back(table.block());
  return section;
}

}  // namespace plumb::harness
