// Results as GitHub-flavoured Markdown, for issues and pull requests.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

/// What was compared, the pass matrix, the cost-of-accuracy table and the times.
void write_markdown(std::ostream& out, const std::vector<Row>& rows);

/// Text for a table's cell: nothing in it is taken as Markdown or HTML, and it stays on one line.
[[nodiscard]] std::string markdown_text(std::string_view text);

}  // namespace plumb::harness
