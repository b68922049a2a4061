#include "report/page/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/page/markup.hpp"
#include "report/page/plot_scale.hpp"

namespace plumb::harness {
namespace {

constexpr double width = 400, height = 290;
constexpr double margin_left = 62, margin_top = 16, margin_bottom = 44, margin_right = 16, margin_right_axis = 58;
constexpr double marker_radius = 4;
constexpr const char* dashes[plot_patterns]{"", "6 3", "2 3", "8 3 2 3"};

/// The path of marker number `shape` around (x, y): circle, square, triangle, diamond, triangle down, cross.
std::string marker_path(std::size_t shape, double x, double y, double r) {
  switch (shape % marker_shapes) {
    case 0:
      return fmt::format("M{:.1f} {:.1f}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z", x - r, y, fmt::arg("r", r),
                         fmt::arg("d", 2 * r));
    case 1: return fmt::format("M{:.1f} {:.1f}h{d}v{d}h-{d}z", x - 0.9 * r, y - 0.9 * r, fmt::arg("d", 1.8 * r));
    case 2:
      return fmt::format("M{:.1f} {:.1f}l{w} {h}h-{b}z", x, y - 1.2 * r, fmt::arg("w", 1.15 * r), fmt::arg("h", 2 * r),
                         fmt::arg("b", 2.3 * r));
    case 3: return fmt::format("M{:.1f} {:.1f}l{d} {d}l-{d} {d}l-{d} -{d}z", x, y - 1.3 * r, fmt::arg("d", 1.3 * r));
    case 4:
      return fmt::format("M{:.1f} {:.1f}l{w} -{h}h-{b}z", x, y + 1.2 * r, fmt::arg("w", 1.15 * r), fmt::arg("h", 2 * r),
                         fmt::arg("b", 2.3 * r));
    default:
      return fmt::format("M{:.1f} {:.1f}h{a}v{a}h{a}v{a}h-{a}v{a}h-{a}v-{a}h-{a}v-{a}h{a}z", x - 0.4 * r, y - 1.2 * r,
                         fmt::arg("a", 0.8 * r));
  }
}

/// A small arrow at an edge: the value lies beyond.
std::string beyond_path(Beyond beyond, double x, double y) {
  const double tip = beyond == Beyond::below ? 5 : -5;
  return fmt::format("M{:.1f} {:.1f}h6l-3 {}z", x - 3, y, tip);
}

class Drawing {
 public:
  explicit Drawing(const Plot& plot)
      : plot_(plot),
        right_edge_(width - (plot.right ? margin_right_axis : margin_right)),
        bottom_(height - margin_bottom),
        x_(plot.x, values(&PlotPoint::x, std::nullopt), margin_left, right_edge_),
        y_(plot.y, values(&PlotPoint::y, false), bottom_, margin_top),
        right_(plot.right.value_or(plot.y), values(&PlotPoint::y, true), bottom_, margin_top) {}

  std::string render() {
    add(R"(<svg class="plot" viewBox="0 0 {} {}" role="img" aria-label="{}">)", width, height,
        escape_html(plot_.description));
    draw_axes();
    for (const auto& [value, label] : plot_.levels) draw_level(value, label);
    if (plot_.slopes) draw_slopes();
    for (const PlotSeries& series : plot_.series) draw_line(series);
    for (const PlotSeries& series : plot_.series) draw_fit(series);
    for (const PlotSeries& series : plot_.series) draw_points(series);
    out_ += "</svg>";
    return std::move(out_);
  }

 private:
  template <typename... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
  }

  /// right: of which axis; both for x, where error bars and levels count too.
  [[nodiscard]] std::vector<double> values(double PlotPoint::*coordinate, std::optional<bool> right) const {
    std::vector<double> all;
    for (const PlotSeries& series : plot_.series) {
      if (right && series.right != *right) continue;
      for (const PlotPoint& point : series.points) {
        all.push_back(point.*coordinate);
        if (right && point.y_low) all.push_back(*point.y_low);
        if (right && point.y_high) all.push_back(*point.y_high);
        if (!right && point.x_low) all.push_back(*point.x_low);
        if (!right && point.x_high) all.push_back(*point.x_high);
      }
    }
    if (right && !*right) {
      for (const auto& [value, label] : plot_.levels) all.push_back(value);
    }
    return all;
  }

