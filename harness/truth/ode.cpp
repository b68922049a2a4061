#include "truth/ode.hpp"

#include <array>
#include <cmath>

namespace plumb::truth {
namespace {

/// Gragg's modified midpoint rule over h in n steps; its error has even powers of h / n only.
Eigen::VectorXd midpoint(const Derivative& f, const Eigen::VectorXd& y, double t, double h, int n) {
  const double step = h / n;
  Eigen::VectorXd before = y;
  Eigen::VectorXd now = y + step * f(t, y);
  for (int i = 1; i < n; ++i) {
    Eigen::VectorXd next = before + 2 * step * f(t + i * step, now);
    before = std::move(now);
    now = std::move(next);
  }
  return (before + now + step * f(t + h, now)) / 2;
}

Eigen::VectorXd stride_over(const Derivative& f, const Eigen::VectorXd& y, double t, double h) {
  constexpr std::size_t columns = 8;
  std::array<Eigen::VectorXd, columns> table;  // the last row of Neville's scheme
  for (std::size_t row = 0; row < columns; ++row) {
    const auto n = 2 * static_cast<double>(row + 1);
    Eigen::VectorXd value = midpoint(f, y, t, h, static_cast<int>(n));
    for (std::size_t column = 1; column <= row; ++column) {
      const double ratio = n / (2 * static_cast<double>(row + 1 - column));
      Eigen::VectorXd better = value + (value - table[column - 1]) / (ratio * ratio - 1);
      table[column - 1] = std::move(value);
      value = std::move(better);
    }
    table[row] = std::move(value);
  }
  return table[columns - 1];
}

}  // namespace

Eigen::VectorXd integrate(const Derivative& f, Eigen::VectorXd y, double begin, double end, double stride) {
  const auto count = static_cast<int>(std::ceil((end - begin) / stride - 1e-9));
  const double h = count > 0 ? (end - begin) / count : 0;
  for (int i = 0; i < count; ++i) y = stride_over(f, y, begin + i * h, h);
  return y;
}

}  // namespace plumb::truth
