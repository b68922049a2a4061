#include "report/text/terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ostream>

#include "base/format.hpp"
#include "report/ordered/machine_rows.hpp"
#include "report/ordered/ordered_rows.hpp"
#include "report/text/row_text.hpp"
#include "report/text/text_table.hpp"

namespace plumb::harness {
namespace {

/// "drop 0.0084 > 0.001", with the sense in which the error stands to its limit.
std::string worst_text(const Row& row) {
  const MetricResult* worst = row.worst();
  if (!row.completed() || !worst) return "";
  const std::string name = printable(worst->name);
  const std::optional<double> limit = worst->threshold ? worst->threshold : worst->gold;
  if (!limit) return name;
  const std::string error = worst->error ? short_number(*worst->error) : "not finite";
  const bool missed = !worst->error || *worst->error > *limit;
  return fmt::format("{} {} {} {}", name, error, missed ? ">" : "\u2264", limit_text(*limit));
}

void print_legend(std::ostream& out, const OrderedRows& ordered) {
  const bool any = std::any_of(ordered.rows.begin(), ordered.rows.end(),
                               [](const Row& row) { return row.time.contended && row.time.median_ms; });
  if (any) out << "(ms): the machine had other work;\nsuch a time counts nowhere.\n";
}

/// Whatever a backend ran, it ran at its defaults, too.
bool runs_at_defaults(const OrderedRows& ordered) {
  return std::all_of(ordered.problems.begin(), ordered.problems.end(), [&](const Problem& problem) {
    return std::all_of(ordered.backends.begin(), ordered.backends.end(), [&](const std::string& backend) {
      const Row* row = ordered.representative(problem, backend);
      return !row || ordered.is_default(*row);
    });
  });
}

/// Verdicts by backend, those columns only that occur.
void print_counts(std::ostream& out, const OrderedRows& ordered, int terminal_width, bool colour) {
  std::array<bool, verdict_count> occurs{};
  for (const Row& row : ordered.rows) occurs[static_cast<std::size_t>(row.verdict())] = true;
  std::vector<TextColumn> columns{{"backend", false, true}, {"cells", true, false}};
  for (std::size_t v = 0; v < verdict_count; ++v) {
    if (occurs[v]) columns.push_back({verdict_prose(static_cast<Verdict>(v)), true, false});
  }
  TextTable table(columns);
  for (const std::string& backend : ordered.backends) {
    std::array<int, verdict_count> count{};
    int cells = 0;
    for (const Row& row : ordered.rows) {
      if (row.backend != backend) continue;
      ++count[static_cast<std::size_t>(row.verdict())];
      ++cells;
    }
    std::vector<TextCell> line{{printable(backend)}, {std::to_string(cells)}};
    for (std::size_t v = 0; v < verdict_count; ++v) {
      if (!occurs[v]) continue;
      if (count[v] > 0) {
        line.push_back({std::to_string(count[v]), colour_of(static_cast<Verdict>(v))});
      } else {
        line.push_back({std::string(no_value), dim});
      }
    }
    table.add(std::move(line));
  }
  table.print(out, terminal_width, colour);
}

/// What a comparison's cell says of its error: of the worst metric, so that the number explains the verdict.
std::string error_text(const Row& row) {
  const MetricResult* worst = row.worst();
  if (!row.completed() || !worst) return "";
  return worst->error ? short_number(*worst->error, 2) : "not finite";
}

void print_block_of_backends(std::ostream& out, const OrderedRows& ordered, const std::vector<std::string>& backends,
                             int terminal_width, bool colour) {
  std::vector<TextColumn> columns{{"scene", false, true}};
  for (const std::string& backend : backends) {
    columns.push_back({printable(backend), false, false});
    columns.push_back({"error", true, false});
    columns.push_back({"ms/step", true, false});
  }
  TextTable table(columns);
  for (const Problem& problem : ordered.problems) {
    std::vector<TextCell> line{{printable(problem.title())}};
    for (const std::string& backend : backends) {
      const Row* row = ordered.representative(problem, backend);
      if (!row) {
        line.insert(line.end(), {{std::string(no_value), dim}, {}, {}});
        continue;
      }
      line.push_back(
          {verdict_prose(row->verdict()) + (ordered.is_default(*row) ? "" : "*"), colour_of(row->verdict())});
      line.push_back({error_text(*row)});
      line.push_back({ms_text(*row), dim});
    }
    table.add(std::move(line));
  }
  table.print(out, terminal_width, colour);
}

/// Why cells did not come through, a line each.
void print_reasons(std::ostream& out, const OrderedRows& ordered, int terminal_width, bool colour) {
  TextTable table({{"scene", false, false}, {"backend", false, false}, {"why not", false, true}});
  bool any = false;
  for (const Problem& problem : ordered.problems) {
    for (const std::string& backend : ordered.backends) {
      const Row* row = ordered.representative(problem, backend);
      if (!row || row->completed() || row->reason.empty()) continue;
      table.add({{printable(problem.title())}, {printable(backend)}, {printable(row->reason)}});
      any = true;
    }
  }
  if (!any) return;
  table.print(out, terminal_width, colour);
  out << '\n';
}

/// Columns of a terminal; of none, as many as a text may have.
std::size_t width_or_all(int terminal_width) {
  return terminal_width <= 0 ? std::string::npos : static_cast<std::size_t>(terminal_width);
}

void print_machine(std::ostream& out, const OrderedRows& ordered, int terminal_width, bool colour) {
  // A block of backends a table: name or verdict, error, time need about 30 columns each, the scene about 20.
  constexpr int scene_width = 20, backend_width = 30;
  const std::size_t at_once =
      terminal_width <= 0 ? ordered.backends.size()
                          : static_cast<std::size_t>(std::max(1, (terminal_width - scene_width) / backend_width));
  for (std::size_t first = 0; first < ordered.backends.size(); first += at_once) {
    const auto begin = ordered.backends.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end =
        ordered.backends.begin() + static_cast<std::ptrdiff_t>(std::min(first + at_once, ordered.backends.size()));
    print_block_of_backends(out, ordered, {begin, end}, terminal_width, colour);
    out << '\n';
  }
  print_legend(out, ordered);
  if (!runs_at_defaults(ordered)) out << "*: it ran with other settings than\nits own only.\n";
  print_reasons(out, ordered, terminal_width, colour);
  print_counts(out, ordered, terminal_width, colour);
}

}  // namespace

void print_table(std::ostream& out, const std::vector<Row>& rows, int terminal_width, bool colour) {
  const OrderedRows ordered(rows);
  const bool with_configuration =
      std::any_of(ordered.rows.begin(), ordered.rows.end(), [&](const Row& row) { return !ordered.is_default(row); });
  std::vector<TextColumn> columns{{"scene", false, false}, {"backend", false, false}};
  if (with_configuration) columns.push_back({"settings", false, true});
  columns.insert(columns.end(), {{"result", false, false}, {"ms/step", true, false}, {"worst metric", false, true}});
  TextTable table(columns);
  for (const Problem& problem : ordered.problems) {
    for (const Row* row : problem.rows) {
      std::vector<TextCell> line{{printable(problem.title())}, {printable(row->backend)}};
      if (with_configuration) line.push_back({printable(ordered.configuration(*row))});
      line.push_back({verdict_prose(row->verdict()), colour_of(row->verdict())});
      line.push_back({ms_text(*row)});
      line.push_back(row->completed() ? TextCell{worst_text(*row)} : TextCell{printable(row->reason), dim});
      table.add(std::move(line));
    }
  }
  table.print(out, terminal_width, colour);
  print_legend(out, ordered);
}

void print_comparison(std::ostream& out, const std::vector<Row>& rows, int terminal_width, bool colour) {
  const std::vector<MachineRows> machines = rows_by_machine(rows);
  for (const MachineRows& machine : machines) {
    if (machines.size() > 1) out << printable(clipped(machine.name, width_or_all(terminal_width))) << '\n';
    print_machine(out, OrderedRows(machine.rows), terminal_width, colour);
    if (&machine != &machines.back()) out << '\n';
  }
}

}  // namespace plumb::harness
