#include "report/text/csv.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

/// RFC 4180, written from the RFC: what a reader makes of the text.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, std::vector<std::string>(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"') {
        lines.back().back() += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        lines.back().back() += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      lines.back().emplace_back();
    } else if (c == '\n') {
      lines.emplace_back(1);
    } else {
      lines.back().back() += c;
    }
  }
  lines.pop_back();  // after the last newline
  return lines;
}

TEST(Csv, FieldsAreQuotedWhereTheyMustBe) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"hi\""), "\"say \"\"hi\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_field("=1+1"), "'=1+1") << "a spreadsheet would run it";
}

TEST(Csv, EveryLineHasTheHeadersFieldsAndHostileTextComesBack) {
  std::vector<Json> rows = testing::sample_rows(0);
  const std::string hostile = "a \"quoted\", text\nwith, lines";
  rows[0]["reason"] = hostile;
  rows[0]["params"]["H,\""] = hostile;
  rows[1]["metrics"] = Json::object();
  std::ostringstream out;
  write_csv(out, parse_rows(rows));
  const auto lines = parse_csv(out.str());
  std::size_t expected = 1;
  for (const Json& row : rows) expected += std::max<std::size_t>(1, row["metrics"].size());
  ASSERT_EQ(lines.size(), expected);
  const auto& header = lines[0];
  for (const auto& line : lines) ASSERT_EQ(line.size(), header.size());
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  EXPECT_EQ(lines[1][column("reason")], hostile);
  EXPECT_EQ(Json::parse(lines[1][column("params")]), rows[0]["params"]);
  EXPECT_EQ(std::stod(lines[1][column("error")]), rows[0]["metrics"]["drop"]["error"].get<double>()) << "all digits";
}

TEST(Csv, WhatIsNotFiniteIsEmpty) {
  std::vector<Json> rows{testing::sample_row("S", "b", 0.1, 1)};
  rows[0]["metrics"]["error_of_it"]["error"] = nullptr;
  std::ostringstream out;
  write_csv(out, parse_rows(rows));
  const auto lines = parse_csv(out.str());
  const auto at = static_cast<std::size_t>(std::find(lines[0].begin(), lines[0].end(), "error") - lines[0].begin());
  EXPECT_EQ(lines[1][at], "");
}

TEST(Csv, TellsWhichTimesCountAndWhatWasDeclared) {
  std::vector<Json> rows{testing::sample_row("S", "b", 0.1, 1), testing::sample_row("S", "b", 0.1, 1)};
  rows[1]["contended"] = {{"load", 9}, {"why", "load 9 on 2 cores"}};
  rows[1]["needs"] = "all";
  std::ostringstream out;
  write_csv(out, parse_rows(rows));
  const auto lines = parse_csv(out.str());
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(lines[0].begin(), lines[0].end(), name) - lines[0].begin());
  };
  EXPECT_EQ(lines[1].at(column("contended")), "");
  EXPECT_EQ(lines[2].at(column("contended")), "load 9 on 2 cores");
  EXPECT_EQ(lines[2].at(column("ms_per_simulated_second")), "");
  EXPECT_EQ(lines[2].at(column("needs")), "all");
}

}  // namespace
}  // namespace plumb::harness
