#include "report/ordered/order.hpp"

#include <fmt/format.h>

#include <cmath>

namespace plumb::harness {

double Order::at(double turned) const { return factor * std::pow(turned, power); }

std::optional<Order> fit_order(const std::vector<OrderPoint>& points) {
  constexpr std::size_t fewest = 3;  // two lie on a line in any case
  std::vector<double> x, y;
  for (const OrderPoint& point : points) {
    if (!(point.turned > 0) || !(point.error > 0) || !std::isfinite(point.turned) || !std::isfinite(point.error))
      continue;
    x.push_back(std::log(point.turned));
    y.push_back(std::log(point.error));
  }
  if (x.size() < fewest) return std::nullopt;
  const std::optional<LineFit> fit = fit_line(x, y);
  if (!fit) return std::nullopt;
  return Order{fit->slope, std::exp(fit->offset), fit->slope_interval, x.size()};
}

std::string order_text(const Order& order) {
  std::string out = fmt::format("{:.2f}", order.power);
  if (order.interval) out += fmt::format(" ({:.2f} to {:.2f})", order.interval->low, order.interval->high);
  return out;
}

}  // namespace plumb::harness
