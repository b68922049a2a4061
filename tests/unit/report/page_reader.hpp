// The page with what is packed in it opened: blocks of sections stand there as JSON.
#pragma once

#include <string>
#include <vector>

#include "report/page/page.hpp"
#include "rows/row.hpp"

namespace plumb::harness::testing {

/// As it is written to a file.
[[nodiscard]] std::string packed_page(const std::vector<Row>& rows, PageOptions options = {});
[[nodiscard]] std::string page_of(const std::vector<Row>& rows, PageOptions options = {});

/// The blocks of each section that travels packed.
[[nodiscard]] std::vector<Json> packed_data(const std::vector<Row>& rows, PageOptions options = {});

/// How often `what` stands in the text.
[[nodiscard]] std::size_t count(const std::string& text, const std::string& what);

}  // namespace plumb::harness::testing
