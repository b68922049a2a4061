#include "report/page/plot_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::harness {

PlotScale::PlotScale(const PlotAxis& axis, const std::vector<double>& values, double from, double to)
    : logarithmic_(axis.logarithmic), from_(from), to_(to) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double low = infinite, high = -infinite;
  bool zeros = false;
  for (double value : values) {
    if (!std::isfinite(value)) continue;
    if (logarithmic_ && value <= 0) {
      zeros = true;
      continue;
    }
    if (axis.lowest) value = std::max(value, *axis.lowest);
    if (axis.highest) value = std::min(value, *axis.highest);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = high = logarithmic_ ? 1e-3 : 0;
  low_ = transformed(low);
  high_ = transformed(high);
  const double least = logarithmic_ ? 0.8 : 1e-9 + 0.1 * std::abs(high_);  // a single value still makes an axis
  if (high_ - low_ < least) {
    const double middle = (low_ + high_) / 2;
    low_ = middle - least / 2;
    high_ = middle + least / 2;
  }
  const double room = 0.06 * (high_ - low_);
  low_ -= room + (zeros ? 0.12 * (high_ - low_) : 0);  // zeros stand clear of the smallest value
  high_ += room;
}

double PlotScale::transformed(double value) const { return logarithmic_ ? std::log10(value) : value; }

Beyond PlotScale::beyond(double value) const {
  if (logarithmic_ && value <= 0) return Beyond::below;
  const double at = transformed(value), slack = 1e-9 * (high_ - low_);
  return at < low_ - slack ? Beyond::below : at > high_ + slack ? Beyond::above : Beyond::no;
}

double PlotScale::place(double value) const {
  const double share = logarithmic_ && value <= 0 ? 0 : (transformed(value) - low_) / (high_ - low_);
  return from_ + std::clamp(share, 0.0, 1.0) * (to_ - from_);
}

std::vector<Tick> PlotScale::ticks(int most) const {
  return logarithmic_ ? log_ticks(low(), high(), most) : linear_ticks(low(), high(), most);
}

double PlotScale::low() const { return logarithmic_ ? std::pow(10.0, low_) : low_; }
double PlotScale::high() const { return logarithmic_ ? std::pow(10.0, high_) : high_; }

}  // namespace plumb::harness
