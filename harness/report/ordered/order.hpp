// The order at which an error falls: the slope of a line through points in logarithms, with its 95 % interval.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rows/statistics.hpp"

namespace plumb::harness {

struct OrderPoint {
  double turned;  ///< what was turned: a time step, a knob's value
  double error;
};

struct Order {
  double power;                      ///< error ~ turned^power
  double factor;                     ///< error = factor * turned^power
  std::optional<Interval> interval;  ///< of the power
  std::size_t points;

  [[nodiscard]] double at(double turned) const;
};

/// Over points that are finite and above zero; absent for fewer than three, or where nothing was turned.
[[nodiscard]] std::optional<Order> fit_order(const std::vector<OrderPoint>& points);

/// "1.02 (0.95 to 1.09)"
[[nodiscard]] std::string order_text(const Order& order);

}  // namespace plumb::harness
