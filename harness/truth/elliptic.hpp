// Jacobi's elliptic functions, in which pendulums and free rotation are exact.
#pragma once

namespace plumb::truth {

/// Complete elliptic integral of the first kind, K(m) = int_0^{pi/2} (1 - m sin^2)^{-1/2}; m = k^2 in [0, 1).
[[nodiscard]] double complete_elliptic(double m);

struct Jacobi {
  double sn, cn, dn;
};

/// sn cn dn of u for the parameter m = k^2 in [0, 1), by arithmetic-geometric means (Abramowitz & Stegun 16.4).
[[nodiscard]] Jacobi jacobi(double u, double m);

}  // namespace plumb::truth
