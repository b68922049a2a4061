// The only file with instructions of certain processors. Each has a plain form, which gives the same bits.
#pragma once

#include <cstdint>
#include <type_traits>

#if defined(__x86_64__) && !defined(__CUDACC__)  // nvcc need not understand all of it
#include <immintrin.h>
#endif

#if defined(__wasm__) && __clang_major__ < 19
#error \
    "results would differ: LLVM 14 makes +0 of -0 in vectors (x < 0 ? 0 : x as f32x4.max); clang 19 has the right bits"
#endif

#if !defined(__CUDACC__)

namespace plumb::impulse::simd {

/// Tells the processor that this thread only waits for another one.
inline void pause() {
#if defined(__x86_64__)
  _mm_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

/// The word that controls how this thread rounds and what it does with subnormal numbers. Processors that are not named
/// here have none that a program could have changed.
inline std::uint64_t control_word() {
#if defined(__x86_64__)
  return _mm_getcsr();
#elif defined(__aarch64__)
  std::uint64_t word;
  asm volatile("mrs %0, fpcr" : "=r"(word));
  return word;
#else
  return 0;
#endif
}
inline void set_control_word([[maybe_unused]] std::uint64_t word) {
#if defined(__x86_64__)
  _mm_setcsr(static_cast<std::uint32_t>(word));
#elif defined(__aarch64__)
  asm volatile("msr fpcr, %0" : : "r"(word));
#endif
}
/// Round to nearest, no flush to zero, all exceptions masked: as a thread starts.
#if defined(__x86_64__)
inline constexpr std::uint64_t kDefaultControlWord = 0x1f80;
#else
inline constexpr std::uint64_t kDefaultControlWord = 0;
#endif

/// 16 bytes of numbers: four floats or two doubles.
template <class N>
struct Packed {
  static constexpr std::uint32_t kCount = 16 / sizeof(N);
  using Bits = std::conditional_t<sizeof(N) == 8, std::int64_t, std::int32_t>;
  typedef N Numbers __attribute__((vector_size(16)));
  typedef N Loaded __attribute__((vector_size(16), may_alias));
  typedef Bits Mask __attribute__((vector_size(16)));
  Numbers v;

  /// from: 16-byte aligned.
  static Packed load(const N* from) { return {*reinterpret_cast<const Loaded*>(from)}; }
  static Packed all(N x) { return {Numbers{} + x}; }

  friend Mask operator<=(const Packed& a, const Packed& b) { return a.v <= b.v; }
  friend Mask operator>=(const Packed& a, const Packed& b) { return a.v >= b.v; }
};

/// Bit k: the mask is set in number k.
inline std::uint32_t bits_of(const Packed<float>::Mask& mask) {
#if defined(__x86_64__)
  return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  return static_cast<std::uint32_t>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}
inline std::uint32_t bits_of(const Packed<double>::Mask& mask) {
#if defined(__x86_64__)
  return static_cast<std::uint32_t>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
  return static_cast<std::uint32_t>((mask[0] & 1) | (mask[1] & 2));
#endif
}

}  // namespace plumb::impulse::simd

#endif