  void draw_axes() {
    for (const Tick& tick : x_.ticks(6)) {
      const double at = x_.place(tick.value);
      add(R"(<path class="{}" d="M{:.1f} {}V{}"/>)", tick.label.empty() ? "minor" : "grid", at, margin_top, bottom_);
      if (!tick.label.empty()) add(R"(<text x="{:.1f}" y="{}" class="mid">{}</text>)", at, bottom_ + 15, tick.label);
    }
    for (const Tick& tick : y_.ticks(6)) {
      const double at = y_.place(tick.value);
      add(R"(<path class="{}" d="M{} {:.1f}H{}"/>)", tick.label.empty() ? "minor" : "grid", margin_left, at,
          right_edge_);
      if (!tick.label.empty())
        add(R"(<text x="{}" y="{:.1f}" class="end">{}</text>)", margin_left - 6, at + 3.5, tick.label);
    }
    if (plot_.right) {
      for (const Tick& tick : right_.ticks(6)) {
        if (tick.label.empty()) continue;
        const double at = right_.place(tick.value);
        add(R"(<path class="frame" d="M{} {:.1f}h4"/><text x="{}" y="{:.1f}">{}</text>)", right_edge_, at,
            right_edge_ + 7, at + 3.5, tick.label);
      }
      add(R"svg(<text class="title mid" transform="translate({} {}) rotate(90)">{}</text>)svg", width - 9,
          (margin_top + bottom_) / 2, escape_html(plot_.right->title));
    }
    add(R"(<path class="frame" d="M{} {}V{}H{}{}"/>)", margin_left, margin_top, bottom_, right_edge_,
        plot_.right ? fmt::format("V{}", margin_top) : "");
    add(R"(<text class="title mid" x="{}" y="{}">{}</text>)", (margin_left + right_edge_) / 2, height - 8,
        escape_html(plot_.x.title));
    add(R"svg(<text class="title mid" transform="translate(12 {}) rotate(-90)">{}</text>)svg",
        (margin_top + bottom_) / 2, escape_html(plot_.y.title));
  }

  void draw_level(double value, const std::string& label) {
    if (!y_.within(value)) return;
    const double at = y_.place(value);
    const bool at_right = points_near(at, right_edge_) < points_near(at, margin_left);
    add(R"(<path class="level" d="M{} {:.1f}H{}"/><text class="note{}" x="{}" y="{:.1f}">{}</text>)", margin_left, at,
        right_edge_, at_right ? " end" : "", at_right ? right_edge_ - 5 : margin_left + 5,
        at < margin_top + 12 ? at + 11 : at - 4, escape_html(label));
  }

  /// Where a level's label would stand: points that it would cover.
  [[nodiscard]] std::size_t points_near(double level, double edge) const {
    constexpr double label_width = 85, label_height = 15;
    std::size_t near = 0;
    for (const PlotSeries& series : plot_.series) {
      for (const PlotPoint& point : series.points) {
        if (!series.right && drawable(point) && std::abs(x_.place(point.x) - edge) < label_width &&
            std::abs(y_.place(point.y) - level) < label_height)
          ++near;
      }
    }
    return near;
  }

  /// From the upper left corner downwards: error falls with the first and second power of the cost.
  void draw_slopes() {
    const double x0 = x_.low() * std::pow(x_.high() / x_.low(), 0.04),
                 y0 = y_.low() * std::pow(y_.high() / y_.low(), 0.96);
    const double decades_right = std::log10(x_.high() / x0), decades_down = std::log10(y0 / y_.low());
    for (const int slope : {1, 2}) {
      const double decades = 0.92 * std::min(decades_right, decades_down / slope);
      const double x1 = x0 * std::pow(10.0, decades), y1 = y0 * std::pow(10.0, -slope * decades);
      const double px = x_.place(x1), py = y_.place(y1);
      add(R"(<path class="slope" d="M{:.1f} {:.1f}L{:.1f} {:.1f}"/><text class="note" x="{:.1f}" y="{:.1f}">{}</text>)",
          x_.place(x0), y_.place(y0), px, py, std::min(px + 3, right_edge_ - 8), py + 3, slope == 1 ? "slope 1" : "2");
    }
  }

  [[nodiscard]] bool drawable(const PlotPoint& point) const { return std::isfinite(point.x) && std::isfinite(point.y); }

