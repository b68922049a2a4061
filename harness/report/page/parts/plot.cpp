#include "report/page/parts/plot.hpp"

#include <algorithm>
#include <cmath>

#include "report/page/parts/blocks.hpp"
#include "rows/row.hpp"

namespace plumb::harness {
namespace {

Json band_data(const Interval& band) { return Json::array({drawn_number(band.low), drawn_number(band.high)}); }

/// Flags and bands stand there only where they say something: there are tens of thousands of points.
Json point_data(const PlotPoint& point) {
  Json out{{"x", drawn_number(point.x)}, {"y", drawn_number(point.y)}};
  if (point.row) out["r"] = point.row->origin.index;
  if (point.filled) out["filled"] = true;
  if (point.marked) out["marked"] = true;
  if (!point.failed.empty()) out["failed"] = point.failed;
  if (point.x_band) out["xb"] = band_data(*point.x_band);
  if (point.y_band) out["yb"] = band_data(*point.y_band);
  return out;
}

bool drawable(const PlotPoint& point) { return std::isfinite(point.x) && !std::isnan(point.y); }

Json series_data(const PlotSeries& series) {
  Json out{{"name", series.name}, {"points", Json::array()}};
  for (const PlotPoint& point : series.points) {
    if (drawable(point)) out["points"].push_back(point_data(point));
  }
  if (series.engine) out["engine"] = *series.engine;
  if (!series.method.empty()) out["method"] = series.method;
  if (series.rank) out["rank"] = *series.rank;
  if (!series.line.empty()) out["line"] = series.line;
  for (const auto& [name, set] : {std::pair{"loose", !series.joined}, std::pair{"stepped", series.stepped},
                                  std::pair{"quiet", series.quiet}, std::pair{"large", series.large}}) {
    if (set) out[name] = true;
  }
  for (const auto& [x, y] : series.fit) {
    if (std::isfinite(x) && std::isfinite(y)) out["fit"].push_back({drawn_number(x), drawn_number(y)});
  }
  return out;
}

Json axis_data(const PlotAxis& axis) {
  Json out{{"title", axis.title}, {"log", axis.logarithmic}};
  if (axis.lowest) out["lowest"] = *axis.lowest;
  if (axis.highest) out["highest"] = *axis.highest;
  return out;
}

}  // namespace

Json plot_data(const Plot& plot) {
  Json out{
      {"description", plot.description}, {"x", axis_data(plot.x)}, {"y", axis_data(plot.y)}, {"series", Json::array()}};
  bool any = false;
  for (const PlotSeries& series : plot.series) {
    Json data = series_data(series);
    if (data["points"].empty()) continue;
    any = any || std::any_of(series.points.begin(), series.points.end(),
                             [](const PlotPoint& point) { return drawable(point) && std::isfinite(point.y); });
    out["series"].push_back(std::move(data));
  }
  if (!any) return nullptr;
  for (const auto& [value, label] : plot.levels) out["levels"].push_back({value, label});
  if (plot.slopes) out["slopes"] = true;
  return out;
}

}  // namespace plumb::harness
