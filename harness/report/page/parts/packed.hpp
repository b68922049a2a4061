// Data on the page that only its script reads: JSON, deflated, as base64.
#pragma once

#include <string>

#include "base/json.hpp"

namespace plumb::harness {

/// <script class="packed"> with a section's blocks; "" where the program was built without the script that draws them.
[[nodiscard]] std::string packed_blocks(const Json& blocks);

}  // namespace plumb::harness
