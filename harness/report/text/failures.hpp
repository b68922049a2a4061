// What fails as it ships: every problem that an engine does not pass at its defaults, as Markdown that is kept beside
// the results it was made from.
#pragma once

#include <iosfwd>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

/// For each machine and engine the counts of verdicts, then a line a problem with what it misses. The same text for the
/// same rows.
void write_failures(std::ostream& out, const std::vector<Row>& rows);

}  // namespace plumb::harness
