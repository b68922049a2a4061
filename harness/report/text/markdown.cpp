#include "report/text/markdown.hpp"

#include <fmt/format.h>

#include <ostream>

#include "base/format.hpp"
#include "report/findings/answers.hpp"
#include "report/findings/overview.hpp"
#include "report/ordered/cost.hpp"
#include "report/ordered/default_run.hpp"
#include "report/ordered/machine_rows.hpp"
#include "report/ordered/ordered_rows.hpp"
#include "report/text/scorecard_text.hpp"

namespace plumb::harness {
namespace {

constexpr const char* dagger = "\u2020";

void write_header(std::ostream& out, const std::vector<std::string>& names, const std::string& alignment) {
  out << '|';
  for (const std::string& name : names) out << ' ' << markdown_text(name) << " |";
  out << "\n|";
  for (const char c : alignment) out << (c == 'r' ? "---:|" : "---|");
  out << '\n';
}

std::string matrix_cell(const Row* row) {
  if (!row) return std::string(no_value);
  std::string word(verdict_word(row->verdict()));
  if (!row->completed()) return row->reason.empty() ? word : word + ": " + row->reason;
  const MetricResult* worst = row->worst();
  if (!worst) return word;
  return word + ", " + worst->name + " " + (worst->error ? short_number(*worst->error) : "not finite");
}

void write_answers(std::ostream& out, const OrderedRows& ordered, const std::vector<CostLine>& costs) {
  const std::vector<AnsweredQuestion> all = answers(ordered, costs);
  if (all.empty()) return;
  out << "## Answers\n\n";
  for (const AnsweredQuestion& answer : all) {
    out << "**" << markdown_text(answer.question) << "** " << markdown_text(answer.verdict) << "\n\n";
    for (const AnswerLine& line : answer.lines) {
      out << "- " << markdown_text(line.backend) << ": ";
      for (const Statement& statement : line.statements)
        out << (&statement == line.statements.data() ? "" : "; ") << markdown_text(statement.text);
      out << '\n';
    }
    out << '\n';
  }
}

void write_matrix(std::ostream& out, const OrderedRows& ordered) {
  out << "## Scenes\n\nEach cell: verdict and error of the worst metric, at the backend's defaults, or "
         "with the settings in brackets where it ran with others only.\n\n";
  std::vector<std::string> names{"scene"};
  names.insert(names.end(), ordered.backends.begin(), ordered.backends.end());
  write_header(out, names, std::string(names.size(), 'l'));
  for (const Problem& problem : ordered.problems) {
    out << "| " << markdown_text(problem.title()) << " |";
    for (const std::string& backend : ordered.backends) {
      const Row* row = ordered.representative(problem, backend);
      const bool other = row && !ordered.is_default(*row);
      out << ' ' << markdown_text(matrix_cell(row) + (other ? " (" + ordered.configuration(*row) + ")" : "")) << " |";
    }
    out << '\n';
  }
}

std::string ms_text(const Reached& reached) {
  const std::string ms = !reached.ms ? "not timed" : (reached.untimed > 0 ? "\u2264 " : "") + short_number(*reached.ms);
  return ms + (reached.row->passes() ? "" : dagger);
}

void write_costs(std::ostream& out, const OrderedRows& ordered, const std::vector<CostLine>& costs) {
  out << "\n## What accuracy costs\n\nMilliseconds per simulated second of the cheapest cell that reaches the error "
         "and "
         "passes its scene; "
      << dagger
      << " where only cells that miss a threshold do; not timed, \u2264: measured on a contended machine.\n\n";
  write_header(out, {"scene, metric", "backend", "10 %", "1 %", "0.1 %", "floor", "settings at the floor"}, "llrrrrl");
  for (const CostLine& line : costs) {
    out << "| " << markdown_text(line.problem->title() + " " + line.metric) << " | " << markdown_text(line.backend)
        << " |";
    for (std::size_t t = 0; t < target_errors.size(); ++t) {
      const auto& reached = line.at[t] ? line.at[t] : line.failing[t];
      out << ' ' << (reached ? ms_text(*reached) : line.floor ? "never" : std::string(no_value)) << " |";
    }
    if (line.floor) {
      out << ' ' << short_number(line.floor->error) << " @ " << ms_text(*line.floor) << " | "
          << markdown_text(ordered.configuration(*line.floor->row)) << " |\n";
    } else {
      out << ' ' << markdown_text(std::string(verdict_word(line.representative->verdict()))) << " | |\n";
    }
  }
}

void write_times(std::ostream& out, const OrderedRows& ordered) {
  out << "\n## Times\n\nMilliseconds per step (median), at the backend's defaults; " << dagger
      << " where the run misses a threshold.\n\n";
  std::vector<std::string> names{"scene", "bodies"};
  names.insert(names.end(), ordered.backends.begin(), ordered.backends.end());
  std::string alignment(names.size(), 'r');
  alignment.front() = 'l';
  write_header(out, names, alignment);
  for (const Problem& problem : ordered.problems) {
    std::string cells, bodies(no_value);
    bool any = false;
    for (const std::string& backend : ordered.backends) {
      const Row* row = default_run(ordered, problem, backend);
      const bool timed = row && row->completed() && row->fair_ms();
      any = any || timed;
      cells += fmt::format(" {}{} |", timed ? short_number(row->fair_ms()) : std::string(no_value),
                           timed && !row->passes() ? dagger : "");
      if (row && row->counts.bodies) bodies = shortest_number(*row->counts.bodies);
    }
    if (any) out << "| " << markdown_text(problem.title()) << " | " << bodies << " |" << cells << '\n';
  }
}

void write_machine(std::ostream& out, const OrderedRows& ordered) {
  out << markdown_text(describe_study(ordered)) << "\n\n";
  for (const std::string& machine : describe_machines(ordered)) out << markdown_text(machine) << "\n\n";
  const std::vector<CostLine> costs = cost_of_accuracy(ordered);
  for (const BackendOverview& overview : overviews(ordered, costs)) {
    out << "- **" << markdown_text(overview.backend) << "** " << markdown_text(overview.version) << ": "
        << markdown_text(describe_backend(overview, ordered.backends.size() == 1)) << '\n';
  }
  out << '\n';
  write_answers(out, ordered, costs);
  write_matrix(out, ordered);
  write_costs(out, ordered, costs);
  write_times(out, ordered);
}

}  // namespace

std::string markdown_text(std::string_view text) {
  std::string out;
  for (const char c : printable(text)) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '\\':
      case '|':
      case '`':
      case '*':
      case '_':
      case '[':
      case ']':
      case '~':
      case '#':
      case '!':
      case '$':
        out += '\\';
        out += c;
        break;
      case '@': out += "&#64;"; break;  // would notify whoever has that name
      default: out += c;
    }
  }
  return out;
}

void write_markdown(std::ostream& out, const std::vector<Row>& rows) {
  const std::vector<MachineRows> machines = rows_by_machine(rows);
  out << "# Plumb report\n";
  write_scorecard_markdown(out, rows, nullptr, {});
  for (const MachineRows& machine : machines) {
    out << '\n';
    if (machines.size() > 1) out << "# " << markdown_text(machine.name) << "\n\n";
    write_machine(out, OrderedRows(machine.rows));
  }
}

}  // namespace plumb::harness
