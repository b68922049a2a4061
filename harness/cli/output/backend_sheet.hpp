// All that a backend says of itself, for a terminal.
#pragma once

#include <string>

#include "cell/description.hpp"

namespace plumb::harness {

/// Who it is, its settings with unit, range, default, role and doc, and its capabilities with their degrees and notes.
[[nodiscard]] std::string backend_sheet(const BackendDescription& backend, std::size_t width);

}  // namespace plumb::harness
