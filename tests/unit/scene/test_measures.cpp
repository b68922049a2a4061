// The list of measures, and what scene files may ask of it.
#include <gtest/gtest.h>

#include <set>

#include "measure/measure.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness {
namespace {

TEST(Measures, HaveNamesOfTheirOwnAndADoc) {
  std::set<std::string> names;
  for (const MeasureEntry& entry : all_measures()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_GT(std::string(entry.doc).size(), 10u) << entry.name;
  }
}

TEST(Measures, KnowWhatEverySceneAsksFor) {
  for (const SceneFile& file : all_scenes()) EXPECT_NO_THROW(static_cast<void>(find_measure(file))) << file.path;
}

TEST(Measures, RefuseUnknownKindsAndArguments) {
  const auto refusal = [](const char* key, const char* to) {
    SceneFile file = find_scenes("A1").at(0);
    if (std::string(key) == "kind")
      file.json["measure"]["kind"] = to;
    else
      file.json["measure"][key] = to;
    try {
      static_cast<void>(find_measure(file));
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  EXPECT_NE(refusal("kind", "free_fal")
                .find("A1-free-fall.json:15: unknown measure \"free_fal\"; did you mean \"free_fall\"?"),
            std::string::npos)
      << refusal("kind", "free_fal");
  EXPECT_NE(refusal("bodi", "ball").find("unknown argument of measure free_fall \"bodi\"; did you mean \"body\"?"),
            std::string::npos);
}

/// Keeps what is added.
class Recorder : public MeasureContext {
 public:
  [[nodiscard]] const Scene& scene() const override { throw std::logic_error("unused"); }
  Simulation simulate(const Scene&) override { throw std::logic_error("unused"); }
  Simulation simulate(const Scene&, const SimulationOptions&) override { throw std::logic_error("unused"); }
  [[nodiscard]] const SimulationOptions& options() const override { throw std::logic_error("unused"); }
  [[nodiscard]] Backend& backend() override { throw std::logic_error("unused"); }
  void add(Metric metric) override { metrics.push_back(std::move(metric)); }

  std::vector<Metric> metrics;
};

TEST(MeasureContext, ScoresByScaleDeviationAndExpectation) {
  Recorder recorder;
  recorder.compare("a", 3, 5, 4);
  recorder.deviation("b", -2);
  recorder.expect("c", true, true);
  recorder.expect("d", true, false);
  EXPECT_EQ(recorder.metrics[0].error, 0.5);
  EXPECT_EQ(recorder.metrics[0].truth, 5);
  EXPECT_EQ(recorder.metrics[1].error, 2);
  EXPECT_EQ(recorder.metrics[1].value, -2);
  EXPECT_EQ(recorder.metrics[2].error, 0);
  EXPECT_EQ(recorder.metrics[3].error, 1);
}

}  // namespace
}  // namespace plumb::harness
