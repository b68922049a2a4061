// The scenes of the repository at other times and parameters than their own: what a file works out from dt, seconds
// and parameters holds at all that may be asked for.
#include <gtest/gtest.h>

#include <span>

#include "scene/catalogue.hpp"

namespace plumb::harness {
namespace {

/// Why the scene is not to be had; "" where it is.
std::string refusal(const SceneFile& file, const Parameters& parameters, const Times& times) {
  try {
    static_cast<void>(file.outline(parameters, times));
    return "";
  } catch (const UsageError& error) {
    return error.what();
  }
}

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

const double steps[] = {1. / 10, 1. / 30, 1. / 60, 1. / 240, 1e-3, 1e-4};

TEST(Times, EverySceneTakesAllButTooManyAndTooFew) {
  std::size_t taken = 0, refused = 0;
  for (const SceneFile& file : all_scenes()) {
    for (const Parameters& variant : file.variants) {
      const double seconds = file.outline(variant).seconds;
      for (const double dt : steps) {
        for (const std::optional<double> asked : {std::optional<double>(), {10 * seconds}, {100 * seconds}}) {
          const std::string said = refusal(file, variant, {dt, asked});
          ++(said.empty() ? taken : refused);
          EXPECT_TRUE(said.empty() || contains(said, "ask for fewer seconds or a longer dt") ||
                      contains(said, "less than one step"))
              << "dt " << dt << ": " << said;
        }
      }
    }
  }
  EXPECT_GT(taken, 10 * refused);
}

TEST(Times, GoldIsNoWorseThanAPassAtTheEndsOfEveryParameter) {
  for (const SceneFile& file : all_scenes()) {
    for (const ParameterSpec& spec : file.parameters) {
      for (const std::optional<double>& end : {spec.minimum, spec.maximum}) {
        if (!end) continue;
        for (const double dt : steps) {
          const std::string said = refusal(file, {{spec.name, *end}}, {dt, {}});
          EXPECT_FALSE(contains(said, "gold")) << "dt " << dt << ", " << spec.name << " " << *end << ": " << said;
        }
      }
    }
  }
}

std::vector<ParameterValue> ends_of(const ParameterSpec& spec) {
  std::vector<ParameterValue> ends(spec.choices.begin(), spec.choices.end());
  if (spec.minimum) ends.emplace_back(*spec.minimum);
  if (spec.maximum) ends.emplace_back(*spec.maximum);
  return ends;
}

void expect_loads_at_the_ends(const SceneFile& file, std::span<const ParameterSpec> specs, const Parameters& given) {
  for (const ParameterSpec& spec : specs) {
    for (const ParameterValue& end : ends_of(spec)) {
      Parameters parameters = given;
      parameters[spec.name] = end;
      EXPECT_EQ(refusal(file, parameters, {}), "") << spec.name;
    }
  }
}

TEST(Times, EverySceneLoadsAtTheEndsOfEveryParameterAndOfEveryTwo) {
  for (const SceneFile& file : all_scenes()) {
    std::span<const ParameterSpec> specs = file.parameters;
    for (const Parameters& variant : file.variants) expect_loads_at_the_ends(file, specs, variant);
    for (; !specs.empty(); specs = specs.subspan(1))
      for (const ParameterValue& end : ends_of(specs[0]))
        expect_loads_at_the_ends(file, specs.subspan(1), {{specs[0].name, end}});
  }
}

}  // namespace
}  // namespace plumb::harness
