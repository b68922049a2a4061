// Results as comma-separated values, for spreadsheets and data frames.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

/// A header, then one line a cell and metric (one for a cell without metrics), RFC 4180 with LF. Numbers keep all
/// digits; what was not finite or not there is empty. `contended` says why times of the cell do not count, and leaves
/// ms_per_simulated_second empty; `needs` is "scene" unless more was declared than the scene needs. params, settings
/// and machine are JSON in one field.
void write_csv(std::ostream& out, const std::vector<Row>& rows);

/// A field, quoted where RFC 4180 asks for it. Text that a spreadsheet would run as a formula gets a leading
/// apostrophe.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace plumb::harness
