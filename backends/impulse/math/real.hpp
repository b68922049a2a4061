// Real, the number that the engine computes in, and the few operations on it that give the same bits everywhere.
//
// Results must not depend on the machine: CPU and GPU, any compiler. So step code uses + - * / and square root, which
// IEEE 754 rounds one way only, and what is defined here; no libm, no fused multiply-add (the build switches
// contraction off), no library min or max (they differ on NaN and signed zeros).
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

// Loops over the few points of a manifold are unrolled: an array that is indexed by a running number has its place in
// memory and not in registers.
#if defined(__CUDA_ARCH__)
#define PLUMB_UNROLL _Pragma("unroll")
#elif defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#define PLUMB_UNROLL _Pragma("GCC unroll 16")
#else
#define PLUMB_UNROLL
#endif

#if defined(__CUDACC__)
#define PLUMB_HD __host__ __device__
#define PLUMB_DEVICE __device__  // what works with a Team, which a GPU's host has not
#else
#define PLUMB_HD
#define PLUMB_DEVICE
#endif

// Small functions that take longer to call than to do: what they give goes through memory then. A GPU's are part of
// their caller anyhow.
#if defined(__CUDACC__)
#define PLUMB_INLINE __host__ __device__
#else
#define PLUMB_INLINE [[gnu::always_inline]]
#endif

// Long functions that a kernel needs in several places: as copies in all of them they would not fit a GPU's cache of
// instructions.
#if defined(__CUDACC__)
#define PLUMB_SHARED_CODE __noinline__ __host__ __device__
#define PLUMB_SHARED_DEVICE_CODE __noinline__ __device__
#else
#define PLUMB_SHARED_CODE
#define PLUMB_SHARED_DEVICE_CODE
#endif

// Templates that a CPU's library has in one of its files. A kernel is compiled with all that it calls.
#if defined(__CUDACC__)
#define PLUMB_COMPILED_ONCE(...) static_assert(true)
#else
#define PLUMB_COMPILED_ONCE(...) extern template __VA_ARGS__
#endif

namespace plumb::impulse {

#if defined(PLUMB_IMPULSE_DOUBLE)
using Real = double;
inline constexpr Real kEpsilon = 2.220446049250313e-16;
#else
using Real = float;
inline constexpr Real kEpsilon = 1.1920929e-7F;
#endif
inline constexpr Real kHuge = Real(1e30);
inline constexpr Real kPi = Real(3.14159265358979323846);

template <class N>
PLUMB_HD constexpr N min(N a, N b) {
  return b < a ? b : a;
}
template <class N>
PLUMB_HD constexpr N max(N a, N b) {
  return a < b ? b : a;
}
template <class N>
PLUMB_HD constexpr N clamp(N x, N low, N high) {
  return min(max(x, low), high);
}
PLUMB_HD inline float abs(float x) { return fabsf(x); }
PLUMB_HD inline double abs(double x) { return fabs(x); }
PLUMB_HD inline float sqrt(float x) { return sqrtf(x); }
PLUMB_HD inline double sqrt(double x) { return ::sqrt(x); }
/// Neither NaN nor infinite: of those the difference from itself is NaN.
PLUMB_HD inline bool is_finite(Real x) { return x - x == 0; }

/// a where the condition holds, else b. For lanes of numbers (wide.hpp) a choice a lane.
PLUMB_HD constexpr float select(bool condition, float a, float b) { return condition ? a : b; }
PLUMB_HD constexpr double select(bool condition, double a, double b) { return condition ? a : b; }

/// 1 / x, and 0 where x is not above 0: the effective mass of what cannot move.
PLUMB_HD inline Real reciprocal_or_zero(Real x) { return x > 0 ? Real(1) / x : Real(0); }

}  // namespace plumb::impulse
