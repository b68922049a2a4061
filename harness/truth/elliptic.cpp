#include "truth/elliptic.hpp"

#include <array>
#include <cmath>

namespace plumb::truth {

double complete_elliptic(double m) { return std::comp_ellint_1(std::sqrt(m)); }

Jacobi jacobi(double u, double m) {
  std::array<double, 16> a{}, c{};
  a[0] = 1;
  c[0] = std::sqrt(m);
  double b = std::sqrt(1 - m);
  std::size_t n = 0;
  while (std::abs(c[n]) > 1e-17 && n + 1 < a.size()) {
    a[n + 1] = (a[n] + b) / 2;
    c[n + 1] = (a[n] - b) / 2;
    b = std::sqrt(a[n] * b);
    ++n;
  }
  double phi = std::ldexp(a[n] * u, static_cast<int>(n));
  double before = phi;
  for (; n > 0; --n) {
    before = phi;
    phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
  }
  const double sn = std::sin(phi);
  const double cn = std::cos(phi);
  // dn = cn / cos(phi_1 - phi_0) loses its digits where cn is 0; the square root does where m sn^2 is near 1.
  const double cosine = std::cos(before - phi);
  const double dn = std::abs(cosine) > 0.1 ? cn / cosine : std::sqrt(1 - m * sn * sn);
  return {sn, cn, m == 0 ? 1 : dn};
}

}  // namespace plumb::truth
