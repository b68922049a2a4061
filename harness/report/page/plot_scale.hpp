// One axis of a diagram: from values to places.
#pragma once

#include <vector>

#include "report/page/plot.hpp"
#include "report/page/ticks.hpp"

namespace plumb::harness {

/// Where a value was drawn: at its place, or at an edge because it lies beyond.
enum class Beyond { no, below, above };

class PlotScale {
 public:
  /// Spans the values (those that are not finite, and on a logarithmic axis not above zero, do not count) with some
  /// room at both ends. Places go from `from` to `to`.
  PlotScale(const PlotAxis& axis, const std::vector<double>& values, double from, double to);

  [[nodiscard]] double place(double value) const;  ///< within [from, to]
  [[nodiscard]] Beyond beyond(double value) const;
  [[nodiscard]] bool within(double value) const { return beyond(value) == Beyond::no; }
  [[nodiscard]] std::vector<Tick> ticks(int most) const;
  [[nodiscard]] double low() const;   ///< the value at `from`
  [[nodiscard]] double high() const;  ///< the value at `to`

 private:
  [[nodiscard]] double transformed(double value) const;

  bool logarithmic_;
  double low_, high_;  ///< transformed
  double from_, to_;
};

}  // namespace plumb::harness
