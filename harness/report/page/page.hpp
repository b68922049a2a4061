// The report as one HTML file without network: words as HTML, tables and diagrams as data that its script draws.
#pragma once

#include <iosfwd>
#include <vector>

#include "report/page/parts/page_options.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

void write_page(std::ostream& out, const std::vector<Row>& rows, const PageOptions& options);

}  // namespace plumb::harness
