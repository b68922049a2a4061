// Units of parameters: which exist, and how a value given in one becomes a value in another.
#pragma once

#include <string>
#include <string_view>

namespace plumb::harness {

/// Whether a text is a unit: "1", "%", or names of units with powers, spaces between factors and / before divisors:
/// "m", "kg m2/s2", "rad/s".
[[nodiscard]] bool is_unit(std::string_view text);

/// The factor that turns a value in `from` into a value in `to`. Throws std::invalid_argument, with the nearest unit,
/// when one is unknown or the two do not measure the same thing.
[[nodiscard]] double conversion(const std::string& from, const std::string& to);

}  // namespace plumb::harness
