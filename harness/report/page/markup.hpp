// Text made safe for HTML, SVG and scripts.
#pragma once

#include <string>
#include <string_view>

#include "run/json.hpp"

namespace plumb::harness {

/// For text and for attributes in double quotes. Newlines stay (hover titles have lines); other control characters and
/// broken UTF-8 do not.
[[nodiscard]] std::string escape_html(std::string_view text);

/// JSON that may stand inside <script>: no text in it can end the element.
[[nodiscard]] std::string script_json(const Json& value);

}  // namespace plumb::harness
