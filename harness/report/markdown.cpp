#include "report/markdown.hpp"

#include <fmt/format.h>

#include <ostream>

#include "report/answers.hpp"
#include "report/cost.hpp"
#include "report/format.hpp"
#include "report/overview.hpp"
#include "report/study.hpp"

namespace plumb::harness {
namespace {

void write_header(std::ostream& out, const std::vector<std::string>& names, const std::string& alignment) {
  out << '|';
  for (const std::string& name : names) out << ' ' << markdown_text(name) << " |";
  out << "\n|";
  for (const char c : alignment) out << (c == 'r' ? "---:|" : "---|");
  out << '\n';
}

std::string matrix_cell(const ResultRow* row) {
  if (!row) return std::string(no_value);
  std::string word(verdict_word(row->verdict()));
  if (!row->completed()) return row->reason.empty() ? word : word + ": " + row->reason;
  const MetricResult* worst = row->worst();
  if (!worst) return word;
  return word + ", " + worst->name + " " + (worst->error ? short_number(*worst->error) : "not finite");
}

void write_answers(std::ostream& out, const Study& study, const std::vector<CostLine>& costs) {
  const std::vector<AnsweredQuestion> all = answers(study, costs);
  if (all.empty()) return;
  out << "## Answers\n\n";
  for (const AnsweredQuestion& answer : all) {
    out << "**" << markdown_text(answer.question) << "** " << markdown_text(answer.verdict) << "\n\n";
    for (const AnswerLine& line : answer.lines)
      out << "- " << markdown_text(line.backend) << ": " << markdown_text(line.statement.text) << '\n';
    out << '\n';
  }
}

void write_matrix(std::ostream& out, const Study& study) {
  out << "## Scenes\n\nEach cell: verdict and error of the worst metric, at the backend's defaults.\n\n";
  std::vector<std::string> names{"scene"};
  names.insert(names.end(), study.backends.begin(), study.backends.end());
  write_header(out, names, std::string(names.size(), 'l'));
  for (const Problem& problem : study.problems) {
    out << "| " << markdown_text(problem.title()) << " |";
    for (const std::string& backend : study.backends) {
      out << ' ' << markdown_text(matrix_cell(study.representative(problem, backend))) << " |";
    }
    out << '\n';
  }
}

void write_costs(std::ostream& out, const Study& study, const std::vector<CostLine>& costs) {
  out << "\n## What accuracy costs\n\nMilliseconds per simulated second of the cheapest cell that reaches the "
         "error.\n\n";
  write_header(out, {"scene, metric", "backend", "10 %", "1 %", "0.1 %", "floor", "settings at the floor"}, "llrrrrl");
  for (const CostLine& line : costs) {
    out << "| " << markdown_text(line.problem->title() + " " + line.metric) << " | " << markdown_text(line.backend)
        << " |";
    for (const auto& reached : line.at) {
      out << ' ' << (reached ? short_number(reached->ms) : line.floor ? "never" : std::string(no_value)) << " |";
    }
    if (line.floor) {
      out << ' ' << short_number(line.floor->error) << " @ " << short_number(line.floor->ms) << " | "
          << markdown_text(study.configuration(*line.floor->row)) << " |\n";
    } else {
      out << ' ' << markdown_text(std::string(verdict_word(line.representative->verdict()))) << " | |\n";
    }
  }
}

void write_times(std::ostream& out, const Study& study) {
  out << "\n## Times\n\nMilliseconds per step (median), at the backend's defaults.\n\n";
  std::vector<std::string> names{"scene", "bodies"};
  names.insert(names.end(), study.backends.begin(), study.backends.end());
  std::string alignment(names.size(), 'r');
  alignment.front() = 'l';
  write_header(out, names, alignment);
  for (const Problem& problem : study.problems) {
    std::string cells, bodies(no_value);
    bool any = false;
    for (const std::string& backend : study.backends) {
      const ResultRow* row = study.representative(problem, backend);
      any = any || (row && row->fair_ms());
      cells += fmt::format(" {} |", row ? short_number(row->fair_ms()) : std::string(no_value));
      if (row && row->bodies) bodies = shortest_number(*row->bodies);
    }
    if (any) out << "| " << markdown_text(problem.title()) << " | " << bodies << " |" << cells << '\n';
  }
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

void write_markdown(std::ostream& out, const std::vector<Json>& rows) {
  const Study study(parse_rows(rows));
  out << "# Plumb report\n\n";
  out << markdown_text(describe_study(study)) << "\n\n";
  for (const std::string& machine : describe_machines(study)) out << markdown_text(machine) << "\n\n";
  const std::vector<CostLine> costs = cost_of_accuracy(study);
  for (const BackendOverview& overview : overviews(study, costs)) {
    out << "- **" << markdown_text(overview.backend) << "** " << markdown_text(overview.version) << ": "
        << markdown_text(describe_backend(overview, study.backends.size() == 1)) << '\n';
  }
  out << '\n';
  write_answers(out, study, costs);
  write_matrix(out, study);
  write_costs(out, study, costs);
  write_times(out, study);
}

}  // namespace plumb::harness
