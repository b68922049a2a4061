// Sixteen neighbouring bytes that threads of a GPU give each other: read whole and written whole.
//
// To CUDA's memory model a vector of four floats is four accesses, in any order; a number of 128 bits is one (PTX ISA
// 8.3 and later, "Memory Consistency Model", scalar data types). Relaxed, in the scope of the device: such accesses
// meet in the memory that all multiprocessors share, and order nothing else.
#pragma once

#include <cstdint>

#include "math/real.hpp"

namespace plumb::impulse {

/// Whether there are such accesses: nvcc knows them from 12.3 on.
#if defined(__CUDACC__) && defined(__CUDACC_VER_MAJOR__)
constexpr bool kWholeQuads = __CUDACC_VER_MAJOR__ * 100 + __CUDACC_VER_MINOR__ >= 1203;
#else
constexpr bool kWholeQuads = false;
#endif

struct alignas(16) WholeQuad {
  float x, y, z;
  std::uint32_t word;
};

#if defined(__CUDACC__)
__device__ inline WholeQuad read_whole(const void* at) {
  std::uint64_t low = 0, high = 0;
  if constexpr (kWholeQuads)
    asm volatile("{ .reg .b128 quad; ld.relaxed.gpu.b128 quad, [%2]; mov.b128 {%0, %1}, quad; }"
                 : "=l"(low), "=l"(high)
                 : "l"(at)
                 : "memory");
  return {__uint_as_float(static_cast<std::uint32_t>(low)), __uint_as_float(static_cast<std::uint32_t>(low >> 32)),
          __uint_as_float(static_cast<std::uint32_t>(high)), static_cast<std::uint32_t>(high >> 32)};
}
__device__ inline void write_whole(void* at, const WholeQuad& quad) {
  const std::uint64_t low = __float_as_uint(quad.x) | std::uint64_t{__float_as_uint(quad.y)} << 32;
  const std::uint64_t high = __float_as_uint(quad.z) | std::uint64_t{quad.word} << 32;
  if constexpr (kWholeQuads)
    asm volatile("{ .reg .b128 quad; mov.b128 quad, {%1, %2}; st.relaxed.gpu.b128 [%0], quad; }" ::"l"(at), "l"(low),
                 "l"(high)
                 : "memory");
}
#endif

}  // namespace plumb::impulse
