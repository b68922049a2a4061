// Bytes as text that may stand in a page or a URI (RFC 4648, section 4).
#pragma once

#include <string>
#include <string_view>

namespace plumb::harness {

[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace plumb::harness
