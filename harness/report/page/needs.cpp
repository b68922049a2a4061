// What each need costs: an engine that is told of more than the scene needs, against itself.
#include "report/needs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {

std::string needs_section(const PageContext& context) {
  const std::vector<NeedCost> costs = costs_of_needs(context.study);
  if (costs.empty()) return "";
  std::string out = section_start(context, "needs", "What each need costs");
  out +=
      R"(<p class="about">The time of a step where one thing more was declared than the scene needs, over that of the )"
      R"(same run without it: 1.00&#215; is what a feature that nobody uses should cost. <b>all</b>: everything that the )"
      R"(engine has.</p><div class="scroll"><table class="numbers needs"><thead><tr><th scope="col">one need more</th>)"
      R"(<th scope="col" class="name">backend</th><th scope="col">median</th><th scope="col">from</th>)"
      R"(<th scope="col">to</th><th scope="col">pairs</th><th scope="col" class="text">dearest in</th></tr></thead><tbody>)";
  for (const NeedCost& cost : costs) {
    const NeedPair &first = cost.pairs.front(), &last = cost.pairs.back();
    out += fmt::format(
        R"(<tr class="e{}"><th scope="row">{}</th><td class="name">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>)"
        R"(<td class="text">{} <small>{} ms, without {} ms</small></td></tr>)",
        context.backend_index(cost.backend), escape_html(cost.need), backend_label(context, cost.backend),
        ratio_text(cost.median), row_link(*last.with, ratio_text(last.factor), problem_title(*last.with)),
        row_link(*first.with, ratio_text(first.factor), problem_title(*first.with)), cost.pairs.size(),
        escape_html(problem_title(*first.with)), row_link(*first.with, short_number(*first.with->fair_ms()), ""),
        row_link(*first.without, short_number(*first.without->fair_ms()), ""));
  }
  std::vector<const ResultRow*> rows;
  for (const NeedCost& cost : costs) {
    for (const NeedPair& pair : cost.pairs) rows.push_back(pair.with);
  }
  return out + "</tbody></table></div>" + figure_foot(context, rows, "needs") + "</section>";
}

}  // namespace plumb::harness
