// What tables for terminals say of a row, each in a word or a number.
#pragma once

#include <string>

#include "rows/row.hpp"

namespace plumb::harness {

inline constexpr const char* dim = "2";  ///< ANSI: what matters less

/// ANSI colour of a verdict; "" for none.
[[nodiscard]] const char* colour_of(Verdict verdict);
/// "out of memory": the word as prose has it.
[[nodiscard]] std::string verdict_prose(Verdict verdict);
/// Milliseconds a step, in brackets where they were measured on a contended machine; "" without any.
[[nodiscard]] std::string ms_text(const Row& row);

}  // namespace plumb::harness
