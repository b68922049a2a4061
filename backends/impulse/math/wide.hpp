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
  constexpr explicit Lanes(Vector lanes) : v(lanes) {}
  constexpr explicit Lanes(Real x) : v(Vector{} + x) {}
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
inline Mask operator!(const Mask& m) { return {~m.v}; }
inline bool any(const Mask& m) {
  Mask::Bits bits = 0;
  for (std::uint32_t i = 0; i < kLanes; ++i) bits |= m.v[i];
  return bits != 0;
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

#endif

PLUMB_HD constexpr bool any(bool mask) { return mask; }
PLUMB_HD constexpr Real largest(Real x) { return x; }

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
