#include "report/page/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/format.hpp"

namespace plumb::harness {
namespace {

/// 10 to the power of e with raised digits where plain ones would be long.
std::string power_label(int mantissa, int e) {
  if (e >= -3 && e <= 3) return limit_text(mantissa * std::pow(10.0, e));
  std::string out = mantissa == 1 ? "10" : fmt::format("{}\u00b710", mantissa);
  static const char* const digits[]{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                    "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  for (const char c : std::to_string(e)) out += c == '-' ? "\u207b" : digits[c - '0'];
  return out;
}

}  // namespace

std::vector<Tick> linear_ticks(double low, double high, int most) {
  std::vector<Tick> ticks;
  if (!(high > low) || most < 1) return ticks;
  const double power = std::pow(10.0, std::floor(std::log10((high - low) / most)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (std::floor(high / (factor * power)) - std::ceil(low / (factor * power)) + 1 <= most) step = factor * power;
  }
  const double first = std::ceil(low / step), last = std::floor(high / step);
  for (double i = first; i <= last; ++i) ticks.push_back({i * step, limit_text(i * step)});
  return ticks;
}

std::vector<Tick> log_ticks(double low, double high, int most) {
  std::vector<Tick> ticks;
  if (!(low > 0) || !(high > low) || most < 1) return ticks;
  constexpr double slack = 1e-9;  // an end that is a power of ten up to rounding has its tick
  const int first = static_cast<int>(std::floor(std::log10(low) - slack));
  const int last = static_cast<int>(std::floor(std::log10(high) + slack));
  const int powers = last - static_cast<int>(std::ceil(std::log10(low) - slack)) + 1;
  const int stride = std::max(1, (powers + most - 1) / most);
  for (int e = first; e <= last; ++e) {
    for (int mantissa = 1; mantissa < 10; ++mantissa) {
      const double value = mantissa * std::pow(10.0, e);
      if (value < low * (1 - slack) || value > high * (1 + slack)) continue;
      const bool fine = powers < 2 && (mantissa == 2 || mantissa == 5);
      const bool labelled = fine || (mantissa == 1 && (last - e) % stride == 0);
      // Between thinned powers minor ticks would be a grey bar.
      if (!labelled && mantissa > 1 && stride > 1) continue;
      ticks.push_back({value, labelled ? power_label(mantissa, e) : ""});
    }
  }
  return ticks;
}

}  // namespace plumb::harness
