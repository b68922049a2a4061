// Reports that hold results against earlier ones, as continuous integration uses them; and several folders in one.
#include <gtest/gtest.h>

#include <fstream>

#include "program.hpp"
#include "rows/row.hpp"

namespace plumb::harness::testing {
namespace {

namespace fs = std::filesystem;

Json row_with(double error, const char* cpu) {
  const Json metric{{"value", error}, {"unit", "m"},       {"truth", 0},
                    {"error", error}, {"threshold", 0.01}, {"pass", error <= 0.01}};
  return {{"format", row_format},
          {"scene", "X1"},
          {"params", Json::object()},
          {"backend", "engine"},
          {"settings", Json::object()},
          {"profile", "default"},
          {"dt", 0.01},
          {"seconds", 1},
          {"threads", 1},
          {"status", error <= 0.01 ? "ok" : "failed"},
          {"metrics", {{"way", metric}}},
          {"time", {{"ms_per_step", {{"median", 1.0}}}}},
          {"machine", {{"cpu", cpu}, {"cores", 2}}},
          {"cell", "X1"}};
}

std::string folder_with(const std::string& name, const std::vector<std::pair<std::string, Json>>& files) {
  const fs::path folder = fresh_folder(name);
  for (const auto& [file, row] : files) std::ofstream(folder / file) << row.dump() << '\n';
  return folder.string();
}

TEST(Against, strict_fails_where_something_got_worse_and_only_there) {
  const std::string before = folder_with("against_before", {{"results.jsonl", row_with(0.004, "X")}});
  const std::string worse = folder_with("against_worse", {{"results.jsonl", row_with(0.02, "X")}});
  const Finished strict = plumb({"report", worse, "--against", before, "--strict"});
  EXPECT_EQ(strict.status, 1) << strict.err;
  EXPECT_NE(strict.out.find("threshold 0.01"), std::string::npos) << strict.out;
  EXPECT_EQ(plumb({"report", worse, "--against", before}).status, 0);
  EXPECT_EQ(plumb({"report", before, "--against", worse, "--strict"}).status, 0) << "better";
  const Finished json = plumb({"report", worse, "--against", before, "--json"});
  ASSERT_EQ(json.rows().size(), 1u) << json.out;
  EXPECT_EQ(json.rows()[0]["worse"].size(), 1u);
  const Finished markdown = plumb({"report", worse, "--against", before, "--md"});
  EXPECT_NE(markdown.out.find("## Worse"), std::string::npos) << markdown.out;
  const std::string page = worse + "/page.html";
  EXPECT_EQ(plumb({"report", worse, "--against", before, "--html", page, "--strict"}).status, 1);
  EXPECT_TRUE(fs::exists(page)) << "the page is written all the same";
}

TEST(Against, times_may_count_for_nothing) {
  Json slow = row_with(0.004, "X");
  slow["time"]["ms_per_step"]["median"] = 5.0;
  const std::string before = folder_with("against_fast", {{"results.jsonl", row_with(0.004, "X")}});
  const std::string after = folder_with("against_slow", {{"results.jsonl", slow}});
  EXPECT_EQ(plumb({"report", after, "--against", before, "--strict"}).status, 1);
  const Finished ignored = plumb({"report", after, "--against", before, "--strict", "--ignore-times"});
  EXPECT_EQ(ignored.status, 0) << ignored.out;
  EXPECT_NE(ignored.out.find("times do not count"), std::string::npos) << ignored.out;
  EXPECT_EQ(plumb({"report", after, "--ignore-times"}).status, 2) << "against what?";
}

TEST(Against, a_baseline_without_rows_is_the_users_mistake) {
  const std::string results = folder_with("against_results", {{"results.jsonl", row_with(0.004, "X")}});
  const std::string empty = folder_with("against_empty", {});
  const Finished finished = plumb({"report", results, "--against", empty});
  EXPECT_EQ(finished.status, 2);
  EXPECT_NE(finished.err.find(empty), std::string::npos) << finished.err;
  EXPECT_EQ(plumb({"report", results, "--strict"}).status, 2) << "strict about what?";
}

TEST(Report, takes_all_results_of_a_folder_and_several_folders) {
  Json other = row_with(0.004, "X");
  other["scene"] = other["cell"] = "X2";
  const std::string ranks =
      folder_with("report_ranks", {{"results.jsonl", row_with(0.004, "X")}, {"results-1.jsonl", other}});
  EXPECT_EQ(plumb({"report", ranks, "--json"}).rows().size(), 2u);
  const std::string elsewhere = folder_with("report_elsewhere", {{"results.jsonl", row_with(0.005, "Y")}});
  EXPECT_EQ(plumb({"report", ranks, elsewhere, "--json"}).rows().size(), 3u);
  const std::string page = ranks + "/page.html";
  EXPECT_EQ(plumb({"report", ranks, elsewhere, "--html", page}).status, 0);
  std::ifstream in(page);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find("2 machines"), std::string::npos);
}

}  // namespace
}  // namespace plumb::harness::testing
