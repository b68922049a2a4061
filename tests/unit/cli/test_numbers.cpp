// Options that are numbers refuse what is none, and say by name what they want.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cli/manual/option_table.hpp"
#include "parser.hpp"
#include "shell.hpp"

namespace plumb::harness::testing {
namespace {

/// What the parser says of a line; "" where it takes it. No verb does anything.
std::string said(std::vector<std::string> words) {
  Parser parser;
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  try {
    parser.program.parse(words);
  } catch (const Parsed&) {
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "";
}

TEST(Numbers, AreRefusedByNameWhereverTheyAreNone) {
  const std::set<std::string> numbers{"FLOAT", "UINT", "SECONDS", "MB"};
  Parser parser;
  int looked_at = 0;
  for (const VerbEntry& verb : table_of(parser.program).verbs) {
    for (const OptionEntry& option : verb.options) {
      if (option.positional || !numbers.contains(option.value)) continue;
      ++looked_at;
      const std::string name = option.names.front();
      for (const char* value : {"fubar", "nan", "1.5x", ""}) {
        const std::string text = said({verb.name, name + "=" + value});
        EXPECT_EQ(text.find(name + ": "), 0u) << verb.name << ": " << text;
        EXPECT_EQ(text.find("not in range"), std::string::npos) << text;
        EXPECT_LT(text.size(), 200u) << text;
      }
    }
  }
  EXPECT_GE(looked_at, 25);
}

TEST(Numbers, AreToldWhatWouldDo) {
  const std::string above = "must be a number above 0, not ", from = "must be a number of 0 or more, not ";
  const auto expect = [](const std::vector<std::string>& words, const std::string& text) {
    EXPECT_EQ(said(words), text);
  };
  for (const char* value : {"-1", "0", "nan", "inf", "1e400"}) {
    for (const char* verb : {"run", "compare", "curves", "pairs", "conform"})
      expect({verb, "A1", "--timeout", value}, "--timeout: " + above + "\"" + value + "\"");
    expect({"run", "A1", "--judge-timeout", value}, "--judge-timeout: " + above + "\"" + value + "\"");
    expect({"solve", "x", "--tolerance", value}, "--tolerance: " + above + "\"" + value + "\"");
    expect({"export", "x", "--frames", "y", "--fps", value}, "--fps: " + above + "\"" + value + "\"");
  }
  expect({"run", "A1", "--memory-limit", "-1"}, "--memory-limit: " + from + "\"-1\"");
  expect({"report", "x", "--against", "y", "--error-limit", "inf"}, "--error-limit: " + from + "\"inf\"");
  expect({"report", "x", "--against", "y", "--time-limit", "-2"}, "--time-limit: " + from + "\"-2\"");
  expect({"export", "x", "--png", "y", "--at", "-2"}, "--at: " + from + "\"-2\"");
  expect({"study", "quick", "--confidence", "nan"}, "--confidence: must be a number from 0.0001 to 0.99, not \"nan\"");
  expect({"run", "A1", "--threads", "0"}, "--threads: must be a whole number from 1 to 4096, not \"0\"");
  expect({"run", "A1", "--repeat", "1.5"}, "--repeat: must be a whole number from 1 to 100000, not \"1.5\"");
  expect({"report", "x", "--replays", "-1"}, "--replays: must be a whole number from 0 to 1000000, not \"-1\"");
  expect({"problem", "D7", "--step", "-1"}, "--step: must be a whole number from 0 to 10000000, not \"-1\"");
}

TEST(Numbers, AreTaken) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"run", "A1", "--timeout", "0.5", "--judge-timeout", "1e3", "--memory-limit", "0", "--threads", "4096"},
           {"report", "x", "--against", "y", "--error-limit", "0", "--time-limit", "0.1", "--replays", "0"},
           {"export", "x", "--png", "y", "--at", "0", "--frames", "z", "--fps", "1e-3"},
           {"study", "quick", "--confidence", "0.99"},
           {"solve", "x", "--tolerance", "1e-12"}})
    EXPECT_EQ(said(words), "");
}

TEST(Numbers, ThatAreLongAreToldInShort) {
  const Said wrong = in_bash(PLUMB_PROGRAM " pairs --timeout " + std::string(5000, '7') + "x");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.text.find("plumb: --timeout: must be a number above 0, not \"777"), std::string::npos) << wrong.text;
  EXPECT_LT(wrong.text.size(), 200u);
}

}  // namespace
}  // namespace plumb::harness::testing
