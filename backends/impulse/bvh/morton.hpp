// Morton codes: the bits of three coordinates interleaved, so that what is near in space is mostly near in order; and
// keys that order numbers as whole numbers.
#pragma once

#include <cstdint>

#include "math/real.hpp"

namespace plumb::impulse {

/// Two zero bits before each of the low 10 bits (Karras, "Thinking Parallel, Part III", 2012).
PLUMB_HD constexpr std::uint32_t expand_bits_10(std::uint32_t v) {
  v = (v * 0x00010001U) & 0xFF0000FFU;
  v = (v * 0x00000101U) & 0x0F00F00FU;
  v = (v * 0x00000011U) & 0xC30C30C3U;
  v = (v * 0x00000005U) & 0x49249249U;
  return v;
}
/// The same for the low 21 bits, by shifts.
PLUMB_HD constexpr std::uint64_t expand_bits_21(std::uint64_t v) {
  v = (v | v << 32) & 0x001F00000000FFFFU;
  v = (v | v << 16) & 0x001F0000FF0000FFU;
  v = (v | v << 8) & 0x100F00F00F00F00FU;
  v = (v | v << 4) & 0x10C30C30C30C30C3U;
  v = (v | v << 2) & 0x1249249249249249U;
  return v;
}

/// The codes that fit in a key of type K, and how many bits of the key they leave.
template <class K>
struct Morton;
template <>
struct Morton<std::uint32_t> {
  static constexpr int kAxisBits = 10, kBits = 30, kSpareBits = 2;
  PLUMB_HD static constexpr std::uint32_t code(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return expand_bits_10(x) << 2 | expand_bits_10(y) << 1 | expand_bits_10(z);
  }
};
template <>
struct Morton<std::uint64_t> {
  static constexpr int kAxisBits = 21, kBits = 63, kSpareBits = 1;
  PLUMB_HD static constexpr std::uint64_t code(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return expand_bits_21(x) << 2 | expand_bits_21(y) << 1 | expand_bits_21(z);
  }
};

/// x rounded down to a whole number in [0, cells); what is not a number goes to 0.
PLUMB_HD constexpr std::uint32_t cell_of(float x, std::uint32_t cells) {
  const auto last = static_cast<float>(cells - 1);  // exact for the 2^21 cells that there are at most
  return x > 0 ? x < last ? static_cast<std::uint32_t>(x) : cells - 1 : 0;
}

/// a < b exactly when order_key(a) < order_key(b), except that -0 < +0.
PLUMB_HD constexpr std::uint32_t order_key(float x) {
  const auto bits = __builtin_bit_cast(std::uint32_t, x);
  return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}
PLUMB_HD constexpr float from_order_key(std::uint32_t key) {
  return __builtin_bit_cast(float, (key & 0x80000000U) != 0 ? key & 0x7FFFFFFFU : ~key);
}

}  // namespace plumb::impulse
