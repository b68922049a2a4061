// Numbers that are not negative as whole numbers of the same order, for atomic operations (exec/atomic.hpp): bits of a
// float.
#pragma once

#include <cstdint>

#include "math/real.hpp"

namespace plumb::impulse {

/// Of the infinite float. What is not finite comes last.
constexpr std::uint32_t kNotFinite = 0x7f800000U;

PLUMB_HD inline std::uint32_t ordered_bits(Real x) {
  return is_finite(x) ? __builtin_bit_cast(std::uint32_t, static_cast<float>(x)) : kNotFinite;
}
PLUMB_HD inline Real number_of(std::uint32_t bits) { return static_cast<Real>(__builtin_bit_cast(float, bits)); }
PLUMB_HD inline bool is_finite_number(std::uint32_t bits) { return bits < kNotFinite; }

}  // namespace plumb::impulse
