// Numbers that judge runs by each other, where no truth is known: orders of convergence, spreads, growth of errors.
#pragma once

#include <span>

namespace plumb::harness {

/// From the distances D(h) of a solution at h from that at h / 2, and D(h / 2): order log2(D(h) / D(h / 2)), and
/// Richardson's estimate of the error of the best solution, at h / 4: D(h / 2) / (2^p - 1). What does not converge,
/// with an order of 0 or less, has no estimate: NaN. Two distances of 0 are order 0, error 0.
struct Convergence {
  double order, error;
};
[[nodiscard]] Convergence convergence(double coarse, double fine);

/// Mean and sample standard deviation.
struct Spread {
  double mean, deviation;
};
[[nodiscard]] Spread spread_of(std::span<const double> values);

/// Exponent of growth, 1/s, from a first distance to a later one: ln(later / first) / seconds.
[[nodiscard]] double growth_rate(double first, double later, double seconds);

}  // namespace plumb::harness
