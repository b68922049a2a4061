// Rotations by an angle without libm: sine, cosine and arc tangent by polynomials, and the free rotor.
#pragma once

#include "math/mat33.hpp"

namespace plumb::impulse {

template <class N>
struct SinCosOf {
  N sine, cosine;
};
using SinCos = SinCosOf<Real>;

/// Of |x| <= pi/4, by Taylor's series to double's precision, and to float's.
template <class N>
PLUMB_HD SinCosOf<N> sin_cos_by_long_series(const N& x) {
  const N y = x * x, one = N(1);
  const auto term = [&](int divisor, const N& rest) { return one - y / N(divisor) * rest; };
  const N s = term(6, term(20, term(42, term(72, term(110, term(156, term(210, one - y / N(272))))))));
  const N c = term(2, term(12, term(30, term(56, term(90, term(132, term(182, one - y / N(240))))))));
  return {x * s, c};
}
template <class N>
PLUMB_HD SinCosOf<N> sin_cos_by_short_series(const N& x) {
  const N y = x * x, one = N(1);
  const auto by = [](double factor) { return N(static_cast<Real>(factor)); };
  const N s = one + y * (by(-1.0 / 6) + y * (by(1.0 / 120) + y * (by(-1.0 / 5040) + y * by(1.0 / 362880))));
  const N c = one + y * (by(-0.5) + y * (by(1.0 / 24) + y * (by(-1.0 / 720) + y * by(1.0 / 40320))));
  return {x * s, c};
}
/// To the precision of Real.
template <class N>
PLUMB_HD SinCosOf<N> small_sin_cos(const N& x) {
#if defined(PLUMB_IMPULSE_DOUBLE)
  return sin_cos_by_long_series(x);
#else
  return sin_cos_by_short_series(x);
#endif
}

/// Of any finite x: halved until it is small, then doubled back by the formulas of the double angle.
template <class N, class OfSmall>
PLUMB_HD SinCosOf<N> sin_cos_by_halves(N x, const OfSmall& of_small) {
  int halvings = 0;
  while (abs(x) > N(kPi) / 4 && halvings < 32) {
    x = x / 2;
    ++halvings;
  }
  SinCosOf<N> r = of_small(x);
  for (; halvings > 0; --halvings) r = {2 * r.sine * r.cosine, N(1) - 2 * r.sine * r.sine};
  return r;
}
PLUMB_HD inline SinCos sin_cos(Real x) {
  return sin_cos_by_halves(x, [](Real small) { return small_sin_cos(small); });
}
PLUMB_HD inline SinCosOf<double> sin_cos64(double x) {
  return sin_cos_by_halves(x, [](double small) { return sin_cos_by_long_series(small); });
}

/// The angle of (cosine, sine) times any positive number, in -pi..pi; 0 of (0, 0). Halved twice by
/// tan(a / 2) = sin a / (1 + cos a), then by Gregory's series.
PLUMB_HD inline Real angle_of(Real sine, Real cosine) {
  const Real size = sqrt(sine * sine + cosine * cosine);
  if (!(size > 0)) return 0;
  const bool behind = cosine < 0;  // then the angle beyond a right one, which is small where cosine is
  const Real across = behind ? abs(cosine) : abs(sine), ahead = behind ? abs(sine) : cosine;
  const Real half = across / (size + ahead);
  const Real t = half / (Real(1) + sqrt(Real(1) + half * half));
  const Real y = t * t;
  constexpr int kTerms = sizeof(Real) == 8 ? 20 : 9;
  Real sum = 0;
  for (int n = kTerms; n-- > 0;) sum = Real(1) / static_cast<Real>(2 * n + 1) - y * sum;
  const Real angle = 4 * t * sum;
  const Real whole = behind ? kPi / 2 + angle : angle;
  return sine < 0 ? -whole : whole;
}

/// The same angle within half a turn of 0. Of angles no further than a turn beyond.
PLUMB_HD inline Real wrapped(Real angle) {
  if (angle > kPi) return angle - 2 * kPi;
  return angle < -kPi ? angle + 2 * kPi : angle;
}

/// The rotation by the vector's length about its direction.
PLUMB_HD inline Quat turn_by(const Vec& rotation) {
  const Real angle = length(rotation);
  if (!(angle > 0)) return {rotation.x / 2, rotation.y / 2, rotation.z / 2, 1};
  const SinCos half = sin_cos(angle / 2);
  const Real k = half.sine / angle;
  return {k * rotation.x, k * rotation.y, k * rotation.z, half.cosine};
}

struct RotorState {
  Quat orientation;      // of the principal axes
  Vec angular_velocity;  // world axes
};

/// The principal axis whose moment differs most from the other two, by ratio. What these two differ by is the golden
/// ratio at most, for no moment exceeds the sum of the others.
PLUMB_HD inline int odd_axis(const Vec& inertia) {
  int least = 0, most = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (inertia[axis] < inertia[least]) least = axis;
    if (!(inertia[axis] < inertia[most])) most = axis;
  }
  const Real middle = inertia[3 - least - most];
  return middle * middle < inertia[least] * inertia[most] ? most : least;
}

/// One step of a rotor on which no torque acts. Its energy L.I^-1 L / 2 is split into that of a symmetric top, which is
/// solved exactly by a turn about L and one about the odd axis, and into what the moments of the other two axes differ
/// by, a turn about one of them; symmetric, so of second order, symplectic, and |L| is kept to rounding (Dullweber,
/// Leimkuhler and McLachlan, "Symplectic splitting methods for rigid body molecular dynamics", J. Chem. Phys. 107,
/// 1997, section III). A top of two equal moments moves exactly: a split into three turns would give a thin rod that
/// tumbles fast energy about its axis, by the ratio of its moments.
PLUMB_HD inline RotorState step_free_rotor(const RotorState& start, const Vec& inertia, Real h) {
  const int odd = odd_axis(inertia), first = odd == 2 ? 0 : odd + 1, second = 3 - odd - first;
  const auto excess = [&](int axis) { return (inertia[first] - inertia[axis]) / (inertia[first] * inertia[axis]); };
  Quat q = start.orientation;
  Vec momentum = scale(inertia, rotate_back(q, start.angular_velocity));  // in principal axes
  const auto turn = [&](int axis, Real time) {
    const SinCos half = sin_cos((time * momentum[axis]) * (excess(axis) / 2));
    Vec along = {0, 0, 0};
    along[axis] = half.sine;
    const Quat spin = {along.x, along.y, along.z, half.cosine};
    q = q * spin;
    momentum = rotate_back(spin, momentum);
  };
  const bool differ = inertia[first] != inertia[second];
  if (differ) turn(second, h / 2);
  q = q * turn_by((h / inertia[first]) * momentum);
  turn(odd, h);
  if (differ) turn(second, h / 2);
  q = normalized(q);
  return {q, rotate(q, {momentum.x / inertia.x, momentum.y / inertia.y, momentum.z / inertia.z})};
}

}  // namespace plumb::impulse
