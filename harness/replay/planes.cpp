#include "replay/planes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace plumb::harness {

namespace {

constexpr int bits_of_mantissa = 23;
constexpr std::uint32_t sign_bit = 0x80000000u;

std::uint32_t zigzag(std::int32_t number) {
  return static_cast<std::uint32_t>(number) << 1 ^ static_cast<std::uint32_t>(number >> 31);
}

}  // namespace

Planes planes_of(const std::vector<std::int32_t>& numbers) {
  std::uint32_t used = 0;
  for (const std::int32_t number : numbers) used |= zigzag(number);
  Planes planes;
  planes.count = std::max(1u, (static_cast<std::uint32_t>(std::bit_width(used)) + 7) / 8);
  planes.bytes.reserve(planes.count * numbers.size());
  for (std::uint32_t plane = 0; plane < planes.count; ++plane)
    for (const std::int32_t number : numbers) planes.bytes += static_cast<char>(zigzag(number) >> (8 * plane) & 0xff);
  return planes;
}

int bits_of(std::int32_t number) { return static_cast<int>(std::bit_width(zigzag(number))); }

std::int32_t rounded_float(float value, int mantissa_bits, float least) {
  if (std::abs(value) < least) return 0;
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const int dropped = bits_of_mantissa - mantissa_bits;
  const std::uint32_t half = dropped > 0 ? 1u << (dropped - 1) : 0;
  const std::uint32_t magnitude = std::isfinite(value) ? (bits & ~sign_bit) + half : bits & ~sign_bit;
  const auto number = static_cast<std::int32_t>(magnitude >> dropped);
  return (bits & sign_bit) != 0 ? -number : number;
}

}  // namespace plumb::harness
