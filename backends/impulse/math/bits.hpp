// Bits of a whole number: how many, and zeros at its ends. Of the standard library's functions nvcc makes device code
// without a word that takes every number for 0 (the compiler's builtins behind them have no meaning there), so kernels
// use these.
#pragma once

#include <bit>
#include <cstdint>

#include "math/real.hpp"

namespace plumb::impulse {

/// Of a number that is not 0.
PLUMB_HD inline int leading_zeros(std::uint32_t x) {
#if defined(__CUDA_ARCH__)
  return __clz(static_cast<int>(x));
#else
  return std::countl_zero(x);
#endif
}
/// Of a number that is not 0.
PLUMB_HD inline int leading_zeros(std::uint64_t x) {
#if defined(__CUDA_ARCH__)
  return __clzll(static_cast<long long>(x));
#else
  return std::countl_zero(x);
#endif
}
/// Of a number that is not 0.
PLUMB_HD inline int trailing_zeros(std::uint64_t x) {
#if defined(__CUDA_ARCH__)
  return __ffsll(static_cast<long long>(x)) - 1;
#else
  return std::countr_zero(x);
#endif
}
PLUMB_HD inline int bit_count(std::uint64_t x) {
#if defined(__CUDA_ARCH__)
  return __popcll(x);
#else
  return std::popcount(x);
#endif
}

}  // namespace plumb::impulse
