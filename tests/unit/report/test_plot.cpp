#include "report/page/parts/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "report/page/parts/blocks.hpp"
#include "report/page/parts/looks.hpp"

namespace plumb::harness {
namespace {

TEST(Plot, KeepsWhatCanBeDrawnAndNothingElse) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  Plot plot;
  plot.description = "a plot";
  plot.series.push_back({"line", 0, {{nan, 1}, {1, nan}, {1, infinite}}});
  EXPECT_TRUE(plot_data(plot).is_null()) << "nothing has a place";
  plot.series[0].points.push_back({2, 0.5});
  plot.series.push_back({"empty", 1});
  const Json data = plot_data(plot);
  ASSERT_EQ(data["series"].size(), 1u);
  const Json& points = data["series"][0]["points"];
  ASSERT_EQ(points.size(), 2u);
  EXPECT_TRUE(points[0]["y"].is_null()) << "not finite: beyond the frame";
  EXPECT_EQ(points[1]["y"], 0.5);
}

TEST(Plot, FigureWithoutPlotsIsNone) {
  FigureData figure;
  figure.title = "nothing";
  EXPECT_TRUE(figure_data(figure).is_null());
  figure.plots.push_back({});
  EXPECT_TRUE(figure_data(figure).is_null());
}

TEST(Table, CellsKeepWhatTheyAreSortedBy) {
  Table table("a table");
  table.column({"scene"});
  EXPECT_TRUE(table.empty());
  table.row({"plain"});
  table.row({cell("1.00&times;", 1.0, "best")}, "d1 stacking", 2);
  const Json block = table.block()["table"];
  EXPECT_EQ(block["rows"][0], Json::parse(R"({"c": ["plain"]})"));
  EXPECT_EQ(block["rows"][1], Json::parse(R"({"c": [["1.00&times;", 1.0, "best"]], "k": "d1 stacking", "e": 2})"));
}

TEST(EngineLook, HangsOnTheNameAlone) {
  for (const char* name : {"one", "two", "a-third-engine", "engine-f64", ""}) {
    const EngineLook look = look_of(name);
    EXPECT_LT(look.hue, page_hues);
    EXPECT_LT(look.shade, page_shades);
    EXPECT_EQ(look_of(name).colour(), look.colour());
  }
}

TEST(EngineLook, MembersOfAFamilyShareItsHue) {
  for (const std::string family : {"alpha", "beta", "gamma"}) {
    std::set<std::size_t> colours;
    for (const char* member : {"", "-f64", "-cuda"}) {
      EXPECT_EQ(look_of(family + member).hue, look_of(family).hue);
      colours.insert(look_of(family + member).colour());
    }
    EXPECT_EQ(colours.size(), 3u) << family;
  }
}

TEST(EngineLook, AsWebAssemblyAnEngineKeepsItsHueAndHasAShadeOfItsOwn) {
  EXPECT_EQ(engine_family("node-alpha"), "alpha");
  EXPECT_EQ(engine_family("node-alpha-simd"), "alpha");
  std::set<std::size_t> colours;
  for (const char* name : {"alpha", "alpha-f64", "alpha-cuda", "node-alpha"}) {
    EXPECT_EQ(look_of(name).hue, look_of("alpha").hue);
    colours.insert(look_of(name).colour());
  }
  EXPECT_EQ(colours.size(), 4u);
}

}  // namespace
}  // namespace plumb::harness
