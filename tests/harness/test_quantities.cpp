// Scenes whose truths stand in their files alone, beside the same scenes with compiled measures: on every backend that
// can run both, the same digits.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

/// Metrics by backend, of the backends that ran the scene.
std::map<std::string, Json> metrics_of(const std::vector<std::string>& arguments) {
  std::vector<std::string> line{"run"};
  line.insert(line.end(), arguments.begin(), arguments.end());
  line.emplace_back("--json");
  const Finished finished = plumb(line);
  EXPECT_EQ(finished.status, 0) << finished.err;
  std::map<std::string, Json> found;
  for (const Json& row : finished.rows()) {
    const std::string status = row["status"];
    EXPECT_TRUE(status == "ok" || status == "failed" || status == "unsupported") << row["reason"];
    if (status != "unsupported") found[row["backend"]] = row["metrics"];
  }
  return found;
}

std::string own_words(const std::string& file) { return std::string(QUANTITY_SCENES) + "/" + file; }

/// Both scenes' metrics, for each backend that ran both.
void side_by_side(const std::vector<std::string>& compiled, const std::vector<std::string>& in_own_words,
                  const std::function<void(const Json& compiled, const Json& own)>& compare) {
  const auto one = metrics_of(compiled), other = metrics_of(in_own_words);
  std::size_t compared = 0;
  for (const auto& [backend, metrics] : one) {
    if (!other.contains(backend)) continue;
    SCOPED_TRACE(backend);
    compare(metrics, other.at(backend));
    ++compared;
  }
  if (compared == 0) GTEST_SKIP() << "no backend here runs the scene";
}

/// Values, truths and errors alike to the last digits.
void expect_same(const Json& one, const Json& other, double in_unit = 1, double zero = 0) {
  EXPECT_NEAR(double(one["value"]) * in_unit + zero, double(other["value"]), 4e-15 * std::abs(double(other["value"])));
  EXPECT_NEAR(double(one["truth"]) * in_unit + zero, double(other["truth"]), 4e-15 * std::abs(double(other["truth"])));
}
void expect_same_error(const Json& one, const Json& other) {
  EXPECT_NEAR(double(one["error"]), double(other["error"]), 1e-12 * double(one["error"]) + 1e-14);
}

TEST(Quantities, ProjectileHasTheCompiledDigits) {
  side_by_side({"A2"}, {own_words("X1-projectile.json")}, [](const Json& compiled, const Json& own) {
    for (const char* name : {"apex_time", "apex_height", "end_height", "damped_speed", "damped_drop"}) {
      SCOPED_TRACE(name);
      expect_same(compiled[name], own[name]);
      expect_same_error(compiled[name], own[name]);
    }
    // No scheme of first order leaves the parabola by more than g t dt / 2, at 1.5 s.
    EXPECT_LE(double(own["off_the_parabola"]["error"]), 9.81 * 1.5 / 60 / 2 * (1 + 1e-3));
    EXPECT_DOUBLE_EQ(double(own["off_the_parabola"]["value"]), 100 * double(own["off_the_parabola"]["error"])) << "cm";
    EXPECT_EQ(own["off_the_parabola"]["truth"], 0);
  });
}

TEST(Quantities, PendulumHasTheCompiledDigits) {
  side_by_side({"A7", "--param", "amplitude=90", "--param", "joint=distance"},
               {own_words("X2-pendulum.json"), "--param", "amplitude=90"}, [](const Json& compiled, const Json& own) {
                 EXPECT_NEAR(double(compiled["period"]["truth"]), double(own["period"]["truth"]), 1e-14);
                 // The angle passes 0 on another line than its sine does.
                 EXPECT_NEAR(double(compiled["period"]["value"]), double(own["period"]["value"]), 1e-5);
                 const Json& drift = compiled["energy_drift"];
                 EXPECT_NEAR(double(drift["value"]) * 9.81, double(own["energy_change"]["value"]), 1e-13);
                 EXPECT_NEAR(double(drift["error"]), double(own["energy_error"]["error"]), 1e-14);
                 EXPECT_NEAR(double(compiled["length"]["error"]), double(own["stretch"]["error"]), 1e-14);
                 EXPECT_NEAR(1e3 * double(own["stretch"]["error"]), double(own["stretch"]["value"]), 1e-12) << "mm";
                 EXPECT_LT(std::abs(double(own["quarter"]["value"])), 0.2);
               });
}

