// Text laid out for a terminal: what a verb tells of one thing, as headed lists of names and sentences.
#pragma once

#include <cstddef>
#include <string>

namespace plumb::harness {

/// What most lists leave for names.
inline constexpr std::size_t name_columns = 20;

/// Columns for such a text: those of the terminal, within what reads well; 100 where there is none.
[[nodiscard]] std::size_t text_width();

/// `text` broken at blanks into lines of at most `width` columns, each after `indent` blanks; the first line is taken
/// to begin behind `used` columns (at least `indent`). A word that is longer than a line is not broken. No line break
/// at the end.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t indent, std::size_t width, std::size_t used = 0);

/// "  name      text", the text broken and indented under itself; a name that is too long has a line of its own.
[[nodiscard]] std::string entry(const std::string& name, const std::string& text, std::size_t name_width,
                                std::size_t width);

}  // namespace plumb::harness
