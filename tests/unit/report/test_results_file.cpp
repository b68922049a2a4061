#include "report/results_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "sample_rows.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {
namespace {

Results read(const std::string& text) {
  std::istringstream in(text);
  return read_results(in);
}

TEST(ResultsFile, EveryRowComesBackAsItWas) {
  const std::vector<Json> rows = testing::sample_rows(2);
  std::string text;
  for (const Json& row : rows) text += line_of(row) + "\n";
  const Results results = read(text);
  EXPECT_EQ(results.rows, rows);
  EXPECT_TRUE(results.unreadable_lines.empty());
}

TEST(ResultsFile, ATornLastLineIsIgnoredWhereverItTore) {
  const std::string whole = line_of(testing::sample_row("S", "a", 0.1, 1));
  const std::string last = line_of(testing::sample_row("S", "b", 0.1, 1));
  for (std::size_t kept = 0; kept < last.size(); ++kept) {
    const Results results = read(whole + "\n" + last.substr(0, kept));
    ASSERT_EQ(results.rows.size(), 1u) << kept;
    ASSERT_TRUE(results.unreadable_lines.empty()) << kept;
  }
  EXPECT_EQ(read(whole + "\n" + last).rows.size(), 2u) << "a last line may lack its newline and be whole";
}

TEST(ResultsFile, ABrokenLineWithinIsReportedAndTheRestRead) {
  const std::string whole = line_of(testing::sample_row("S", "a", 0.1, 1));
  const Results results = read("{\"scene\":\n\n" + whole + "\n[1]\n");
  EXPECT_EQ(results.rows.size(), 1u);
  EXPECT_EQ(results.unreadable_lines, (std::vector<std::size_t>{1, 4}));
}

TEST(ResultsFile, ACellRunAgainReplacesItsRow) {
  const std::string first = line_of(testing::sample_row("S", "a", 0.5, 1));
  const std::string other = line_of(testing::sample_row("S", "b", 0.5, 1));
  const std::string again = line_of(testing::sample_row("S", "a", 0.25, 1));
  const Results results = read(first + "\n" + other + "\n" + again + "\n");
  ASSERT_EQ(results.rows.size(), 2u);
  EXPECT_EQ(results.rows[0]["metrics"]["error_of_it"]["error"], 0.25);
}

TEST(ResultsFile, AMissingFolderIsTheUsersMistake) {
  EXPECT_THROW(static_cast<void>(read_results(std::filesystem::path("/no/such/folder"))), UsageError);
}

}  // namespace
}  // namespace plumb::harness
