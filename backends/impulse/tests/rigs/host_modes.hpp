// What a host may have set in its thread: bits of simd::control_word().
#pragma once

#include <cstdint>

#include "exec/simd.hpp"

namespace plumb::impulse::test::modes {

#if defined(__aarch64__)  // FPCR: FZ, RMode
inline constexpr std::uint64_t kFlush = 1U << 24, kUp = 1U << 22, kDown = 2U << 22, kToZero = 3U << 22;
#elif defined(__x86_64__)  // MXCSR: FTZ and DAZ, RC
inline constexpr std::uint64_t kFlush = 0x8040, kUp = 0x4000, kDown = 0x2000, kToZero = 0x6000;
#else
inline constexpr std::uint64_t kFlush = 0, kUp = 0, kDown = 0, kToZero = 0;
#endif
inline constexpr std::uint64_t kNearest = 0, kModeBits = kFlush | kToZero;

}  // namespace plumb::impulse::test::modes
