// Machines beside each other: a table, since no diagram may show times of two of them.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/format.hpp"
#include "report/ordered/default_run.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

/// Rows of one problem and backend, by machine; null where it did not run there.
using Beside = std::vector<const Row*>;

void add_cells(const Row* row, Json& cells) {
  if (!row) {
    cells.push_back(cell(std::string(no_value), {}, "quiet"));
    cells.push_back("");
    return;
  }
  const MetricResult* worst = row->completed() ? row->worst() : nullptr;
  const std::string time = row->completed() && row->fair_ms()        ? short_number(*row->fair_ms())
                           : row->completed() && row->time.contended ? "contended"
                                                                     : verdict_title(row->verdict());
  cells.push_back(cell(row_link(*row, time) + (row->completed() ? failed_mark(*row) : ""),
                       row->completed() ? row->fair_ms() : std::nullopt));
  cells.push_back(cell(worst ? short_number(worst->error, 2) : "", worst ? worst->error : std::nullopt));
}

/// "yes" where all that ran have the same bits at the end.
const char* same_bits(const Beside& rows) {
  const Row* first = nullptr;
  for (const Row* row : rows) {
    if (!row) continue;
    if (row->hash.empty()) return "";
    if (!first) first = row;
    if (row->hash != first->hash) return "no";
  }
  return "yes";
}

}  // namespace

PageSection machines_section(const std::vector<PageContext>& machines) {
  PageSection section{"machines", fmt::format("{} machines", machines.size()), ""};
  if (machines.size() < 2) return section;
  std::map<std::pair<std::string, std::string>, Beside> beside;  // by problem and backend
  std::vector<std::pair<std::string, std::string>> order;
  for (std::size_t i = 0; i < machines.size(); ++i) {
    for (const Problem& problem : machines[i].ordered.problems) {
      for (const std::string& backend : machines[i].ordered.backends) {
        const Row* row = default_run(machines[i].ordered, problem, backend);
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
  section.words = about(
      R"(Everything above is told machine by machine; the )"
      R"(switch at the top chooses. Times of different machines stand beside each other here, at the engines' defaults, )"
      R"(and in no diagram and no ratio.)");
  if (order.empty()) {
    section.words += about("Nothing ran on two of them.");
    return section;
  }
  Table table("machines side by side");
  table.column({"scene", 9, Column::Kind::name, {}, true});
  table.column({"backend", 7, Column::Kind::name});
  for (const PageContext& machine : machines) {
    table.column({escape_html(machine.machine) + " <small>ms a step</small>", 8});
    table.column({"error", 5});
  }
  table.column({"same bits", 5, Column::Kind::text});
  for (const auto& key : order) {
    const Beside& rows = beside.at(key);
    Json cells = Json::array({escape_html(key.first), backend_label(machines.front(), key.second)});
    for (const Row* row : rows) add_cells(row, cells);
    cells.push_back(same_bits(rows));
    table.row(std::move(cells), lower(key.first + " " + key.second), machines.front().backend_index(key.second));
  }
  section.blocks.push_back(table.block());
  return section;
}

}  // namespace plumb::harness
