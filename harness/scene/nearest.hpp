// The nearest right word to a misspelt one, for error messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::harness {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn a into b, letter case aside (optimal
/// string alignment: Damerau 1964 without editing a swapped pair again).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known word with the smallest edit distance, of several the one that begins most alike; "" when none is close
/// enough to be meant.
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// Ends an error message: `; did you mean "x"?`, or `; known are a, b, c` when nothing is near, or "" without any.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace plumb::harness
