// The options that run, compare and curves share, some of them with duel, and what the three do with them.
#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "cli/output/output.hpp"
#include "rows/row.hpp"
#include "schedule/plan.hpp"

namespace plumb::harness {

struct RunOptions {
  RunRequest request;
  OutputOptions output;
  bool strict = false;
};

/// Adds those of every cell alike, whatever runs it: parameters, step, times, repetitions, limits. The defaults are
/// those that stand in `request`, which must outlive the parsing.
void add_cell_options(CLI::App& verb, RunRequest& request);

/// Likewise which backends, and with what settings.
void add_backend_options(CLI::App& verb, RunRequest& request);

/// Adds them to a verb; the defaults are those that stand in `options`, which must outlive the parsing.
void add_run_options(CLI::App& verb, RunOptions& options);

using PrintRows = void (*)(std::ostream& out, const std::vector<Row>& rows, int terminal_width, bool colour);

/// Runs what was asked and prints its rows: --json each as it finishes, else all at the end by --csv or `print`.
/// Returns the exit status.
[[nodiscard]] int run_and_print(const RunOptions& options, PrintRows print);

}  // namespace plumb::harness
