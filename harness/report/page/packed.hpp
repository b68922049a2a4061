// Markup that travels packed: tables and diagrams repeat themselves, and packed they take a tenth of the room.
#pragma once

#include <string>

namespace plumb::harness {

/// A script element with the markup in it, zlib and base64, in whose place page.js puts the markup.
[[nodiscard]] std::string packed_markup(const std::string& html);

}  // namespace plumb::harness
