// The section that holds these results against a baseline.
#include <fmt/format.h>

#include "report/against_text.hpp"
#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

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

std::string cell_row(const PageContext& context, const CellChange& cell) {
  const ResultRow& row = *cell.after;
  const std::string title = problem_title(row);
  return fmt::format(
      R"(<tr class="e{}" data-k="{}"><th scope="row">{}</th><td class="name">{}</td><td class="text">{}</td>)"
      R"(<td class="text why">{}</td></tr>)",
      context.backend_index(row.backend),
      escape_html(lower(fmt::format("{} {} {} {}", title, row.group, row.backend, sense_word(cell.sense)))),
      row_link(row, title, ""), backend_label(context, row.backend), escape_html(context.study.configuration(row)),
      changes_list(cell));
}

std::string only_list(const std::vector<const ResultRow*>& rows, const char* title) {
  if (rows.empty()) return "";
  std::string items;
  for (const ResultRow* row : rows)
    items += fmt::format("<li>{}, {}, {} s</li>", escape_html(problem_title(*row)), escape_html(row->backend),
                         dt_text(row->dt));
  return fmt::format(R"(<details class="how"><summary>{} {}</summary><ul>{}</ul></details>)", rows.size(), title,
                     items);
}

}  // namespace

std::string against_section(const PageContext& context) {
  if (!context.options.against) return "";
  const AgainstPart& part = *context.options.against;
  const std::vector<ResultRow> before = parse_rows(part.rows);
  const Comparison comparison = compare_results(before, context.study.rows, part.limits);
  std::string out = section_start(context, "against", "Against the baseline");
  for (const std::string& sentence : describe_comparison(comparison, part.name, part.limits))
    out += fmt::format(R"(<p class="about">{}</p>)", escape_html(sentence));
  for (const Sense sense : {Sense::worse, Sense::better, Sense::changed}) {
    const std::size_t count = comparison.count(sense);
    if (count == 0) continue;
    std::string rows;
    for (const CellChange& cell : comparison.cells) {
      if (cell.sense == sense) rows += cell_row(context, cell);
    }
    out += fmt::format(
        R"(<details class="group"{}><summary><span class="sense {}">{}</span> <small>{} {}</small></summary>)"
        R"(<div class="scroll"><table class="numbers runs-like"><tbody>{}</tbody></table></div></details>)",
        sense == Sense::changed ? "" : " open", sense_word(sense), group_title(std::string(sense_word(sense))), count,
        count == 1 ? "cell" : "cells", rows);
  }
  out += only_list(comparison.only_before, "cells only in the baseline");
  out += only_list(comparison.only_after, "cells only in these results");
  return out + "</section>";
}

}  // namespace plumb::harness
