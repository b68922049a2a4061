// The README's counts are what the program counts.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <set>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

/// The README with all runs of blanks as one, so that broken lines are found.
std::string readme() {
  std::ifstream in(PLUMB_README);
  std::string text;
  for (std::string word; in >> word;) text += word + " ";
  return text;
}

void expect_said(const std::string& words) { EXPECT_NE(readme().find(words), std::string::npos) << words; }

TEST(Readme, SaysHowManyScenesAndVariantsThereAre) {
  const std::vector<Json> scenes = plumb({"scenes", "--json"}).rows();
  const auto variants = [&](const std::function<bool(const std::string&)>& in_group) {
    std::size_t count = 0;
    for (const Json& scene : scenes)
      if (in_group(scene["group"])) count += scene["variants"].size();
    return std::to_string(count);
  };
  const auto machines =
      std::count_if(scenes.begin(), scenes.end(), [](const Json& s) { return s["group"] == "machines"; });
  expect_said("There are " + std::to_string(scenes.size()) + " scenes");
  expect_said(std::to_string(machines) + " machines in which joints and contacts work together");
  expect_said("of their " + variants([](const std::string& group) { return group == "machines"; }) + " variants");
  const std::set<std::string> apart{"machines", "published", "scale"};
  expect_said("Of the " + variants([&](const std::string& group) { return !apart.contains(group); }) + " ");
}

TEST(Readme, SaysHowManyChecksTheSamplePasses) {
  std::size_t passed = 0, checks = 0;
  for (const Json& row : plumb({"conform", SAMPLE_BACKEND, "--json"}).rows()) {
    ++checks;
    if (row["outcome"] == "passed") ++passed;
  }
  expect_said("The sample passes " + std::to_string(passed) + " of " + std::to_string(checks) + ".");
}

}  // namespace
}  // namespace plumb::harness::testing
