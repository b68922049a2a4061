// Rows say their format, and whoever reads rows refuses those of another one, with file and line.
#include <gtest/gtest.h>

#include <fstream>

#include "program.hpp"
#include "rows/row.hpp"

namespace plumb::harness::testing {
namespace {

using Words = std::vector<std::string>;

class RowFormat : public ::testing::Test {
 protected:
  /// Whoever reads results.
  [[nodiscard]] std::vector<Words> readers() const {
    const std::string out = (folder_ / "out").string(), good = (folder_ / "good").string();
    std::vector<Words> lines{{"report", out},
                             {"report", out, "--json"},
                             {"report", out, "--html", (folder_ / "page.html").string()},
                             {"report", good, "--against", out},
                             {"study", (folder_ / "study.json").string(), "--out", out}};
    for (const char* verb : {"run", "compare", "curves"})
      lines.push_back({verb, scene_, "--out", out, "--backend", MISBEHAVING_BACKEND});
    return lines;
  }

  void SetUp() override {
    std::ofstream(folder_ / "study.json")
        << R"({"name": "few", "backends": ")" MISBEHAVING_BACKEND R"(", "sets": {"scenes": ")" << scene_ << "\"}}";
    const Finished run = plumb({"run", scene_, "--param", "height=10", "--backend", SAMPLE_BACKEND, "--json", "--out",
                                (folder_ / "good").string()});
    ASSERT_EQ(run.rows().size(), 1u) << run.err;
    row_ = run.rows().front();
  }

  void expect_refused(const Json& row, const std::string& in_text) {
    std::filesystem::create_directories(folder_ / "out");
    const std::string file = (folder_ / "out" / "results.jsonl").string();
    std::ofstream(file) << row_.dump() << '\n' << row.dump() << '\n';
    for (const Words& line : readers()) {
      const Finished finished = plumb(line);
      EXPECT_EQ(finished.status, 2) << line.front() << finished.out;
      EXPECT_NE(finished.err.find(file + ":2: "), std::string::npos) << line.front() << ": " << finished.err;
      EXPECT_NE(finished.err.find(in_text), std::string::npos) << line.front() << ": " << finished.err;
      EXPECT_EQ(finished.out, "") << line.front();
    }
  }

  const std::filesystem::path folder_ = fresh_folder("row_format");
  const std::string scene_ = particle_scene(folder_);
  Json row_;
};

TEST_F(RowFormat, is_in_every_row) { EXPECT_EQ(row_["format"], row_format); }

TEST_F(RowFormat, of_newer_rows_is_refused) {
  Json newer = row_;
  newer["format"] = row_format + 1;
  expect_refused(newer, "has format 2, and this plumb reads 1");
}

TEST_F(RowFormat, is_missed_where_it_was_stripped) {
  Json stripped = row_;
  stripped.erase("format");
  expect_refused(stripped, "does not say its \"format\"");
}

TEST_F(RowFormat, of_others_is_none_of_plumb) { expect_refused({{"event", "click"}}, "no row that plumb wrote"); }

}  // namespace
}  // namespace plumb::harness::testing
