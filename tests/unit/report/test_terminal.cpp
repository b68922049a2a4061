#include "report/text/terminal.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "base/format.hpp"
#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

std::vector<std::string> lines_of(const std::ostringstream& out) {
  std::vector<std::string> lines;
  std::istringstream in(out.str());
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Terminal, NoLineIsWiderThanTheTerminal) {
  const std::vector<Json> rows = testing::sample_rows(3);
  for (const int width : {40, 80, 100, 200}) {
    std::ostringstream table, comparison;
    print_table(table, parse_rows(rows), width, false);
    print_comparison(comparison, parse_rows(rows), width, false);
    for (const auto* out : {&table, &comparison}) {
      for (const std::string& line : lines_of(*out))
        ASSERT_LE(text_width(line), static_cast<std::size_t>(width)) << line;
    }
  }
}

TEST(Terminal, ATableHasALineACellAndSaysWhyNot) {
  std::vector<Json> rows{testing::sample_row("A1", "good", 1e-6, 0.5), testing::sample_row("A1", "bad", 0.5, 0.5),
                         testing::sample_row("A1", "none", 0.5, 0.5)};
  rows[2]["status"] = "unsupported";
  rows[2]["reason"] = "need ccd: the engine has none";
  std::ostringstream out;
  print_table(out, parse_rows(rows), 0, false);
  const auto lines = lines_of(out);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[1], "A1     good     gold           0.500  error_of_it 1e-6 ≤ 0.01");
  EXPECT_EQ(lines[2], "A1     bad      failed         0.500  error_of_it 0.500 > 0.01");
  EXPECT_EQ(lines[3], "A1     none     unsupported    0.500  need ccd: the engine has none");
}

TEST(Terminal, TextFromResultsCannotMoveTheCursor) {
  std::vector<Json> rows{testing::sample_row("A1", "b\x1b[2J", 0.5, 0.5)};
  rows[0]["status"] = "error";
  rows[0]["reason"] = "line one\nline two\x1b]0;title\x07";
  std::ostringstream table, comparison;
  print_table(table, parse_rows(rows), 0, false);
  print_comparison(comparison, parse_rows(rows), 0, false);
  EXPECT_EQ((table.str() + comparison.str()).find('\x1b'), std::string::npos);
  EXPECT_EQ(lines_of(table).size(), 2u);
}

TEST(Terminal, ColourOnlyWhereAsked) {
  std::ostringstream plain, coloured;
  print_table(plain, parse_rows(testing::sample_rows(0)), 100, false);
  print_table(coloured, parse_rows(testing::sample_rows(0)), 100, true);
  EXPECT_EQ(plain.str().find('\x1b'), std::string::npos);
  EXPECT_NE(coloured.str().find("\x1b[31mfailed\x1b[0m"), std::string::npos);
}

TEST(Terminal, BracketsAndStarsAreExplained) {
  std::vector<Json> rows{testing::sample_row("A1", "b", 1e-6, 0.5), testing::sample_row("A2", "b", 1e-6, 0.5)};
  std::ostringstream plain;
  print_comparison(plain, parse_rows(rows), 80, false);
  EXPECT_EQ(plain.str().find("other"), std::string::npos);
  for (Json& row : rows) row["settings"] = {{"passes", 10}}, row["defaults"] = Json::object();
  rows[0]["contended"] = {{"load", 9}, {"why", "load 9 on 2 cores"}};
  rows[1]["settings"]["passes"] = 1;
  rows[1]["defaults"]["passes"] = 10;
  std::ostringstream told;
  print_comparison(told, parse_rows(rows), 80, false);
  EXPECT_NE(told.str().find("(0.500)"), std::string::npos) << told.str();
  EXPECT_NE(told.str().find("(ms): the machine had other work"), std::string::npos);
  EXPECT_NE(told.str().find("gold*"), std::string::npos);
  EXPECT_NE(told.str().find("*: it ran with other settings"), std::string::npos);
}

TEST(Terminal, NoRowsAreNoCrash) {
  std::ostringstream out;
  print_table(out, {}, 80, true);
  print_comparison(out, {}, 80, true);
}

}  // namespace
}  // namespace plumb::harness
