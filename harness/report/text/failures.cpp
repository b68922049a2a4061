#include "report/text/failures.hpp"

#include <algorithm>
#include <ostream>

#include "base/format.hpp"
#include "report/findings/facts.hpp"
#include "report/findings/overview.hpp"
#include "report/ordered/machine_rows.hpp"
#include "report/text/markdown.hpp"

namespace plumb::harness {
namespace {

void write_rows(std::ostream& out, const std::vector<const Row*>& rows) {
  for (const Row* row : rows) {
    std::string word(verdict_word(row->verdict()));
    std::replace(word.begin(), word.end(), '_', ' ');
    out << "| " << markdown_text(row_title(*row)) << " | " << word << " | " << markdown_text(row->missed()) << " |\n";
  }
}

void write_backend(std::ostream& out, const BackendOverview& overview) {
  out << "\n### " << markdown_text(overview.backend) << ' ' << markdown_text(overview.version) << "\n\n"
      << markdown_text(describe_counts(overview)) << "\n\n";
  if (overview.lost.empty() && overview.unsupported.empty() && overview.unjudged.empty()) return;
  out << "| scene variant | result | misses |\n|---|---|---|\n";
  for (const auto* rows : {&overview.lost, &overview.unsupported, &overview.unjudged}) write_rows(out, *rows);
}

}  // namespace

void write_failures(std::ostream& out, const std::vector<Row>& rows) {
  out << "# What fails at the defaults\n\n"
         "Made by `plumb report DIR --failures` from the rows beside it: every scene variant that an engine "
         "does not pass at its own defaults, and what it misses there (error > threshold; by most first).\n";
  for (const MachineRows& machine : rows_by_machine(rows)) {
    const OrderedRows ordered(machine.rows);
    out << "\n## " << markdown_text(machine.name) << '\n';
    for (const BackendOverview& overview : overviews(ordered, {})) write_backend(out, overview);
  }
}

}  // namespace plumb::harness
