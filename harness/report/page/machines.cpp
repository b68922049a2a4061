// Machines beside each other: a table, since no diagram may show times of two of them.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

/// Rows of one problem and backend, by machine; null where it did not run there.
using Beside = std::vector<const ResultRow*>;

std::string cell(const PageContext& context, const ResultRow* row) {
  if (!row) return fmt::format(R"(<td class="absent">{}</td><td class="absent"></td>)", no_value);
  const MetricResult* worst = row->completed() ? row->worst() : nullptr;
  const std::string time = row->completed() && row->fair_ms()   ? short_number(*row->fair_ms())
                           : row->completed() && row->contended ? "contended"
                                                                : verdict_title(row->verdict());
  return fmt::format("<td>{}</td><td>{}</td>", row_link(*row, time, row_hover(context, *row)),
                     worst ? short_number(worst->error, 2) : "");
}

/// "yes" where all that ran have the same bits at the end.
const char* same_bits(const Beside& rows) {
  const ResultRow* first = nullptr;
  for (const ResultRow* row : rows) {
    if (!row) continue;
    if (row->hash.empty()) return "";
    if (!first) first = row;
    if (row->hash != first->hash) return "no";
  }
  return "yes";
}

}  // namespace

std::string machines_section(const std::vector<PageContext>& machines) {
  if (machines.size() < 2) return "";
  std::map<std::pair<std::string, std::string>, Beside> beside;  // by problem and backend
  std::vector<std::pair<std::string, std::string>> order;
  for (std::size_t i = 0; i < machines.size(); ++i) {
    for (const Problem& problem : machines[i].study.problems) {
      for (const std::string& backend : machines[i].study.backends) {
        const ResultRow* row = machines[i].study.representative(problem, backend);
        if (!row) continue;
        const auto [at, is_new] = beside.try_emplace({problem.title(), backend}, machines.size(), nullptr);
        if (is_new) order.push_back(at->first);
        at->second[i] = row;
      }
    }
  }
  std::erase_if(order, [&](const auto& key) {
    const Beside& rows = beside.at(key);
    return std::count(rows.begin(), rows.end(), nullptr) + 1 >= static_cast<std::ptrdiff_t>(rows.size());
  });
  std::string out = fmt::format(
      R"(<section id="machines"><h2>{} machines</h2><p class="about">Everything below is told machine by machine; the )"
      R"(switch at the top chooses. Times of different machines stand beside each other here, at the engines' defaults, )"
      R"(and in no diagram and no ratio.</p>)",
      machines.size());
  if (order.empty()) return out + R"(<p class="about">Nothing ran on two of them.</p></section>)";
  out +=
      R"(<details class="group"><summary>Side by side</summary><div class="scroll"><table class="numbers"><thead><tr>)"
      R"(<th scope="col">scene</th><th scope="col" class="name">backend</th>)";
  for (const PageContext& machine : machines)
    out += fmt::format(R"(<th scope="col">{} <small>ms a step</small></th><th scope="col">error</th>)",
                       escape_html(machine.machine));
  out += R"(<th scope="col">same bits</th></tr></thead><tbody>)";
  for (const auto& key : order) {
    const Beside& rows = beside.at(key);
    const std::size_t backend = machines.front().backend_index(key.second);
    out += fmt::format(R"(<tr class="e{}" data-k="{}"><th scope="row">{}</th><td class="name">{}</td>)", backend,
                       escape_html(lower(key.first + " " + key.second)), escape_html(key.first),
                       backend_label(machines.front(), key.second));
    for (std::size_t i = 0; i < rows.size(); ++i) out += cell(machines[i], rows[i]);
    out += fmt::format("<td>{}</td></tr>", same_bits(rows));
  }
  return out + "</tbody></table></div></details></section>";
}

}  // namespace plumb::harness
