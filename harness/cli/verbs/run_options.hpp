// The options that run and compare share, and what both do with them.
#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "cli/output/output.hpp"
#include "rows/row.hpp"
#include "study/plan.hpp"

namespace plumb::harness {

struct StudyOptions {
  StudyRequest request;
  OutputOptions output;
  bool strict = false;
};

/// Adds them to a verb; the defaults are those that stand in `options`, which must outlive the parsing.
void add_study_options(CLI::App& verb, StudyOptions& options);

using PrintRows = void (*)(std::ostream& out, const std::vector<Row>& rows, int terminal_width, bool colour);

/// Runs the study and prints its rows: --json each as it finishes, else all at the end by --csv or `print`. Returns the
/// exit status.
[[nodiscard]] int run_and_print(const StudyOptions& options, PrintRows print);

}  // namespace plumb::harness
