// The examples that end each verb's help are lines that the program takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "cli/manual/option_table.hpp"
#include "parser.hpp"
#include "scene/catalogue.hpp"
#include "scene/parameters.hpp"
#include "shell.hpp"

namespace plumb::harness::testing {
namespace {

/// The words after "plumb" of a line: what a shell or another program does before and after it is left out.
std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line.substr(line.find("plumb ") + 6));
  std::vector<std::string> words;
  for (std::string word; in >> word && word != "|";) {
    if (word.ends_with(')')) word.pop_back();
    words.push_back(word);
  }
  return words;
}

std::vector<ExampleEntry> all_examples() {
  Parser parser;
  std::vector<ExampleEntry> all;
  for (const VerbEntry& verb : table_of(parser.program).verbs)
    all.insert(all.end(), verb.examples.begin(), verb.examples.end());
  return all;
}

TEST(Examples, EndTheHelpOfEveryVerb) {
  Parser parser;
  for (const VerbEntry& verb : table_of(parser.program).verbs) {
    SCOPED_TRACE(verb.name);
    EXPECT_GE(verb.examples.size(), 2u);
    const std::string help = parser.program.get_subcommand(verb.name)->help();
    const auto heading = help.find("Examples:\n");
    ASSERT_NE(heading, std::string::npos) << help;
    EXPECT_GT(heading, help.rfind("--help")) << "options come before";
    for (const ExampleEntry& example : verb.examples) {
      EXPECT_NE(help.find(example.line, heading), std::string::npos);
      EXPECT_NE(example.line.find("plumb " + verb.name), std::string::npos) << example.line;
    }
  }
}

TEST(Examples, AreLinesThatTheProgramTakes) {
  for (const ExampleEntry& example : all_examples()) {
    SCOPED_TRACE(example.line);
    Parser parser;
    std::vector<std::string> words = words_of(example.line);
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    EXPECT_THROW(parser.program.parse(words), Parsed);
  }
}

TEST(Examples, NameScenesAndParametersThatAre) {
  const std::set<std::string> with_scenes{"run", "compare", "curves", "problem", "scenes"};
  for (const ExampleEntry& example : all_examples()) {
    SCOPED_TRACE(example.line);
    const std::vector<std::string> words = words_of(example.line);
    if (!with_scenes.contains(words.front())) continue;
    std::vector<SceneFile> scenes;
    for (std::size_t i = 1; i < words.size() && !words[i].starts_with("-"); ++i)
      if (!words[i].ends_with(".json"))
        for (SceneFile& scene : find_scenes(words[i])) scenes.push_back(std::move(scene));
    for (std::size_t i = 1; i + 1 < words.size(); ++i) {
      if (words[i] != "--param") continue;
      const auto equals = words[i + 1].find('=');
      const ParameterSpec& spec = find_parameter(scenes.at(0), words[i + 1].substr(0, equals));
      EXPECT_NO_THROW(static_cast<void>(parse_parameter(spec, words[i + 1].substr(equals + 1))));
    }
  }
}

TEST(Examples, ThatOnlyTellRunForReal) {
  const std::set<std::string> quick{"scenes", "measures"};
  int ran = 0;
  for (const ExampleEntry& example : all_examples()) {
    const std::vector<std::string> words = words_of(example.line);
    const bool tells = quick.contains(words.front()) || example.line.find("--print") != std::string::npos ||
                       example.line.find("--list") != std::string::npos;
    if (!tells) continue;
    const Said said = in_bash("cd /tmp && PATH=$(dirname " PLUMB_PROGRAM "):$PATH && " + example.line);
    EXPECT_EQ(said.status, 0) << example.line << "\n" << said.text;
    EXPECT_GT(said.text.size(), 100u) << example.line;
    ++ran;
  }
  EXPECT_GE(ran, 7);
}

}  // namespace
}  // namespace plumb::harness::testing
