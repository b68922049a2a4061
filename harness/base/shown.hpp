// Texts from outside as messages show them: one line, not too long, nothing that a terminal obeys.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace plumb::harness {

/// The text with control characters as \\x1b; of a long one the beginning, and how long it is.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most = 60);

/// Whether some character, the end of a line too, is one that a terminal obeys.
[[nodiscard]] bool has_control_characters(std::string_view text);

}  // namespace plumb::harness
