// Bytes made smaller with zlib (RFC 1950), which a browser opens with DecompressionStream("deflate").
#pragma once

#include <string>
#include <string_view>

namespace plumb::harness {

[[nodiscard]] std::string deflated(std::string_view bytes);

/// What `deflated` was given. Throws Error(PLUMB_E_CORRUPT) for anything else.
[[nodiscard]] std::string inflated(std::string_view packed);

}  // namespace plumb::harness
