// Text made safe for HTML.
#pragma once

#include <string>
#include <string_view>

namespace plumb::harness {

/// For text and for attributes in double quotes. Newlines stay (hover titles have lines); other control characters and
/// broken UTF-8 do not.
[[nodiscard]] std::string escape_html(std::string_view text);

}  // namespace plumb::harness
