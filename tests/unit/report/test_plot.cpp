#include "report/page/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "report/page/plot_scale.hpp"
#include "report/page/ticks.hpp"

namespace plumb::harness {
namespace {

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
  std::vector<std::string> out;
  for (const Tick& tick : ticks) {
    if (!tick.label.empty()) out.push_back(tick.label);
  }
  return out;
}

TEST(Ticks, LinearOnesAreRoundAndFew) {
  EXPECT_EQ(labels(linear_ticks(0, 10, 6)), (std::vector<std::string>{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels(linear_ticks(0.13, 0.58, 5)), (std::vector<std::string>{"0.2", "0.3", "0.4", "0.5"}));
  for (const double high : {1.0, 3.7, 12.0, 990.0, 2e-7}) {
    for (int most = 2; most <= 10; ++most) {
      const auto ticks = linear_ticks(-0.3 * high, high, most);
      EXPECT_LE(ticks.size(), static_cast<std::size_t>(most));
      EXPECT_GE(ticks.size(), 1u);
      for (const Tick& tick : ticks) EXPECT_TRUE(tick.value >= -0.3 * high && tick.value <= high * (1 + 1e-12));
    }
  }
}

TEST(Ticks, LogarithmicOnesArePowersOfTen) {
  EXPECT_EQ(labels(log_ticks(0.008, 120, 8)), (std::vector<std::string>{"0.01", "0.1", "1", "10", "100"}));
  EXPECT_EQ(labels(log_ticks(1, 1000, 8)), (std::vector<std::string>{"1", "10", "100", "1000"})) << "ends count";
  EXPECT_EQ(labels(log_ticks(1.5, 7, 6)), (std::vector<std::string>{"2", "5"})) << "no power fits";
  EXPECT_EQ(labels(log_ticks(1e-6, 1e-4, 6)), (std::vector<std::string>{"10⁻⁶", "10⁻⁵", "10⁻⁴"}));
  const auto wide = labels(log_ticks(1e-15, 1, 6));
  EXPECT_LE(wide.size(), 6u);
  EXPECT_GE(wide.size(), 3u);
}

TEST(Ticks, NonsenseHasNone) {
  const double nan = std::nan("");
  EXPECT_TRUE(linear_ticks(1, 1, 5).empty());
  EXPECT_TRUE(linear_ticks(nan, 1, 5).empty());
  EXPECT_TRUE(log_ticks(0, 1, 5).empty());
  EXPECT_TRUE(log_ticks(-1, 1, 5).empty());
  EXPECT_TRUE(log_ticks(1, nan, 5).empty());
}

TEST(PlotScale, PlacesAndEdges) {
  PlotAxis axis{"error", true, std::nullopt, 10.0};
  const PlotScale scale(axis, {1e-4, 1e-2, 1e6, 0, std::nan("")}, 100, 0);
  EXPECT_LT(scale.place(1e-2), scale.place(1e-4));
  EXPECT_EQ(scale.beyond(1e6), Beyond::above);
  EXPECT_EQ(scale.place(1e6), 0);
  EXPECT_EQ(scale.beyond(0), Beyond::below);
  EXPECT_EQ(scale.place(0), 100);
  EXPECT_EQ(scale.beyond(-1), Beyond::below) << "it has no logarithm";
  EXPECT_EQ(scale.beyond(1e-3), Beyond::no);
  EXPECT_NEAR(scale.place(1e-3), (scale.place(1e-4) + scale.place(1e-2)) / 2, 1e-9);
}

TEST(Plot, DrawsWhatIsFiniteAndNothingElse) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  Plot plot;
  plot.slopes = true;
  plot.description = "a \"quoted\" <plot>";
  plot.series.push_back(
      {0, 0, true, false, "line", {{nan, 1, {}, {}, false, "nan", ""}, {1, infinite, {}, {}, false, "inf", ""}}});
  EXPECT_EQ(render_plot(plot), "");
  plot.series[0].points.push_back({2, 0.5, 1.0, 3.0, true, "<script>", "#r1"});
  plot.series[0].points.push_back({4, 0, {}, {}, false, "zero", "#r2"});
  const std::string svg = render_plot(plot);
  EXPECT_NE(svg.find("&lt;script&gt;"), std::string::npos);
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
  EXPECT_NE(svg.find("href=\"#r1\""), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Plot, LevelsAreNamedWhereNoPointsAre) {
  Plot plot;
  plot.levels.emplace_back(0.01, "limit");
  plot.series.push_back(
      {0, 0, true, false, "line", {{1, 0.01, {}, {}, false, "", ""}, {50, 1, {}, {}, false, "", ""}}});
  EXPECT_NE(render_plot(plot).find("<text class=\"note end\""), std::string::npos);
  std::swap(plot.series[0].points[0].x, plot.series[0].points[1].x);
  EXPECT_NE(render_plot(plot).find("<text class=\"note\""), std::string::npos);
}

}  // namespace
}  // namespace plumb::harness
