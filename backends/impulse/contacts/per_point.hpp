// A number for each point of a contact.
//
// A thread of a CPU works on a whole contact and holds the numbers of all P points. On a GPU the threads of a warp
// share one: kContactThreads neighbours work on the same contact, each holds the numbers of one point, and what
// concerns the bodies they all do alike. That takes a third of the instructions, which is what such a thread waits for.
// Sums go in the same order on both, point 0 and 1, 2 and 3, and then these, so that the bits are the same.
#pragma once

#include <cstdint>

#include "math/wide.hpp"
#include "narrowphase/manifold.hpp"

namespace plumb::impulse {

#if defined(PLUMB_IMPULSE_CUDA)
constexpr std::uint32_t kContactThreads = kManifoldPoints;
#else
constexpr std::uint32_t kContactThreads = 1;
#endif

/// All threads of a warp exchange numbers at once: loops over contacts must keep them together.
constexpr unsigned kWholeWarp = 0xFFFFFFFF;
constexpr std::uint32_t kWarp = 32;

/// Threads that a loop over n contacts takes: whole warps.
PLUMB_HD constexpr std::uint32_t contact_loop(std::uint32_t n) {
  constexpr std::uint32_t kTogether = kContactThreads == 1 ? 1 : kWarp;
  return (n * kContactThreads + kTogether - 1) / kTogether * kTogether;
}

/// Points that a thread holds numbers of.
template <int P>
constexpr int kHeld = kContactThreads == 1 ? P : 1;

/// Which point the numbers at index i are of.
PLUMB_HD inline int point_of(int i) {
#if defined(__CUDA_ARCH__)
  return static_cast<int>(threadIdx.x % kContactThreads);
#else
  return i;
#endif
}
/// Where the numbers of point p are, or those of the thread's own point.
PLUMB_HD constexpr int index_of(int p) { return kContactThreads == 1 ? p : 0; }
/// Whether this thread holds the numbers of point p.
PLUMB_HD inline bool holds_point(int p) { return kContactThreads == 1 || point_of(0) == p; }

/// x as the thread has it that holds the numbers of point p.
template <class N>
PLUMB_HD N from_point([[maybe_unused]] int p, const N& x) {
#if defined(__CUDA_ARCH__)
  return __shfl_sync(kWholeWarp, x, p, kContactThreads);
#else
  return x;
#endif
}

template <int P, class N>
struct PerPoint {
  N at[kHeld<P>];
};
template <int P, class N>
struct PointMask {
  using M = decltype(N() < N());
  M at[kHeld<P>];
};

/// f(i) for each index that this thread has.
template <int P, class N, class F>
PLUMB_HD PerPoint<P, N> by_point(const F& f) {
  PerPoint<P, N> result;
  PLUMB_UNROLL
  for (int i = 0; i < kHeld<P>; ++i) result.at[i] = f(i);
  return result;
}
template <int P, class N, class F>
PLUMB_HD PointMask<P, N> mask_by_point(const F& f) {
  PointMask<P, N> result;
  PLUMB_UNROLL
  for (int i = 0; i < kHeld<P>; ++i) result.at[i] = f(i);
  return result;
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> for_all_points(const N& x) {
  return by_point<P, N>([&](int) { return x; });
}

template <int P, class N>
PLUMB_HD PerPoint<P, N> operator+(const PerPoint<P, N>& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return a.at[i] + b.at[i]; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> operator+(const PerPoint<P, N>& a, const N& b) {
  return by_point<P, N>([&](int i) { return a.at[i] + b; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> operator+(const N& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return a + b.at[i]; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> operator-(const PerPoint<P, N>& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return a.at[i] - b.at[i]; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> operator-(const PerPoint<P, N>& a, const N& b) {
  return by_point<P, N>([&](int i) { return a.at[i] - b; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> operator-(const N& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return a - b.at[i]; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> operator*(const PerPoint<P, N>& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return a.at[i] * b.at[i]; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> operator*(const PerPoint<P, N>& a, const N& b) {
  return by_point<P, N>([&](int i) { return a.at[i] * b; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> operator*(const N& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return a * b.at[i]; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> operator/(const PerPoint<P, N>& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return a.at[i] / b.at[i]; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> operator-(const PerPoint<P, N>& a) {
  return by_point<P, N>([&](int i) { return -a.at[i]; });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> sqrt(const PerPoint<P, N>& a) {
  return by_point<P, N>([&](int i) { return sqrt(a.at[i]); });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> min(const PerPoint<P, N>& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return min(a.at[i], b.at[i]); });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> min(const PerPoint<P, N>& a, const N& b) {
  return by_point<P, N>([&](int i) { return min(a.at[i], b); });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> max(const PerPoint<P, N>& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return max(a.at[i], b.at[i]); });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> max(const PerPoint<P, N>& a, const N& b) {
  return by_point<P, N>([&](int i) { return max(a.at[i], b); });
}

template <int P, class N>
PLUMB_HD PointMask<P, N> operator<(const PerPoint<P, N>& a, const PerPoint<P, N>& b) {
  return mask_by_point<P, N>([&](int i) { return a.at[i] < b.at[i]; });
}
template <int P, class N>
PLUMB_HD PointMask<P, N> operator<(const PerPoint<P, N>& a, const N& b) {
  return mask_by_point<P, N>([&](int i) { return a.at[i] < b; });
}
template <int P, class N>
PLUMB_HD PointMask<P, N> operator>(const PerPoint<P, N>& a, const PerPoint<P, N>& b) {
  return mask_by_point<P, N>([&](int i) { return a.at[i] > b.at[i]; });
}
template <int P, class N>
PLUMB_HD PointMask<P, N> operator>(const PerPoint<P, N>& a, const N& b) {
  return mask_by_point<P, N>([&](int i) { return a.at[i] > b; });
}
template <int P, class N>
PLUMB_HD PointMask<P, N> operator&&(const PointMask<P, N>& a, const PointMask<P, N>& b) {
  return mask_by_point<P, N>([&](int i) { return a.at[i] && b.at[i]; });
}
template <int P, class N>
PLUMB_HD PointMask<P, N> operator||(const PointMask<P, N>& a, const PointMask<P, N>& b) {
  return mask_by_point<P, N>([&](int i) { return a.at[i] || b.at[i]; });
}
/// b: of the contact as a whole.
template <int P, class N, class Whole>
PLUMB_HD PointMask<P, N> operator&&(const PointMask<P, N>& a, const Whole& b) {
  return mask_by_point<P, N>([&](int i) { return a.at[i] && b; });
}

template <int P, class N>
PLUMB_HD PerPoint<P, N> select(const PointMask<P, N>& m, const PerPoint<P, N>& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return select(m.at[i], a.at[i], b.at[i]); });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> select(const PointMask<P, N>& m, const PerPoint<P, N>& a, const N& b) {
  return by_point<P, N>([&](int i) { return select(m.at[i], a.at[i], b); });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> select(const PointMask<P, N>& m, const N& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return select(m.at[i], a, b.at[i]); });
}
template <int P, class N>
PLUMB_HD PerPoint<P, N> select_by_point(const PointMask<P, N>& m, const N& a, const N& b) {
  return by_point<P, N>([&](int i) { return select(m.at[i], a, b); });
}
/// m: of the contact as a whole.
template <int P, class N, class Whole>
PLUMB_HD PerPoint<P, N> select_all(const Whole& m, const PerPoint<P, N>& a, const PerPoint<P, N>& b) {
  return by_point<P, N>([&](int i) { return select(m, a.at[i], b.at[i]); });
}

template <int P, class N>
PLUMB_HD N sum(const PerPoint<P, N>& x) {
#if defined(__CUDA_ARCH__)
  const N of_two = x.at[0] + __shfl_xor_sync(kWholeWarp, x.at[0], 1);
  return of_two + __shfl_xor_sync(kWholeWarp, of_two, 2);
#else
  static_assert(P == 1 || P == 2 || P == 4);
  if constexpr (kHeld<P> == 1)
    return x.at[0];
  else if constexpr (P == 2)
    return x.at[0] + x.at[1];
  else
    return (x.at[0] + x.at[1]) + (x.at[2] + x.at[3]);
#endif
}
template <int P, class N>
PLUMB_HD auto in_any_point(const PointMask<P, N>& m) {
#if defined(__CUDA_ARCH__)
  const unsigned found = __ballot_sync(kWholeWarp, m.at[0]);
  return (found >> (threadIdx.x % kWarp / kContactThreads * kContactThreads) & 0xF) != 0;
#else
  auto found = m.at[0];
  for (int i = 1; i < kHeld<P>; ++i) found = found || m.at[i];
  return found;
#endif
}
/// Whether any of the contacts that are worked on together says so.
template <class M>
PLUMB_HD bool in_any_contact(const M& m) {
#if defined(__CUDA_ARCH__)
  return __any_sync(kWholeWarp, m) != 0;
#else
  return any(m);
#endif
}

}  // namespace plumb::impulse