TEST(Quantities, BlockOnASlopeHasTheCompiledDigits) {
  side_by_side({"C1", "--param", "slope=45", "--param", "yaw=0", "--param", "cube_yaw=0"},
               {own_words("X3-incline.json")}, [](const Json& compiled, const Json& own) {
                 expect_same(compiled["distance"], own["distance"]);
                 expect_same_error(compiled["distance"], own["distance"]);
                 // The referee's own metric looks at fewer steps.
                 EXPECT_GE(double(own["overlap"]["value"]), double(compiled["penetration_max"]["value"]) - 1e-12);
                 EXPECT_NEAR(double(own["push"]["truth"]), 9.81 / 2 * std::sqrt(0.5), 1e-12);
                 EXPECT_GT(double(own["push"]["value"]), 1);
                 EXPECT_NEAR(double(own["borne"]["truth"]), 9.81 * 0.75, 1e-12);
                 if (own["borne"].value("note", "") != "not measured") {
                   EXPECT_LT(double(own["borne"]["error"]), 0.3);
                 }
               });
}

TEST(Quantities, SpringHasTheCompiledDigits) {
  side_by_side({"E8", "--param", "task=ring"}, {own_words("X4-spring.json")},
               [](const Json& compiled, const Json& own) {
                 expect_same(compiled["place"], own["place"], 1, 2);
                 EXPECT_NEAR(double(own["length"]["value"]), double(own["place"]["value"]), 1e-14);
                 EXPECT_LT(double(own["ringing"]["error"]), 1);
               });
}

TEST(Host, DoesWhatTheSceneSays) {
  const auto metrics = metrics_of({own_words("X5-host.json")});
  if (metrics.empty()) GTEST_SKIP() << "no backend here runs the scene";
  for (const auto& [backend, row] : metrics) {
    SCOPED_TRACE(backend);
    const auto expect_near = [&, &values = row](const char* name, double tolerance) {
      EXPECT_NEAR(double(values[name]["value"]), double(values[name]["truth"]), tolerance) << name;
    };
    for (const char* name : {"still", "before"}) expect_near(name, 1e-12);
    for (const char* name : {"pushed", "ramped", "struck", "spun", "twisted", "carried", "turned", "fastest"})
      expect_near(name, 1e-5);
    for (const char* name : {"first", "then", "spin"}) expect_near(name, 1e-3);
    expect_near("farthest", 2.5 / 60);
    expect_near("free", 1e-3);
    expect_near("held", 0.01);
    EXPECT_EQ(double(row["gap"]["value"]), double(row["held"]["value"])) << "a joint that was cut has no gap";
    EXPECT_FALSE(row.contains("energy_injected")) << "the host works";
  }
}

TEST(Host, OfANumberThatFailsOnTheWayIsAnErrorInWords) {
  std::ifstream in(own_words("X5-host.json"));
  Json scene = Json::parse(in);
  scene["host"][1]["force"][2] = "1 / (t - 61 / 60 + 1 / 120)";
  const auto path = std::filesystem::path(HARNESS_TEST_FOLDER) / "X5-host-that-divides.json";
  std::ofstream(path) << scene.dump(1);
  const Finished finished = plumb({"run", path.string(), "--backend", "impulse", "--json"});
  for (const Json& row : finished.rows()) {
    EXPECT_EQ(row["status"], "error");
    const std::string reason = row["reason"];
    EXPECT_NE(reason.find("the host's action on ramped at 1.008333 s"), std::string::npos) << reason;
  }
}

TEST(Quantities, LongRunsAreMeasuredInOnePass) {
  const auto metrics = metrics_of({own_words("X1-projectile.json"), "--seconds", "1000", "--dt", "0.01"});
  for (const auto& [backend, row] : metrics) {
    const double g = 9.81, seconds = 1000, truth = 10 * seconds - g * seconds * seconds / 2;
    EXPECT_NEAR(double(row["end_height"]["truth"]), truth, 1e-6) << backend;
    EXPECT_LT(double(row["end_height"]["error"]), 1e-2) << backend;
  }
}

TEST(Quantities, ATimeBeyondTheEndIsAWrongQuestion) {
  const Finished finished = plumb({"run", own_words("X4-spring.json"), "--seconds", "0.5", "--json"});
  EXPECT_EQ(finished.status, 2);
  EXPECT_NE(finished.err.find("X4-spring.json:"), std::string::npos) << finished.err;
  EXPECT_NE(finished.err.find("quantity \"length\": 1 s is beyond the scene's end at 0.5 s"), std::string::npos)
      << finished.err;
}

TEST(Quantities, SayHowFarJointsAreBeyondTheirLimits) {
  const Finished run = plumb({"run", own_words("X6-stops.json"), "--backend", MISBEHAVING_BACKEND, "--json"});
  ASSERT_EQ(run.rows().size(), 1u) << run.err;
  EXPECT_EQ(run.rows()[0].at("status"), "ok") << run.rows()[0].at("reason");
  for (const char* name : {"beyond", "half_way", "turned", "turned_one", "askew", "gap"})
    EXPECT_EQ(run.rows()[0].at("metrics").at(name).at("pass"), true) << name;
}

}  // namespace
}  // namespace plumb::harness::testing
