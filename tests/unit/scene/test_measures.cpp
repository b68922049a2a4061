// The list of measures, and what scene files may ask of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "measure/registry/registry.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness {
namespace {

/// Whether to make the scene would take long.
bool is_large(const Parameters& variant) {
  return std::any_of(variant.begin(), variant.end(), [](const auto& parameter) {
    const auto* number = std::get_if<double>(&parameter.second);
    return number != nullptr && *number > 5000;
  });
}

TEST(Measures, HaveNamesOfTheirOwnAndADoc) {
  std::set<std::string> names;
  for (const MeasureEntry& entry : all_measures()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_GT(std::string(entry.doc).size(), 10u) << entry.name;
  }
}

TEST(Measures, AreThoseOfTheSchema) {
  std::ifstream file(std::string(PLUMB_SCENES_FOLDER) + "/scene.schema.json");
  const auto schema = nlohmann::json::parse(file);
  std::vector<std::string> names;
  for (const MeasureEntry& entry : all_measures()) names.emplace_back(entry.name);
  EXPECT_EQ(schema.at("properties").at("measure").at("properties").at("kind").at("enum"), nlohmann::json(names));
}

TEST(Measures, KnowWhatEverySceneAsksFor) {
  for (const SceneFile& file : all_scenes()) {
    EXPECT_NO_THROW(static_cast<void>(find_measure(file))) << file.path;
    for (const Parameters& variant : file.variants) {
      if (is_large(variant)) continue;
      EXPECT_NO_THROW(check_measure(file, file.instantiate(variant))) << file.path;
    }
  }
}

/// How A1's measure is refused with another value for a key; without one when the value is null.
std::string refusal(const char* key, const nlohmann::json& to) {
  SceneFile file = find_scenes("A1").at(0);
  nlohmann::json& measure = file.json["measure"];
  if (to.is_null())
    measure.erase(key);
  else
    measure[key] = to;
  try {
    check_measure(file, file.instantiate({}));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Measures, RefuseUnknownKindsAndArguments) {
  EXPECT_NE(refusal("kind", "free_fal")
                .find("A1-free-fall.json:15: unknown measure \"free_fal\"; did you mean \"free_fall\"?"),
            std::string::npos)
      << refusal("kind", "free_fal");
  EXPECT_NE(refusal("bodi", "ball").find("unknown argument of measure free_fall \"bodi\"; did you mean \"body\"?"),
            std::string::npos);
}

TEST(Measures, RefuseArgumentsThatAreMissingOrOfAnotherKind) {
  EXPECT_NE(
      refusal("body", nullptr).find("A1-free-fall.json:15: measure free_fall needs the argument \"body\": the name"),
      std::string::npos)
      << refusal("body", nullptr);
  EXPECT_NE(
      refusal("body", 3).find("A1-free-fall.json:15: argument \"body\" of measure free_fall must be the name of a "
                              "body, not 3"),
      std::string::npos)
      << refusal("body", 3);
  EXPECT_NE(refusal("body", "bal").find("A1-free-fall.json:15: scene A1: unknown body \"bal\"; did you mean \"ball\"?"),
            std::string::npos)
      << refusal("body", "bal");
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
