// Checks of options that are numbers, in the program's own words: the parser's tell the limits of machine numbers, and
// let through what is not a number. The parser puts the option's name before them.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "base/shown.hpp"
#include "scene/expressions.hpp"

namespace plumb::harness {

/// Takes what `is_right` says of the number that the parser will make of the text. `kind` is for help, behind the type.
template <class Number>
[[nodiscard]] CLI::Validator number_that(const std::string& wanted, const std::string& kind,
                                         std::function<bool(Number)> is_right) {
  return CLI::Validator(
      [wanted, is_right](std::string& text) {
        Number number{};
        if (CLI::detail::lexical_cast(text, number) && is_right(number)) return std::string();
        return fmt::format("must be {}, not \"{}\"", wanted, shortened(text));
      },
      kind);
}

[[nodiscard]] inline CLI::Validator number_above_0() {
  return number_that<double>("a number above 0", "POSITIVE", [](double x) { return x > 0 && std::isfinite(x); });
}

[[nodiscard]] inline CLI::Validator number_from_0() {
  return number_that<double>("a number of 0 or more", "NONNEGATIVE",
                             [](double x) { return x >= 0 && std::isfinite(x); });
}

[[nodiscard]] inline CLI::Validator number_within(double least, double most) {
  return number_that<double>(fmt::format("a number from {} to {}", least, most), fmt::format("{}..{}", least, most),
                             [=](double x) { return x >= least && x <= most; });
}

/// Of unsigned numbers: the parser would take -1 for a large one.
[[nodiscard]] inline CLI::Validator whole_number_within(std::int64_t least, std::int64_t most) {
  return number_that<std::int64_t>(fmt::format("a whole number from {} to {}", least, most),
                                   fmt::format("{}..{}", least, most),
                                   [=](std::int64_t n) { return n >= least && n <= most; });
}

/// A number as scene files may write it, "1/240", as one that the parser of options reads: for transform().
[[nodiscard]] inline std::string evaluated(const std::string& text) {
  try {
    return fmt::format("{}", Expressions().evaluate(text));
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(error.what());
  }
}

}  // namespace plumb::harness
