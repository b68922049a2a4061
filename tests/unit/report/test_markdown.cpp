#include "report/text/markdown.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

TEST(Markdown, TextStaysText) {
  EXPECT_EQ(markdown_text("a|b"), "a\\|b");
  EXPECT_EQ(markdown_text("<b>&"), "&lt;b&gt;&amp;");
  EXPECT_EQ(markdown_text("*x* _y_ `z` [l](u)"), "\\*x\\* \\_y\\_ \\`z\\` \\[l\\](u)");
  EXPECT_EQ(markdown_text("two\nlines"), "two lines");
  EXPECT_EQ(markdown_text("back\\slash"), "back\\\\slash");
  EXPECT_EQ(markdown_text("@somebody"), "&#64;somebody");
}

TEST(Markdown, EveryTableLineHasAsManyCellsAsItsHeader) {
  std::vector<Json> rows = testing::sample_rows(1);
  rows[0]["reason"] = "one | two\n| three |";
  rows[0]["status"] = "crashed";
  rows[3]["scene"] = "pipe|scene";
  std::ostringstream out;
  write_markdown(out, parse_rows(rows));
  std::istringstream in(out.str());
  std::size_t cells = 0, tables = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] != '|') {
      cells = 0;
      continue;
    }
    std::size_t bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
    if (cells == 0) ++tables;
    if (cells == 0) cells = bars;
    ASSERT_EQ(bars, cells) << line;
  }
  EXPECT_EQ(tables, 4u);
}

TEST(Markdown, NoTableHoldsTimesOfTwoMachines) {
  std::vector<Json> rows{testing::sample_row("S", "a", 1e-6, 1), testing::sample_row("S", "b", 1e-6, 2)};
  rows[0]["machine"] = {{"cpu", "one"}};
  rows[1]["machine"] = {{"cpu", "two"}};
  std::ostringstream out;
  write_markdown(out, parse_rows(rows));
  const std::size_t one = out.str().find("# one"), two = out.str().find("# two");
  ASSERT_NE(one, std::string::npos);
  ASSERT_NE(two, std::string::npos);
  EXPECT_EQ(out.str().substr(one, two - one).find("**b**"), std::string::npos);
}

TEST(Markdown, ARunThatFailsHasADagger) {
  const std::vector<Json> rows{testing::sample_row("S", "a", 0.5, 1), testing::sample_row("S", "b", 1e-6, 2)};
  std::ostringstream out;
  write_markdown(out, parse_rows(rows));
  EXPECT_NE(out.str().find("| S | 2 | 1.00\u2020 | 2.00 |"), std::string::npos) << out.str();
}

}  // namespace
}  // namespace plumb::harness
