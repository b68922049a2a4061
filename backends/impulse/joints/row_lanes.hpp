// The rows of a joint, which go through the same arithmetic together.
//
// A thread of a CPU has them all, as lanes. On a GPU kRowThreads neighbours work on a joint: each has the lane of its
// own row, and what concerns no row they all do alike. They need not do so in step: what one has written others read
// after lanes_meet(), and of what all of them would write where it depends on what was there, one does it
// (leads_lanes). Sums go in the same order on both, so that the bits are the same.
#pragma once

#include "joints/joint.hpp"
#include "math/lane_vectors.hpp"

namespace plumb::impulse {

#if defined(PLUMB_IMPULSE_CUDA)

constexpr std::uint32_t kRowThreads = kLaneGroup;

PLUMB_HD inline int own_lane() {
#if defined(__CUDA_ARCH__)
  return static_cast<int>(threadIdx.x % kRowThreads);
#else
  return 0;
#endif
}
/// The first of the threads of a warp that work on this thread's joint, and bits: all of these.
PLUMB_HD inline unsigned group_begin() {
#if defined(__CUDA_ARCH__)
  constexpr unsigned kWarpThreads = 32;
  return threadIdx.x % kWarpThreads / kRowThreads * kRowThreads;
#else
  return 0;
#endif
}
PLUMB_HD inline unsigned own_group() { return ((1U << kRowThreads) - 1) << group_begin(); }
PLUMB_HD inline void lanes_meet() {
#if defined(__CUDA_ARCH__)
  __syncwarp(own_group());
#endif
}
PLUMB_HD inline bool leads_lanes() { return own_lane() == 0; }

/// The number in a lane, in all of them.
PLUMB_HD inline Real in_lane(const Lanes& x, [[maybe_unused]] int lane) {
#if defined(__CUDA_ARCH__)
  return __shfl_sync(own_group(), x, lane, kRowThreads);
#else
  return x;
#endif
}
/// The number of row i, where each_row calls for it.
PLUMB_HD inline Real of_row(const Lanes& x, int /*i*/) { return x; }

template <class Row>
PLUMB_HD Lanes load_row(const Row& row) {
  static_assert(sizeof(Row) == kLaneGroup * sizeof(Real));
  return reinterpret_cast<const Real*>(&row)[own_lane()];
}
/// For the same lane to load again, and for others when they have met.
template <class Row>
PLUMB_HD void store_row(Row& row, const Lanes& lanes) {
  static_assert(sizeof(Row) == kLaneGroup * sizeof(Real));
  reinterpret_cast<Real*>(&row)[own_lane()] = lanes;
}

/// Bits as lanes.
PLUMB_HD inline Mask lanes_of(std::uint32_t bits) { return (bits >> own_lane() & 1U) != 0; }

/// f(i) for the rows from first on.
template <class F>
PLUMB_HD void each_row(int first, int n, const F& f) {
  const int i = own_lane();
  if (first <= i && i < n) f(i);
}
/// of(i) of all rows in their lanes, of numbers that are in registers.
template <class Of>
PLUMB_HD Lanes lanes_of_rows(const Of& of) {
  Real own = 0;
  PLUMB_UNROLL
  for (int i = 0; i < kJointRows; ++i) own = own_lane() == i ? of(i) : own;
  return own;
}
/// of(i) of n rows in their lanes, and 0 in others.
template <class Of>
PLUMB_HD Lanes by_row(int n, const Of& of) {
  const int i = own_lane();
  return i < n ? of(i) : Real(0);
}
/// Whether any row's thread says so, which the others hear.
PLUMB_HD inline bool any_row(bool own) {
#if defined(__CUDA_ARCH__)
  return __any_sync(own_group(), own) != 0;
#else
  return own;
#endif
}
/// Bits: the rows from first on of which f(i) holds.
template <class F>
PLUMB_HD std::uint32_t rows_where(int first, int n, const F& f) {
  const int i = own_lane();
  const bool holds = first <= i && i < n && f(i);
#if defined(__CUDA_ARCH__)
  return (__ballot_sync(own_group(), holds) & own_group()) >> group_begin();
#else
  return static_cast<std::uint32_t>(holds);
#endif
}
/// The numbers of all rows, for every thread.
PLUMB_HD inline void spread(const Lanes& x, RowNumbers& numbers) {
  PLUMB_UNROLL
  for (int i = 0; i < kJointRows; ++i) numbers[i] = in_lane(x, i);
}
/// Stores kLaneGroup lanes so that those of one lane follow each other, of all rows.
template <class Row>
PLUMB_HD void store_turned(const Lanes (&x)[kLaneGroup], Row (&rows)[kJointRows]) {
  static_assert(sizeof(Row) == kLaneGroup * sizeof(Real));
  const int i = own_lane();
  if (i >= kJointRows) return;
  Real* const row = reinterpret_cast<Real*>(&rows[i]);
  PLUMB_UNROLL
  for (int q = 0; q < static_cast<int>(kLaneGroup); ++q) row[q] = x[q];
}
/// f(i) for the first n rows or columns one after the other, of arrays that stay in registers.
template <class F>
PLUMB_HD void count_rows(int n, const F& f) {
  PLUMB_UNROLL
  for (int i = 0; i < kJointRows; ++i)
    if (i < n) f(i);
}
/// f(n) with a number of rows that the compiler knows, so that columns stay in registers: of a GPU it is all, or as
/// many as a fixed joint has, and is_row tells those that there are.
template <class F>
PLUMB_HD void with_rows(int n, const F& f) {
  constexpr int kFixedRows = rows_of(JointType::kFixed);
  if (n <= kFixedRows)
    f(std::integral_constant<int, kFixedRows>{});
  else
    f(std::integral_constant<int, kJointRows>{});
}
PLUMB_HD inline bool is_row(int i, int n) { return i < n; }
/// Numbers of all rows that have just been found one by one.
PLUMB_HD inline Lanes lanes_of_numbers(const Real* numbers) {
  return by_row(kJointRows, [numbers](int i) { return numbers[i]; });
}
/// The numbers of a velocity that every thread has, as lanes, and back.
PLUMB_HD inline Lanes lanes_of_velocity(const Velocity& velocity) {
  const Real numbers[kLaneGroup] = {velocity.linear.x,  velocity.linear.y,  velocity.linear.z,  velocity.inverse_mass,
                                    velocity.angular.x, velocity.angular.y, velocity.angular.z, 0};
  Real own = 0;
  PLUMB_UNROLL
  for (int i = 0; i < static_cast<int>(kLaneGroup); ++i) own = own_lane() == i ? numbers[i] : own;
  return own;
}
PLUMB_HD inline Velocity velocity_of(const Lanes& lanes) {
  return {{in_lane(lanes, 0), in_lane(lanes, 1), in_lane(lanes, 2)},
          in_lane(lanes, 3),
          {in_lane(lanes, 4), in_lane(lanes, 5), in_lane(lanes, 6)},
          0};
}
/// Whether any lane of x differs from y's, to the last bit.
PLUMB_HD inline bool differ(const Lanes& x, const Lanes& y) {
  return any_row(__builtin_bit_cast(std::uint32_t, x) != __builtin_bit_cast(std::uint32_t, y));
}

#else

constexpr std::uint32_t kRowThreads = 1;

inline void lanes_meet() {}
inline bool leads_lanes() { return true; }
inline Real in_lane(const Lanes& x, int lane) { return x.v[lane]; }
inline Real of_row(const Lanes& x, int i) { return x.v[i]; }

/// Bits as lanes.
inline Mask lanes_of(std::uint32_t bits) {
  constexpr Mask::Vector kBits = {1, 2, 4, 8, 16, 32, 64, 128};
  const auto all = static_cast<Mask::Bits>(bits);
  return {(Mask::Vector{all, all, all, all, all, all, all, all} & kBits) != 0};
}
template <class F>
[[gnu::always_inline]] inline void each_row(int first, int n, const F& f) {
  for (int i = first; i < n; ++i) f(i);
}
/// of(i) of all rows in their lanes: in registers, for numbers that go to memory one by one are slow to read at once.
template <class Of>
[[gnu::always_inline]] inline Lanes lanes_of_rows(const Of& of) {
  static_assert(kLanes == 8 && kJointRows == 7);
  return Lanes(Lanes::Vector{of(0), of(1), of(2), of(3), of(4), of(5), of(6), 0});
}
template <class Of>
[[gnu::always_inline]] inline Lanes by_row(int n, const Of& of) {
  RowNumbers numbers{};
  for (int i = 0; i < n; ++i) numbers[i] = of(i);
  return lanes_of_rows([&numbers](int i) { return numbers[i]; });
}
inline bool any_row(bool own) { return own; }
template <class F>
[[gnu::always_inline]] inline std::uint32_t rows_where(int first, int n, const F& f) {
  std::uint32_t rows = 0;
  for (int i = first; i < n; ++i) rows |= static_cast<std::uint32_t>(f(i)) << i;
  return rows;
}
inline void spread(const Lanes& x, RowNumbers& numbers) { store_row(numbers, x); }
template <class Row>
[[gnu::always_inline]] inline void store_turned(const Lanes (&x)[kLanes], Row (&rows)[kJointRows]) {
  Lanes y[kLanes];
  transpose(x, y);
  PLUMB_UNROLL
  for (int i = 0; i < kJointRows; ++i) store_row(rows[i], y[i]);
}
template <class F>
[[gnu::always_inline]] inline void count_rows(int n, const F& f) {
  for (int i = 0; i < n; ++i) f(i);
}

template <class F>
void with_rows(int n, const F& f) {
  switch (n) {
    case 1: return f(std::integral_constant<int, 1>{});
    case 2: return f(std::integral_constant<int, 2>{});
    case 3: return f(std::integral_constant<int, 3>{});
    case 4: return f(std::integral_constant<int, 4>{});
    case 5: return f(std::integral_constant<int, 5>{});
    case 6: return f(std::integral_constant<int, 6>{});
    case 7: return f(std::integral_constant<int, 7>{});
    default: return;
  }
  static_assert(kJointRows == 7);
}
constexpr bool is_row(int /*i*/, int /*n*/) { return true; }
[[gnu::always_inline]] inline Lanes lanes_of_numbers(const Real* numbers) {
  return lanes_of_rows([numbers](int i) { return numbers[i]; });
}
inline Lanes lanes_of_velocity(const Velocity& velocity) { return load_row(velocity); }
inline Velocity velocity_of(const Lanes& lanes) {
  Velocity velocity;
  store_row(velocity, lanes);
  return velocity;
}
inline bool differ(const Lanes& x, const Lanes& y) {
  return any(Mask{__builtin_bit_cast(Mask::Vector, x.v) != __builtin_bit_cast(Mask::Vector, y.v)});
}

#endif

}  // namespace plumb::impulse
