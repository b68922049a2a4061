// What makes a line of a results file a row that this program may read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/json.hpp"

namespace plumb::harness {

/// What rows say under "format". It grows when a key that was there means something else, or is gone.
inline constexpr int row_format = 1;

/// The row in line `number` (from 1) of a file; null where the line is no object, as a kill may leave one. Throws
/// Error(PLUMB_E_CORRUPT) "FILE:LINE: ..." for objects that are no row, and for rows of other formats.
[[nodiscard]] Json read_row(const std::string& line, const std::filesystem::path& file, std::size_t number);

}  // namespace plumb::harness
