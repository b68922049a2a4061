// How sure a time is, whether the machine was busy, what a cell will cost, and where a ladder wants another point.
#include <gtest/gtest.h>

#include <cmath>

#include "rows/statistics.hpp"
#include "study/cost.hpp"
#include "study/refine.hpp"
#include "worker/contention.hpp"

namespace plumb::harness::testing {
namespace {

TEST(Spread, quantiles_are_those_of_the_tables) {
  EXPECT_NEAR(student_t(1), 12.7062, 1e-4);
  EXPECT_NEAR(student_t(2), 4.3027, 1e-4);
  EXPECT_NEAR(student_t(5), 2.5706, 1e-4);
  EXPECT_NEAR(student_t(10), 2.2281, 1e-4);
  EXPECT_NEAR(student_t(1000), 1.9623, 1e-4);
}

TEST(Spread, the_interval_is_about_the_geometric_mean) {
  EXPECT_FALSE(log_normal_interval({1}).has_value());
  EXPECT_FALSE(log_normal_interval({1, 0}).has_value());
  const auto interval = log_normal_interval({1, 2, 4});
  ASSERT_TRUE(interval.has_value());
  EXPECT_NEAR(std::sqrt(interval->low * interval->high), 2, 1e-12);
  EXPECT_NEAR(std::log(interval->high / 2), 4.302653 * std::log(2) / std::sqrt(3), 1e-6);
  EXPECT_DOUBLE_EQ(*relative_spread({3, 3, 3}), 0);
}

TEST(Contention, is_more_work_than_cores) {
  EXPECT_FALSE(contended({1, 0.1, 0}, 2, 1, 1));
  EXPECT_FALSE(contended({1, 1.0, 0}, 2, 1, 1)) << "the other core is theirs";
  EXPECT_NEAR(contended({1, 1.8, 0}, 2, 1, 1)->load.value(), 2.8, 1e-9);
  EXPECT_EQ(contended({1, 0, 0}, 2, 1, 4)->load, 4.0) << "four processes at once";
  EXPECT_EQ(contended({1, 0, 0}, 2, 3, 1)->load, 3.0) << "three threads";
  EXPECT_NE(contended({1, 0, 0.2}, 2, 1, 1)->why.find("20 %"), std::string::npos);
  EXPECT_GT(processor_time().busy, 0);
}

TEST(Refinement, puts_points_where_a_level_lies_between) {
  const std::vector<double> added = points_to_add({{1, 0.16}, {2, 0.08}, {4, 0.04}, {8, 0.02}});
  ASSERT_EQ(added.size(), 1u) << "a straight line, 10 % between the first two";
  EXPECT_NEAR(added[0], std::sqrt(2), 1e-12);
  EXPECT_TRUE(points_to_add({{1, 0.2}, {1.2, 0.05}}).empty()) << "close enough";
}

TEST(Refinement, puts_points_where_the_curve_bends) {
  EXPECT_EQ(points_to_add({{1, 8}, {2, 4}, {4, 2}, {8, 1.9}}).size(), 2u);
  EXPECT_TRUE(points_to_add({{1, 8}, {2, 4}, {4, 2}, {8, 1}}).empty());
}

TEST(Refinement, judges_a_ladder_by_its_first_metric_with_a_threshold) {
  const Row row = parse_row(Json::parse(R"({"status": "ok", "metrics": {"note": {"error": 1, "threshold": null},
    "angle": {"error": -0.5, "truth": 2, "unit": "rad", "threshold": 1}, "b": {"error": 3, "threshold": 1}}})"),
                            0);
  std::string metric;
  const auto point = ladder_point(row, 4, metric);
  ASSERT_TRUE(point.has_value());
  EXPECT_EQ(metric, "angle");
  EXPECT_EQ(point->error, 0.5);
  metric = "b";
  EXPECT_EQ(ladder_point(row, 4, metric)->error, 3);
  EXPECT_FALSE(ladder_point(parse_row({{"status", "crashed"}, {"metrics", Json::object()}}, 0), 4, metric).has_value());
}

TEST(Costs, are_those_of_cells_alike) {
  CostModel costs;
  EXPECT_EQ(costs.typical_seconds(), 1);
  costs.learn(parse_row(
      Json::parse(R"({"scene": "X1", "params": {"H": 2.0, "seed": 3}, "backend": "a", "dt": 0.01, "seconds": 1,
    "repeats": 2, "time": {"wall_s": 4}, "settings": {"k": 10}, "knobs": ["k"]})"),
      0));
  EXPECT_EQ(costs.typical_seconds(), 2);
  SettingDescription knob;
  knob.name = "k";
  knob.type = "int";
  knob.role = "quality";
  knob.default_value = 10;
  BackendDescription backend;
  backend.name = "a";
  backend.settings = {knob};
  SceneFile scene;
  scene.id = "X1";
  Cell cell;
  cell.scene = std::make_shared<const SceneFile>(scene);
  cell.backend = std::make_shared<const BackendDescription>(backend);
  cell.shown = {{"H", 2.0}};
  cell.dt = 0.005;
  cell.seconds = 1;
  EXPECT_NEAR(*costs.seconds(cell), 4, 1e-9) << "twice the steps";
  cell.settings["k"] = 40;
  EXPECT_NEAR(*costs.seconds(cell), 16, 1e-9) << "four times the passes";
  cell.shown = {{"H", 3.0}};
  EXPECT_FALSE(costs.seconds(cell).has_value());
}

}  // namespace
}  // namespace plumb::harness::testing
