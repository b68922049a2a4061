// Diagrams as data: the page's script draws them. An engine's hue comes from its name, a series' shape and dash tell
// what else it is.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {

struct Row;

/// Where axes of errors end: beyond, nothing is told apart, for all of it is wrong.
constexpr double largest_error = 10;

struct PlotPoint {
  double x, y;               ///< y infinite: not finite, drawn beyond the frame
  const Row* row = nullptr;  ///< where the point leads
  bool filled = false;       ///< at the engine's own values
  bool marked = false;       ///< a ring around it: as it ships
  std::optional<Interval> x_band = {}, y_band = {};
  std::string failed = {};  ///< what it missed: a cross instead of the marker; lines end before it and begin anew
};

struct PlotSeries {
  std::string name;                        ///< in the legend and in what a hover says
  std::optional<std::size_t> engine = {};  ///< place in the page's backends; none: the text's own colour
  std::vector<PlotPoint> points = {};
  std::string method = {};  ///< series of one engine with the same method have the same shape
  std::optional<std::size_t> rank =
      {};                 ///< the method's place on this page, for a shape that is its own on all figures
  std::string line = {};  ///< series with the same have the same dashes
  bool joined = true;
  bool stepped = false;  ///< a staircase: each value holds up to the next point's x
  bool quiet = false;    ///< specks, for many that matter little, or no points at all where it is joined
  bool large = false;    ///< few that stand for many
  std::vector<std::pair<double, double>> fit = {};  ///< a thin line beside the points
};

struct PlotAxis {
  std::string title;
  bool logarithmic = true;
  /// Values beyond are drawn at the edge, with a mark that they are not there.
  std::optional<double> lowest = {}, highest = {};
};

struct Plot {
  std::string description;  ///< for those who cannot see it
  PlotAxis x, y;
  std::vector<PlotSeries> series = {};
  std::vector<std::pair<double, std::string>> levels = {};  ///< horizontal lines with their label
  bool slopes = false;                                      ///< guides of slope -1 and -2, both axes being logarithmic
};

/// null when there is no point to draw.
[[nodiscard]] Json plot_data(const Plot& plot);

}  // namespace plumb::harness
