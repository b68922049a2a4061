// Results as tables for a terminal.
#pragma once

#include <iosfwd>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

/// What `run` prints: a line a cell with its verdict, time and worst metric, or the reason why it did not run. Rows are
/// objects of the command line's JSON contract. terminal_width in columns (0: unlimited, for a pipe); lines never
/// exceed it as long as it is at least 40. colour: ANSI colours, for terminals only.
void print_table(std::ostream& out, const std::vector<Row>& rows, int terminal_width, bool colour);

/// What `compare` prints: a line a scene and variant, a column a backend with verdict, worst error and ms per step;
/// then why cells did not come through, and the count of each verdict by backend. Backends that do not fit in the width
/// go into further tables.
void print_comparison(std::ostream& out, const std::vector<Row>& rows, int terminal_width, bool colour);

}  // namespace plumb::harness
