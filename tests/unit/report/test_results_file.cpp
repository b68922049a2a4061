#include "rows/results_reader.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zstd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/usage_error.hpp"
#include "plumb/physics_world.hpp"
#include "rows/results_folder.hpp"
#include "rows/row.hpp"
#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

Results read(const std::string& text) {
  std::istringstream in(text);
  return read_results(in, "some.jsonl");
}

TEST(ResultsFile, EveryRowComesBackAsItWas) {
  const std::vector<Json> rows = testing::sample_rows(2);
  std::string text;
  for (const Json& row : rows) text += line_of(row) + "\n";
  const Results results = read(text);
  ASSERT_EQ(results.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(to_json(results.rows[i]), rows[i]);
  EXPECT_TRUE(results.unreadable_lines.empty());
}

/// Rows that plumb itself wrote, of every status, and of programs that told less.
TEST(ResultsFile, CommittedRowsComeBackToTheByte) {
  const std::filesystem::path results = PLUMB_RESULTS_FOLDER;
  for (const char* folder : {"xeon-16-cores", "h200"}) {
    const std::filesystem::path file = results / folder / "results.jsonl.zst";
    std::istringstream text(unpacked_text(file));
    std::size_t number = 0;
    for (std::string line; std::getline(text, line);)
      ASSERT_EQ(line_of(to_json(*read_row(line, file, ++number))), line) << file << ":" << number;
    EXPECT_GT(number, 1000u) << file;
  }
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
  EXPECT_EQ(results.rows[0].metric("error_of_it")->error, 0.25);
}

std::string refusal(const Json& row) {
  try {
    static_cast<void>(read("\n" + line_of(row) + "\n"));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ResultsFile, RowsOfOtherFormatsAreRefusedByFileAndLine) {
  Json row = testing::sample_row("S", "a", 0.5, 1);
  EXPECT_EQ(refusal(row), "");
  row["format"] = row_format + 1;
  EXPECT_EQ(refusal(row),
            "some.jsonl:2: this row has format 2, and this plumb reads 1; read it with the plumb that wrote it, or a "
            "newer one");
  row.erase("format");
  EXPECT_EQ(refusal(row).find("some.jsonl:2: this row does not say its \"format\""), 0u) << refusal(row);
  for (const Json& strange : {Json("1"), Json(0), Json(-1), Json(1.5), Json()}) {
    row["format"] = strange;
    EXPECT_NE(refusal(row).find("does not say its \"format\""), std::string::npos) << strange;
  }
}

TEST(ResultsFile, ObjectsThatAreNoRowsAreRefused) {
  EXPECT_EQ(refusal({{"event", "click"}}).find("some.jsonl:2: this is no row that plumb wrote: it has no \"scene\""),
            0u);
  Json row = testing::sample_row("S", "a", 0.5, 1);
  row["cell"] = 7;
  EXPECT_NE(refusal(row).find("no \"cell\""), std::string::npos);
}

class PackedResults : public ::testing::Test {
 protected:
  PackedResults() { std::filesystem::create_directories(folder_); }
  ~PackedResults() override { std::filesystem::remove_all(folder_); }

  static std::string packed(const std::string& text) {
    std::string bytes(ZSTD_compressBound(text.size()), '\0');
    bytes.resize(ZSTD_compress(bytes.data(), bytes.size(), text.data(), text.size(), 3));
    return bytes;
  }
  void write(const char* name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }

  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / ("plumb-packed-" + std::to_string(getpid()));
};

TEST_F(PackedResults, AreReadAndWhatWasRunSinceReplacesThem) {
  const std::string first = line_of(testing::sample_row("S", "a", 0.5, 1)) + "\n";
  const std::string other = line_of(testing::sample_row("S", "b", 0.5, 1)) + "\n";
  write("results.jsonl.zst", packed(first + other));
  EXPECT_EQ(read_results(folder_).rows.size(), 2u);
  write("results.jsonl", line_of(testing::sample_row("S", "a", 0.25, 1)) + "\n");
  const Results results = read_results(folder_);
  ASSERT_EQ(results.rows.size(), 2u);
  EXPECT_EQ(results.rows[0].metric("error_of_it")->error, 0.25);
}

TEST_F(PackedResults, ThatAreCutShortAreRefused) {
  const std::string whole = packed(line_of(testing::sample_row("S", "a", 0.5, 1)) + "\n");
  for (const std::string& bytes : {whole.substr(0, whole.size() - 1), whole.substr(0, 3), std::string("{}\n")}) {
    write("results.jsonl.zst", bytes);
    EXPECT_THROW(static_cast<void>(read_results(folder_)), Error) << bytes.size();
  }
}

TEST(ResultsFile, AMissingFolderIsTheUsersMistake) {
  EXPECT_THROW(static_cast<void>(read_results(std::filesystem::path("/no/such/folder"))), UsageError);
}

}  // namespace
}  // namespace plumb::harness
