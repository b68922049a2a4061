// Numbers as people read them, the same in every report.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/json.hpp"

namespace plumb::harness {

inline constexpr std::string_view no_value = "\u2013";  ///< an en dash: nothing to show

/// `digits` significant digits without trailing noise: 0.0123, 4.52, 1,240 is 1240, 3.1e-5. Not finite: "nan", "inf",
/// "-inf".
[[nodiscard]] std::string short_number(double value, int digits = 3);
[[nodiscard]] std::string short_number(std::optional<double> value, int digits = 3);

/// A number that somebody chose, such as a threshold: 0.01, not 0.0100.
[[nodiscard]] std::string limit_text(double value);

/// The fewest digits that read back as the same double.
[[nodiscard]] std::string shortest_number(double value);

/// A parameter's or setting's value as text: 50, 0.5, true, implicit.
[[nodiscard]] std::string value_text(const Json& value);

/// A time step as a fraction of a second where it is one: 1/60, 1/240, else 0.0123.
[[nodiscard]] std::string dt_text(std::optional<double> dt);

/// A ratio with a times sign: 1.00x, 12.4x, 1800x.
[[nodiscard]] std::string ratio_text(double ratio);

/// Columns that UTF-8 text fills on a terminal, each code point taken as one.
[[nodiscard]] std::size_t text_width(std::string_view text);
/// The text cut to `width` columns, its last one an ellipsis where something was cut.
[[nodiscard]] std::string clipped(std::string_view text, std::size_t width);

/// Control characters, which could move a cursor or tear a line, replaced by spaces; broken UTF-8 by U+FFFD.
[[nodiscard]] std::string printable(std::string_view text);

/// Order for people: A2 before A10, then by the rest of the text.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

}  // namespace plumb::harness
