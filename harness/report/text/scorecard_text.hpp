// The scorecard for terminals and as Markdown.
#pragma once

#include <iosfwd>
#include <vector>

#include "report/ordered/against.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

/// What the numbers of a scorecard are, in sentences without line breaks.
[[nodiscard]] const char* about_scorecard();

/// A table by group and engine, then the scenes where each engine is best and where it breaks; by machine. Nothing
/// where there is one engine only. baseline: earlier rows, whose changes get a column; null: none. terminal_width 0: as
/// wide as need be.
void print_scorecard(std::ostream& out, const std::vector<Row>& rows, const std::vector<Row>* baseline,
                     const AgainstLimits& limits, int terminal_width, bool colour);

/// The same as Markdown, below a heading of the second level.
void write_scorecard_markdown(std::ostream& out, const std::vector<Row>& rows, const std::vector<Row>* baseline,
                              const AgainstLimits& limits);

}  // namespace plumb::harness
