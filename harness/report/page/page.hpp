// The report as one HTML file without network: words as HTML, tables and diagrams as data that its script draws.
#pragma once

#include <iosfwd>
#include <vector>

#include "base/json.hpp"
#include "report/page/parts/page_options.hpp"

namespace plumb::harness {

void write_page(std::ostream& out, const std::vector<Json>& rows, const PageOptions& options);

}  // namespace plumb::harness
