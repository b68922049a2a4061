// Diagrams as inline SVG: points, lines, error bars, reference lines, hover titles. Colours come from the page's style:
// series i has the class e<i>, and text and frames follow the theme.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plumb::harness {

/// The colour of a series that is no engine's: the text's own.
inline constexpr std::size_t no_colour = 1000000;

struct PlotPoint {
  double x, y;
  std::optional<double> x_low, x_high;  ///< error bar
  bool filled = false;
  std::string hover;    ///< plain text, may have lines
  std::string link;     ///< "#r12", "" for none
  bool marked = false;  ///< a ring around it
  bool failed = false;  ///< a cross instead of the marker; lines end before it and begin anew behind it
  std::optional<double> y_low = std::nullopt, y_high = std::nullopt;  ///< error bar
};

struct PlotSeries {
  std::size_t colour = 0;   ///< and marker
  std::size_t pattern = 0;  ///< of the line: 0 solid, then dashes
  bool joined = true;
  bool right = false;  ///< on the right axis
  std::string hover;   ///< of the line
  std::vector<PlotPoint> points = {};
  bool stepped = false;  ///< a staircase: each value holds up to the next point's x
  bool quiet = false;    ///< points as specks without hover and link; for many that matter little
  std::vector<std::pair<double, double>> fit = {};  ///< a thin line beside the points; "" without
  std::string fit_hover = {};
};

struct PlotAxis {
  std::string title;
  bool logarithmic = true;
  /// Values beyond are drawn at the edge, with a mark that they are not there.
  std::optional<double> lowest, highest;
};

struct Plot {
  std::string description;  ///< for those who cannot see it
  PlotAxis x, y;
  std::optional<PlotAxis> right;
  std::vector<PlotSeries> series;
  std::vector<std::pair<double, std::string>> levels;  ///< horizontal lines on the left axis, with their label
  bool slopes = false;                                 ///< guides of slope -1 and -2, both axes being logarithmic
};

/// An <svg> element that scales to its container's width. Points that are not finite are left out; on a logarithmic
/// axis values of 0 and below stand at the lower edge. "" when there is no point to draw.
[[nodiscard]] std::string render_plot(const Plot& plot);

inline constexpr std::size_t marker_shapes = 6;
/// The marker of a series by itself, for legends.
[[nodiscard]] std::string render_marker(std::size_t colour, bool filled);

inline constexpr std::size_t plot_patterns = 4;
/// A short piece of line in a pattern, for legends.
[[nodiscard]] std::string render_pattern(std::size_t pattern);

}  // namespace plumb::harness
