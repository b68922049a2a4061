#include "report/text/scorecard_text.hpp"

#include <fmt/format.h>

#include <functional>
#include <ostream>

#include "base/format.hpp"
#include "report/findings/scorecard.hpp"
#include "report/ordered/machine_rows.hpp"
#include "report/text/markdown.hpp"
#include "report/text/text_table.hpp"

namespace plumb::harness {
namespace {

/// A machine's scores, ready to be written down in any form.
struct MachineScores {
  std::string machine;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> lines;
  std::vector<std::pair<std::string, std::vector<Statement>>> lists;  ///< "Best of ode", and the scenes
};

std::vector<std::string> score_line(const std::string& group, const EngineScore& engine, const GroupScore& score) {
  return {group, engine.backend, passed_text(score), score_text(score.error), score_text(score.cost)};
}

/// All groups' engines below each other; the sum of groups only where there are several.
MachineScores machine_scores(const std::string& machine, const OrderedRows& ordered, const Comparison* comparison) {
  const std::vector<CostLine> costs = cost_of_accuracy(ordered);
  const std::vector<EngineScore> engines = scorecard(ordered, costs, overviews(ordered, costs));
  MachineScores scores{machine, {"group", "engine", "passes", "error", "cost of 1 %"}, {}, {}};
  if (comparison) scores.header.emplace_back("since");
  const auto add = [&](const std::string* group, const EngineScore& engine, const GroupScore& score) {
    scores.lines.push_back(score_line(group ? *group : "all", engine, score));
    if (comparison) scores.lines.back().push_back(change_text(score_change(*comparison, engine.backend, group)));
  };
  for (std::size_t g = 0; g < ordered.groups.size(); ++g) {
    for (const EngineScore& engine : engines) add(&ordered.groups[g], engine, engine.groups[g]);
  }
  for (const EngineScore& engine : engines) {
    if (ordered.groups.size() > 1) add(nullptr, engine, engine.all);
    if (!engine.best.empty()) scores.lists.emplace_back(engine.backend + " is best in", engine.best);
    if (!engine.breaks.empty()) scores.lists.emplace_back(engine.backend + " breaks in", engine.breaks);
  }
  return scores;
}

/// Those of each machine with several engines.
void for_each_machine(const std::vector<Row>& rows, const std::vector<Row>* baseline, const AgainstLimits& limits,
                      const std::function<void(const MachineScores&)>& show) {
  const std::vector<MachineRows> machines = rows_by_machine(rows);
  for (const MachineRows& machine : machines) {
    const OrderedRows ordered(machine.rows);
    if (ordered.backends.size() < 2) continue;
    std::optional<Comparison> comparison;
    if (baseline) comparison = compare_results(*baseline, ordered.rows, limits);
    show(machine_scores(machines.size() > 1 ? machine.name : "", ordered, comparison ? &*comparison : nullptr));
  }
}

}  // namespace

const char* about_scorecard() {
  return "passes: scene variants at the engine's defaults. error: what can be had for the cost of the dearest engine's "
         "defaults, over the best engine's. cost of 1 %: of the cheapest run that is so exact, over the cheapest "
         "engine's. Both are geometric means over metrics, of passing runs only; in brackets how many of those that an "
         "engine passes with this one does.";
}

void print_scorecard(std::ostream& out, const std::vector<Row>& rows, const std::vector<Row>* baseline,
                     const AgainstLimits& limits, int terminal_width, bool colour) {
  for_each_machine(rows, baseline, limits, [&](const MachineScores& scores) {
    out << '\n';
    if (!scores.machine.empty()) out << printable(scores.machine) << '\n';
    std::vector<TextColumn> columns;
    for (std::size_t c = 0; c < scores.header.size(); ++c) columns.push_back({scores.header[c], c > 1, c < 2});
    TextTable table(columns);
    for (const std::vector<std::string>& line : scores.lines) {
      std::vector<TextCell> cells;
      for (const std::string& text : line) cells.push_back({printable(text)});
      table.add(std::move(cells));
    }
    table.print(out, terminal_width, colour);
    for (const auto& [title, statements] : scores.lists) {
      out << printable(title) << ":\n";
      for (const Statement& statement : statements) out << "  " << printable(statement.text) << '\n';
    }
    out << about_scorecard() << '\n';
  });
}

void write_scorecard_markdown(std::ostream& out, const std::vector<Row>& rows, const std::vector<Row>* baseline,
                              const AgainstLimits& limits) {
  for_each_machine(rows, baseline, limits, [&](const MachineScores& scores) {
    out << "\n## Scorecard" << (scores.machine.empty() ? "" : ", " + markdown_text(scores.machine)) << "\n\n"
        << markdown_text(about_scorecard()) << "\n\n";
    const auto write_line = [&](const std::vector<std::string>& line) {
      out << '|';
      for (const std::string& text : line) out << ' ' << markdown_text(text) << " |";
      out << '\n';
    };
    write_line(scores.header);
    out << "|---|---|";
    for (std::size_t c = 2; c < scores.header.size(); ++c) out << "---:|";
    out << '\n';
    for (const std::vector<std::string>& line : scores.lines) write_line(line);
    out << '\n';
    for (const auto& [title, statements] : scores.lists) {
      out << "- " << markdown_text(title) << ' ';
      for (const Statement& statement : statements)
        out << (&statement == statements.data() ? "" : "; ") << markdown_text(statement.text);
      out << '\n';
    }
  });
}

}  // namespace plumb::harness
