#include "measure/instruments/statistics.hpp"

#include <cmath>
#include <limits>

namespace plumb::harness {

Convergence convergence(double coarse, double fine) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (coarse == 0 && fine == 0) return {0, 0};
  const double order = std::log2(coarse / fine);
  if (std::isinf(order) && order > 0) return {order, 0};
  return {order, order > 0 ? fine / (std::exp2(order) - 1) : unknown};
}

Spread spread_of(std::span<const double> values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, values.size() < 2 ? 0 : std::sqrt(squares / (count - 1))};
}

double growth_rate(double first, double later, double seconds) { return std::log(later / first) / seconds; }

}  // namespace plumb::harness
