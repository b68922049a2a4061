// What each need costs: an engine that is told of more than the scene needs, against itself.
#include "report/findings/needs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/format.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {

PageSection needs_section(const PageContext& context) {
  PageSection section{"needs", "What each need costs", ""};
  const std::vector<NeedCost> costs = costs_of_needs(context.ordered);
  if (costs.empty()) return section;
  section.words = about(
      R"(The time of a step where one thing more was declared than the scene needs, over that of the )"
      R"(same run without it: 1.00&#215; is what a feature that nobody uses should cost. <b>all</b>: everything that the )"
      R"(engine has. Only pairs that end with the same bits count: where bodies fall asleep or collisions begin, the )"
      R"(engine does other work, which stands in the last column.)" +
      untimed_note(context));
  Table table("what each need costs");
  table.column({"one need more", 8, Column::Kind::name, {}, true});
  table.column({"backend", 7, Column::Kind::name});
  table.column({"median", 4});
  table.column({"from", 4});
  table.column({"to", 4});
  table.column({"pairs", 3});
  table.column({"dearest in", 11, Column::Kind::text});
  table.column({"did other work in", 11, Column::Kind::text});
  std::vector<const Row*> rows;
  for (const NeedCost& cost : costs) {
    Json cells = Json::array({escape_html(cost.need), backend_label(context, cost.backend)});
    if (cost.pairs.empty()) {
      for (int i = 0; i < 3; ++i) cells.push_back(cell(std::string(no_value), {}, "quiet"));
      cells.push_back("0");
      cells.push_back("");
    } else {
      const NeedPair &first = cost.pairs.front(), &last = cost.pairs.back();
      cells.push_back(cell(ratio_text(*cost.median), *cost.median));
      cells.push_back(cell(row_link(*last.with, ratio_text(last.factor)), last.factor));
      cells.push_back(cell(row_link(*first.with, ratio_text(first.factor)), first.factor));
      cells.push_back(std::to_string(cost.pairs.size()));
      cells.push_back(fmt::format("{} <small>{} ms, without {} ms</small>", escape_html(problem_title(*first.with)),
                                  row_link(*first.with, short_number(*first.with->fair_ms())),
                                  row_link(*first.without, short_number(*first.without->fair_ms()))));
    }
    std::string changed;
    for (const NeedPair& pair : cost.changed)
      changed += fmt::format("{}{} <small>{}</small>", changed.empty() ? "" : ", ",
                             row_link(*pair.with, problem_title(*pair.with)), ratio_text(pair.factor));
    cells.push_back(changed);
    table.row(std::move(cells), lower(cost.need + " " + cost.backend), context.backend_index(cost.backend));
    for (const auto* pairs : {&cost.pairs, &cost.changed}) {
      for (const NeedPair& pair : *pairs) rows.push_back(pair.with);
    }
  }
  section.blocks.push_back(table.block());
  section.blocks.push_back(words_block(figure_foot(context, rows, "needs")));
  return section;
}

}  // namespace plumb::harness
