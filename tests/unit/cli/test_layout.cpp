// Text for terminals: broken at blanks, indented, never cut; and the sheets of scenes within 80 columns.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "cli/output/layout.hpp"
#include "cli/output/scene_sheet.hpp"
#include "scene/catalogue.hpp"
#include "shell.hpp"

namespace plumb::harness::testing {
namespace {

TEST(Layout, BreaksAtBlanks) {
  EXPECT_EQ(wrapped("aa bb cc dd", 2, 8), "  aa bb\n  cc dd");
  EXPECT_EQ(wrapped("aa bb", 4, 40), "    aa bb");
  EXPECT_EQ(wrapped("a-word-longer-than-the-line b", 0, 10), "a-word-longer-than-the-line\nb");
  EXPECT_EQ(entry("ab", "one two three", 4, 15), "  ab    one two\n        three\n");
  EXPECT_EQ(entry("abcdefg", "one", 4, 40), "  abcdefg\n        one\n");
  EXPECT_EQ(entry("ab", "", 4, 40), "  ab\n");
}

TEST(SceneSheet, HasAllOfEveryScene) {
  for (const SceneFile& file : all_scenes()) {
    if (file.id.starts_with("G")) continue;  // large ones, which take long to make
    SCOPED_TRACE(file.id);
    const std::string sheet = scene_sheet(file, 80);
    for (const ParameterSpec& spec : file.parameters)
      EXPECT_NE(sheet.find("\n  " + spec.name + " "), std::string::npos);
    for (const MetricSpec& spec : file.metrics)
      EXPECT_NE(sheet.find("\n  " + spec.name), std::string::npos) << spec.name;
    EXPECT_NE(sheet.find("Measure:\n  " + file.json["measure"]["kind"].get<std::string>()), std::string::npos);
    EXPECT_NE(sheet.find("Example:\n  plumb run " + file.id), std::string::npos);
    std::istringstream lines(sheet);
    for (std::string line; std::getline(lines, line);)
      EXPECT_TRUE(line.size() <= 80 || line.find(' ', line.find_first_not_of(' ')) == std::string::npos ||
                  line.find(file.path.string()) != std::string::npos || line.find("plumb run") != std::string::npos)
          << line;
  }
}

TEST(SceneSheet, TellsParametersThresholdsAndSteps) {
  const std::string sheet = scene_sheet(find_scenes("A1").at(0), 100);
  for (const char* part :
       {"A1 integrator/free-fall: Free fall (core)", "Truth: drop g T^2 / 2", "120 of 0.0166667 s, 2 s",
        "default 100 m; from 25 to 10000 m", "passes up to an error of 1.01 * dt / seconds = 0.008417",
        "gold up to 1e-06", "drop and speed of a body let go at rest", "plumb run A1 --param height=100"})
    EXPECT_NE(sheet.find(part), std::string::npos) << part << "\n" << sheet;
}

TEST(Verbs, TellOfOneThingOrAnswerWithTheNearest) {
  const Said one = in_bash(PLUMB_PROGRAM " scenes D1");
  EXPECT_EQ(one.status, 0);
  EXPECT_NE(one.text.find("Tower of cubes"), std::string::npos);
  EXPECT_NE(one.text.find("Metrics:"), std::string::npos);
  const Said group = in_bash(PLUMB_PROGRAM " scenes stacking");
  EXPECT_EQ(group.text.find("Metrics:"), std::string::npos) << "a group is a list";
  for (const auto& [line, nearest] : {std::pair{"scenes towr", "\"tower\""}, std::pair{"measures towr", "\"tower\""},
                                      std::pair{"measures quantites", "\"quantities\""}}) {
    const Said wrong = in_bash(std::string(PLUMB_PROGRAM " ") + line);
    EXPECT_EQ(wrong.status, 2) << line;
    EXPECT_NE(wrong.text.find(nearest), std::string::npos) << wrong.text;
  }
}

}  // namespace
}  // namespace plumb::harness::testing
