// Whole numbers that are mostly near zero as bytes that zlib makes small, and how floats become such numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plumb::harness {

/// Each number zigzagged (0 -1 1 -2 to 0 1 2 3), then the low bytes of all, the second bytes of all and so on.
struct Planes {
  std::uint32_t count = 1;  ///< of bytes a number, as many as the largest needs
  std::string bytes;
};
[[nodiscard]] Planes planes_of(const std::vector<std::int32_t>& numbers);

/// Bits that the number takes in them: what a choice between predictions goes by.
[[nodiscard]] int bits_of(std::int32_t number);

/// A float as sign and magnitude with so many bits of its mantissa (0 to 23, which loses nothing), rounded: as whole
/// numbers, floats of a sign are in their order. Below `least` it is 0.
[[nodiscard]] std::int32_t rounded_float(float value, int mantissa_bits, float least);

}  // namespace plumb::harness