  void draw_line(const PlotSeries& series) {
    if (!series.joined) return;
    const PlotScale& scale = series.right ? right_ : y_;
    std::string path;
    bool broken = true;
    double at = 0;
    for (const PlotPoint& point : series.points) {
      if (!drawable(point)) continue;
      broken = broken || point.failed;
      if (point.failed) continue;
      if (series.stepped && !broken) fmt::format_to(std::back_inserter(path), "L{:.1f} {:.1f}", x_.place(point.x), at);
      at = scale.place(point.y);
      fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", broken ? "M" : "L", x_.place(point.x), at);
      broken = false;
    }
    if (path.find('L') == std::string::npos) return;
    const char* dash = dashes[series.pattern % plot_patterns];
    add(R"(<path class="line e{}{}"{} d="{}"><title>{}</title></path>)", series.colour, series.right ? " second" : "",
        *dash ? fmt::format(R"( stroke-dasharray="{}")", dash) : "", path, escape_html(series.hover));
  }

  void draw_fit(const PlotSeries& series) {
    std::string path;
    for (const auto& [x, y] : series.fit) {
      if (std::isfinite(x) && std::isfinite(y))
        fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_.place(x), y_.place(y));
    }
    if (path.find('L') == std::string::npos) return;
    add(R"(<path class="fit e{}" d="{}"><title>{}</title></path>)", series.colour, path, escape_html(series.fit_hover));
  }

  void draw_specks(const PlotSeries& series) {
    std::string path;
    for (const PlotPoint& point : series.points) {
      if (drawable(point))
        fmt::format_to(std::back_inserter(path), "M{:.0f} {:.0f}h0", x_.place(point.x), y_.place(point.y));
    }
    add(R"(<path class="specks e{}" d="{}"/>)", series.colour, path);
  }

  void draw_points(const PlotSeries& series) {
    if (series.quiet) return draw_specks(series);
    const PlotScale& scale = series.right ? right_ : y_;
    for (const PlotPoint& point : series.points) {
      if (!drawable(point)) continue;
      const double x = x_.place(point.x), y = scale.place(point.y);
      const Beyond beyond = scale.beyond(point.y);
      if (!point.link.empty()) add(R"(<a href="{}">)", escape_html(point.link));
      add(R"(<g class="e{}{}">)", series.colour, series.right ? " small" : "");
      if (point.x_low && point.x_high)
        add(R"(<path class="bar" d="M{:.1f} {:.1f}H{:.1f}"/>)", x_.place(*point.x_low), y, x_.place(*point.x_high));
      if (point.y_low && point.y_high)
        add(R"(<path class="bar" d="M{:.1f} {:.1f}V{:.1f}"/>)", x, scale.place(*point.y_low),
            scale.place(*point.y_high));
      if (point.marked) add(R"(<path class="halo" d="{}"/>)", marker_path(0, x, y, 2.1 * marker_radius));
      if (point.failed) {
        add(R"(<path class="cross" d="M{0:.1f} {1:.1f}l{2} {2}m0 -{2}l-{2} {2}"/>)", x - 0.8 * marker_radius,
            y - 0.8 * marker_radius, 1.6 * marker_radius);
      } else {
        add(R"(<path class="{}" d="{}"/>)", point.filled ? "dot" : "ring",
            marker_path(series.colour, x, y, series.right ? 2.5 : marker_radius));
      }
      if (beyond != Beyond::no)
        add(R"(<path class="dot" d="{}"/>)", beyond_path(beyond, x, beyond == Beyond::below ? y + 6 : y - 6));
      add("<title>{}</title></g>", escape_html(point.hover));
      if (!point.link.empty()) out_ += "</a>";
    }
  }

  const Plot& plot_;
  double right_edge_, bottom_;
  PlotScale x_, y_, right_;
  std::string out_;
};

}  // namespace

std::string render_plot(const Plot& plot) {
  const bool any = std::any_of(plot.series.begin(), plot.series.end(), [](const PlotSeries& series) {
    return std::any_of(series.points.begin(), series.points.end(),
                       [](const PlotPoint& point) { return std::isfinite(point.x) && std::isfinite(point.y); });
  });
  return any ? Drawing(plot).render() : "";
}

std::string render_marker(std::size_t colour, bool filled) {
  return fmt::format(R"(<svg class="key e{}" viewBox="0 0 14 14" aria-hidden="true"><path class="{}" d="{}"/></svg>)",
                     colour, filled ? "dot" : "ring", marker_path(colour, 7, 7, marker_radius));
}

std::string render_pattern(std::size_t pattern) {
  return fmt::format(
      R"(<svg class="key wide" viewBox="0 0 28 14" aria-hidden="true"><path class="line" stroke-dasharray="{}" )"
      R"(d="M1 7H27"/></svg>)",
      dashes[pattern % plot_patterns]);
}

}  // namespace plumb::harness
