// The section that holds these results against a baseline.
#include <fmt/format.h>

#include "base/format.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"
#include "report/text/against_text.hpp"

namespace plumb::harness {
namespace {

std::string changes_list(const CellChange& cell) {
  std::string out;
  for (const Change& change : cell.changes) {
    out += fmt::format(R"({}<span class="sense {}">{}</span>)", out.empty() ? "" : "; ", sense_word(change.sense),
                       escape_html(change.text));
  }
  return out;
}

Table change_table(const PageContext& context, const Comparison& comparison, Sense sense) {
  Table table(fmt::format("cells that are {}", sense_word(sense)));
  table.column({"scene", 7, Column::Kind::name});
  table.column({"backend", 7, Column::Kind::name});
  table.column({"configuration", 10, Column::Kind::text});
  table.column({"changes", 18, Column::Kind::text});
  for (const CellChange& change : comparison.cells) {
    if (change.sense != sense) continue;
    const Row& row = *change.after;
    const std::string title = problem_title(row);
    table.row({row_link(row, title), backend_label(context, row.backend),
               escape_html(context.ordered.configuration(row)), changes_list(change)},
              lower(fmt::format("{} {} {} {}", title, row.group, row.backend, sense_word(sense))),
              context.backend_index(row.backend));
  }
  return table;
}

std::string only_list(const std::vector<const Row*>& rows, const char* title) {
  if (rows.empty()) return "";
  std::string items;
  for (const Row* row : rows)
    items += fmt::format("<li>{}, {}, {} s</li>", escape_html(problem_title(*row)), escape_html(row->backend),
                         dt_text(row->dt));
  return fmt::format(R"(<details class="how"><summary>{} {}</summary><ul>{}</ul></details>)", rows.size(), title,
                     items);
}

}  // namespace

PageSection against_section(const PageContext& context) {
  PageSection section{"against", "Against the baseline", ""};
  if (!context.options.against) return section;
  const AgainstPart& part = *context.options.against;
  const std::vector<Row>& before = part.rows;
  const Comparison comparison = compare_results(before, context.ordered.rows, part.limits);
  for (const std::string& sentence : describe_comparison(comparison, part.name, part.limits))
    section.words += about(escape_html(sentence));
  for (const Sense sense : {Sense::worse, Sense::better, Sense::changed}) {
    const std::size_t count = comparison.count(sense);
    if (count == 0) continue;
    section.blocks.push_back(group_block(
        group_title(std::string(sense_word(sense))), fmt::format("{} {}", count, count == 1 ? "cell" : "cells"),
        sense != Sense::changed, Json::array({change_table(context, comparison, sense).block()})));
  }
  section.words += only_list(comparison.only_before, "cells only in the baseline");
  section.words += only_list(comparison.only_after, "cells only in these results");
  return section;
}

}  // namespace plumb::harness
