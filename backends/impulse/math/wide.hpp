// Lanes: several Reals that go through the same arithmetic together, for loops over independent constraints.
//
// On the CPU eight lanes in vector registers (gcc's and clang's vector extension: each operation is the scalar one a
// lane, so the bits are the same as one by one). On a GPU a thread is a lane and Lanes is Real itself.
#pragma once

#include "math/real.hpp"

namespace plumb::impulse {

/// Rows of the solver are laid out in groups of this many, on every device.
constexpr std::uint32_t kLaneGroup = 8;

#if defined(PLUMB_IMPULSE_CUDA)

constexpr std::uint32_t kLanes = 1;
using Lanes = Real;
using Mask = bool;

#else

constexpr std::uint32_t kLanes = kLaneGroup;

/// Per lane: all bits set or none.
struct Mask {
  using Bits = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
  typedef Bits Vector __attribute__((vector_size(kLanes * sizeof(Real))));
  Vector v;
};

struct Lanes {
  typedef Real Vector __attribute__((vector_size(kLanes * sizeof(Real))));
  Vector v;

  Lanes() = default;
  constexpr explicit Lanes(const Vector& lanes) : v(lanes) {}
  constexpr explicit Lanes(Real x) : v{x, x, x, x, x, x, x, x} {}
  constexpr explicit Lanes(int x) : Lanes(static_cast<Real>(x)) {}
};

inline Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.v + b.v); }
inline Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.v - b.v); }
inline Lanes operator-(const Lanes& a) { return Lanes(-a.v); }
inline Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.v * b.v); }
inline Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.v / b.v); }
inline Mask operator<(const Lanes& a, const Lanes& b) { return {a.v < b.v}; }
inline Mask operator>(const Lanes& a, const Lanes& b) { return {a.v > b.v}; }
inline Mask operator&&(const Mask& a, const Mask& b) { return {a.v & b.v}; }
inline Mask operator||(const Mask& a, const Mask& b) { return {a.v | b.v}; }
inline Mask operator!(const Mask& m) { return {~m.v}; }
inline bool any(const Mask& m) {
  static_assert(kLanes == 8);
  const Mask::Vector fours = m.v | __builtin_shufflevector(m.v, m.v, 4, 5, 6, 7, 0, 1, 2, 3);
  const Mask::Vector pairs = fours | __builtin_shufflevector(fours, fours, 2, 3, 0, 1, 6, 7, 4, 5);
  return (pairs[0] | pairs[1]) != 0;
}
inline Lanes select(const Mask& m, const Lanes& a, const Lanes& b) { return Lanes(m.v ? a.v : b.v); }
inline Lanes min(const Lanes& a, const Lanes& b) { return select(b < a, b, a); }
inline Lanes max(const Lanes& a, const Lanes& b) { return select(a < b, b, a); }
inline Real largest(const Lanes& a) {
  Real most = a.v[0];
  for (std::uint32_t i = 1; i < kLanes; ++i) most = max(most, a.v[i]);
  return most;
}
inline Lanes sqrt(const Lanes& a) {
  Lanes root;
  for (std::uint32_t i = 0; i < kLanes; ++i) root.v[i] = sqrt(a.v[i]);
  return root;
}

/// Turns kLanes vectors of kLanes numbers into those of the first numbers, of the second and so on. In registers, where
/// it is called: sixteen vectors that go through memory take longer than all that is done with them.
[[gnu::always_inline]] inline void transpose(const Lanes (&rows)[kLanes], Lanes (&columns)[kLanes]) {
  static_assert(kLanes == 8);
  const auto& r = rows;
  Lanes::Vector t[8], s[8];
  for (int i = 0; i < 8; i += 2) {
    t[i] = __builtin_shufflevector(r[i].v, r[i + 1].v, 0, 8, 1, 9, 4, 12, 5, 13);
    t[i + 1] = __builtin_shufflevector(r[i].v, r[i + 1].v, 2, 10, 3, 11, 6, 14, 7, 15);
  }
  for (int i = 0; i < 8; i += 4) {
    s[i] = __builtin_shufflevector(t[i], t[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
    s[i + 1] = __builtin_shufflevector(t[i], t[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    s[i + 2] = __builtin_shufflevector(t[i + 1], t[i + 3], 0, 1, 8, 9, 4, 5, 12, 13);
    s[i + 3] = __builtin_shufflevector(t[i + 1], t[i + 3], 2, 3, 10, 11, 6, 7, 14, 15);
  }
  for (int i = 0; i < 4; ++i) {
    columns[i] = Lanes(__builtin_shufflevector(s[i], s[i + 4], 0, 1, 2, 3, 8, 9, 10, 11));
    columns[i + 4] = Lanes(__builtin_shufflevector(s[i], s[i + 4], 4, 5, 6, 7, 12, 13, 14, 15));
  }
}

/// Lanes as they lie in memory, which may be that of a row of kLanes numbers. A row is read and written as one vector:
/// in pieces, it would be slow to read again at once.
typedef Real LanesInMemory __attribute__((vector_size(kLanes * sizeof(Real)), aligned(alignof(Real)), may_alias));

template <class Row>
Lanes load_row(const Row& row) {
  static_assert(sizeof(Row) == sizeof(Lanes));
  return Lanes(Lanes::Vector(reinterpret_cast<const LanesInMemory&>(row)));
}
template <class Row>
void store_row(Row& row, const Lanes& lanes) {
  static_assert(sizeof(Row) == sizeof(Lanes));
  reinterpret_cast<LanesInMemory&>(row) = lanes.v;
}

/// Reads kLanes rows of kLanes numbers: the first numbers of all of them, the second and so on.
template <class Row>
void gather(const Row* rows, const std::uint32_t* indices, Lanes (&numbers)[kLanes]) {
  Lanes found[kLanes];
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) found[lane] = load_row(rows[indices[lane]]);
  transpose(found, numbers);
}
/// Writes kLanes rows, in the lanes where `where` is above 0.
template <class Row>
void scatter(const Lanes (&numbers)[kLanes], const Lanes& where, Row* rows, const std::uint32_t* indices) {
  Lanes found[kLanes];
  transpose(numbers, found);
  for (std::uint32_t lane = 0; lane < kLanes; ++lane)
    if (where.v[lane] > 0) store_row(rows[indices[lane]], found[lane]);
}

#endif

PLUMB_HD constexpr bool any(bool mask) { return mask; }
PLUMB_HD constexpr Real largest(Real x) { return x; }

/// How many lanes there are in an N, which is Real or Lanes.
template <class N>
inline constexpr std::uint32_t kLanesIn = std::is_same_v<N, Real> ? 1 : kLanes;

/// One lane of several, to read or to write.
template <class N>
PLUMB_HD Real& lane_of(N& lanes, std::uint32_t lane) {
  return reinterpret_cast<Real*>(&lanes)[lane];
}
template <class N>
PLUMB_HD const Real& lane_of(const N& lanes, std::uint32_t lane) {
  return reinterpret_cast<const Real*>(&lanes)[lane];
}

}  // namespace plumb::impulse
