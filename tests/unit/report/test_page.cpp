#include "report/page/page.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <regex>
#include <set>

#include "base/base64.hpp"
#include "page_reader.hpp"
#include "report/page/parts/bundled_scripts.hpp"
#include "report/page/parts/markup.hpp"
#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

using testing::count;
using testing::page_of;

TEST(Markup, HtmlIsEscaped) {
  EXPECT_EQ(escape_html("<a href=\"x\">'&'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(escape_html("two\nlines\x01"), "two\nlines ");
  EXPECT_EQ(escape_html("\xff"), "\uFFFD");
}

TEST(Page, HostileTextStaysText) {
  std::vector<Json> rows = testing::sample_rows(1);
  const std::string hostile = "\"><script>alert('x')</script><img src=x onerror=alert(1)>\xff";
  for (Json& row : rows) {
    for (const char* key : {"scene", "group", "backend", "backend_version", "profile", "reason", "hash"})
      row[key] = hostile;
    row["params"][hostile] = hostile;
    row["settings"][hostile] = hostile;
    row["machine"][hostile] = hostile;
    row["metrics"][hostile] = {{"value", 1}, {"unit", hostile}, {"error", 1}, {"threshold", 1}, {"note", hostile}};
    row["time"]["phase_ms"][hostile] = 1;
  }
  rows[0]["status"] = hostile;
  rows[1]["status"] = "crashed";
  const std::string page = testing::packed_page(parse_rows(rows));
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("\"><script>alert"), std::string::npos);
  // What is drawn later is data: markup of cells is safe already, plain text is made so by the script.
  for (const Json& section : testing::packed_data(parse_rows(rows))) {
    for (const Json& block : section) {
      for (const Json& row : block.value("table", Json::object()).value("rows", Json::array()))
        EXPECT_EQ(row["c"].dump().find("<img"), std::string::npos);
    }
  }
}

TEST(Page, NullsEverywhereBreakNothing) {
  std::vector<Json> rows = testing::sample_rows(1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::size_t k = 0;
    for (auto& [key, value] : rows[i].items()) {
      if (k++ == i % rows[i].size()) value = nullptr;
    }
  }
  for (Json& metric : rows[5]["metrics"]) {
    for (auto& [key, value] : metric.items()) value = nullptr;
  }
  const std::string page = page_of(parse_rows(rows));
  EXPECT_EQ(count(page, "<div class=\"machine\""), 2u) << "one row has lost its machine";
  EXPECT_EQ(count(page, "id=\"cost\""), 1u);
  EXPECT_EQ(count(page, "id=\"cost-1\""), 1u);
  EXPECT_EQ(page.find(">nan<"), std::string::npos);
  EXPECT_EQ(count(page_of({}), "id=\"cost\""), 1u) << "no rows at all";
}

TEST(Page, EveryFigureLinksToARowThatIsThere) {
  if (!has_page_script()) GTEST_SKIP() << "built without node";
  const std::vector<Json> rows = testing::sample_rows(3);
  const std::string page = page_of(parse_rows(rows));
  const std::regex link("href=.\"#r([0-9]+)");
  std::size_t links = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at, ++links)
    ASSERT_LT(std::stoul((*at)[1]), rows.size());
  EXPECT_GT(links, rows.size());
  for (const Json& section : testing::packed_data(parse_rows(rows))) {
    for (const Json& block : section) {
      if (!block.contains("runs")) continue;
      EXPECT_EQ(block["runs"]["order"].size(), rows.size());
    }
  }
}

TEST(Page, ARunWhoseWorkerWasKilledSaysSo) {
  if (!has_page_script()) GTEST_SKIP() << "built without node";
  std::vector<Json> rows{testing::sample_row("S1", "a", 0.02, 1), testing::sample_row("S2", "a", 0.02, 1)};
  rows[1]["restarted"] = 1;
  Json runs;
  for (const Json& section : testing::packed_data(parse_rows(rows)))
    for (const Json& block : section)
      if (block.contains("runs")) runs = block["runs"]["rows"];
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_FALSE(runs[0].contains("restarted"));
  EXPECT_EQ(runs[1]["restarted"], 1);
}

/// Blocks that are data, and what stands in words.
std::string all_of(const std::vector<Json>& rows) {
  std::string out = page_of(parse_rows(rows));
  for (const Json& section : testing::packed_data(parse_rows(rows))) out += section.dump();
  return out;
}

TEST(Page, WhatHasNoTimeIsNotGivenOne) {
  if (!has_page_script()) GTEST_SKIP() << "built without node";
  std::vector<Json> rows;
  for (const char* backend : {"a", "b"}) {
    for (const int size : {10, 20}) {
      rows.push_back(testing::sample_row("S1", backend, 0.001, 1));
      rows.back()["params"]["N"] = size;
      rows.back()["counts"]["bodies"] = size;
      rows.back()["contended"] = {{"load", 3}, {"why", "load 3 on 2 cores"}};
    }
  }
  const std::string page = all_of(rows);
  EXPECT_EQ(count(page, "not timed ms"), 0u);
  EXPECT_EQ(count(page, "<small>of 0</small>"), 0u) << "of how many it is the cheapest is not known";
  EXPECT_GT(count(page, "not known"), 0u);
  EXPECT_EQ(count(page, "No scene here was run at several sizes"), 0u) << "it was: without times that count";
  EXPECT_EQ(count(page, "A time in parentheses"), 1u);
}

TEST(Page, LongListsCostNothingUntilTheyAreOpened) {
  for (const int failures : {8, 40}) {
    std::vector<Json> rows;
    for (int scene = 0; scene < failures; ++scene) {
      rows.push_back(testing::sample_row(fmt::format("S{}", scene).c_str(), "a", 0.5, 1));
      rows.push_back(testing::sample_row(fmt::format("S{}", scene).c_str(), "b", 1e-5, 1));
    }
    EXPECT_EQ(count(page_of(parse_rows(rows)), "<template><ul>") > 0, failures == 40);
  }
}

/// Rows of three engines over `scenes` scenes; of the third one's, the times of all but the first `timed` do not count.
std::vector<Json> rows_with_times(int scenes, int timed) {
  std::vector<Json> rows;
  for (int scene = 0; scene < scenes; ++scene) {
    for (const char* backend : {"a", "b", "c"}) {
      rows.push_back(testing::sample_row(fmt::format("S{}", scene).c_str(), backend, 0.001, 1));
      if (backend[0] == 'c' && scene >= timed) rows.back()["contended"] = {{"load", 3}, {"why", "load 3 on 2 cores"}};
    }
  }
  return rows;
}

TEST(Page, SpeedIsHeldAgainstErrorWhereTimesCount) {
  if (!has_page_script()) GTEST_SKIP() << "built without node";
  EXPECT_EQ(count(all_of(rows_with_times(16, 16)), "over the 16 of 16 scene variants"), 2u) << "page and data";
  EXPECT_EQ(count(all_of(rows_with_times(16, 2)), "over the 2 of 16 scene variants"), 2u);
  const std::string without = all_of(rows_with_times(16, 1));
  EXPECT_EQ(count(without, "over the 16 of 16 scene variants"), 2u);
  EXPECT_EQ(count(without, "too few runs whose time counts: c."), 2u);
  std::vector<Json> none = rows_with_times(16, 16);
  for (Json& row : none) row["contended"] = {{"load", 3}, {"why", "load 3 on 2 cores"}};
  EXPECT_EQ(count(page_of(parse_rows(none)), "No picture: too few scene variants have a time that counts"), 1u);
}

TEST(Page, StructuresOfManySizesAreNoScaling) {
  if (!has_page_script()) GTEST_SKIP() << "built without node";
  for (const bool numbers : {true, false}) {
    std::vector<Json> rows;
    for (const int bodies : {10, 20}) {
      rows.push_back(testing::sample_row("S1", "a", 0.001, 1));
      rows.back()["params"]["built"] = numbers ? Json(bodies) : Json(bodies == 10 ? "wall" : "dome");
      rows.back()["counts"]["bodies"] = bodies;
    }
    EXPECT_EQ(count(all_of(rows), "time per step against the number of bodies") > 0, numbers);
  }
}

TEST(Page, WhatIsOnlyCountedIsCountedOnce) {
  std::vector<Json> rows;
  for (int i = 0; i < 9; ++i) {
    const std::string scene = "S" + std::to_string(i);
    rows.push_back(testing::sample_row(scene.c_str(), "a", 0.5, 1));
    rows.push_back(testing::sample_row(scene.c_str(), "b", 0.001, 1));
  }
  const std::string page = page_of(parse_rows(rows));
  EXPECT_GT(count(page, "<summary>and 6 more</summary>"), 0u);
  EXPECT_EQ(count(page, "and 6 more"), count(page, "<summary>and 6 more</summary>"));
}

TEST(Page, ProblemsThatRanWithOtherSettingsOnlyAreCounted) {
  std::vector<Json> rows{testing::sample_row("S1", "a", 0.001, 1), testing::sample_row("S2", "a", 0.001, 1)};
  rows[1]["settings"] = {{"iterations", 99}};
  rows[1]["profile"] = "tuned";
  EXPECT_EQ(count(page_of(parse_rows(rows)), "1 more scene variant ran with other settings only."), 1u);
}

TEST(Page, RunsOfAProblemStandInTheOrderOfTheEngines) {
  if (!has_page_script()) GTEST_SKIP() << "built without node";
  std::vector<Json> rows{testing::sample_row("S1", "c", 0.02, 1), testing::sample_row("S1", "a", 0.02, 1),
                         testing::sample_row("S1", "b", 0.02, 1)};
  Json order;
  for (const Json& section : testing::packed_data(parse_rows(rows)))
    for (const Json& block : section)
      if (block.contains("runs")) order = block["runs"]["order"];
  EXPECT_EQ(order, Json::parse("[1, 2, 0]"));
}

TEST(Page, TimeIsToldByTheFastestRunThatPasses) {
  if (!has_page_script()) GTEST_SKIP() << "built without node";
  const std::vector<Json> rows{
      testing::sample_row("S1", "fails", 0.02, 1), testing::sample_row("S1", "passes", 0.005, 2),
      testing::sample_row("S2", "fails", 0.02, 1), testing::sample_row("S2", "passes", 0.02, 2)};
  Json plot;
  for (const Json& section : testing::packed_data(parse_rows(rows))) {
    for (const Json& block : section) {
      for (const Json& figure : block.value("figures", Json::array())) {
        if (figure["plots"][0]["description"].get<std::string>().ends_with("every engine as it ships"))
          plot = figure["plots"][0];
      }
    }
  }
  ASSERT_EQ(plot["series"].size(), 4u) << plot.dump();
  EXPECT_EQ(plot["series"][0]["points"], Json::parse(R"([{"x": 0.5, "y": 2, "r": 0}])"))
      << "of S2 nobody passes, so that it has no fastest";
  EXPECT_EQ(plot["series"][1]["points"], Json::parse(R"([{"x": 1, "y": 0.5, "r": 1}])"));
}

TEST(Page, AsksForNothingFromOutside) {
  std::string page = testing::packed_page(parse_rows(testing::sample_rows(1)));
  EXPECT_EQ(count(page, "content=\"default-src 'none'; script-src 'unsafe-inline';"), 1u) << "the browser sees to it";
  page.erase(page.rfind("<script>"));  // libraries name the namespaces of SVG
  for (const char* reference : {"http:", "https:", "src=", "@import", "url(", "<link", "fetch("}) {
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
  }
}

TEST(Markup, BytesAsText) {
  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Page, ReplaysAreEmbeddedWhereThereIsAViewer) {
  PageOptions options;
  options.replays = {{"D1 H=10", "one", "foobar"}, {"D1 H=10", "\"two\"", "foo"}};
  options.replays_note = "G1 was left out.";
  const std::string page = page_of(parse_rows(testing::sample_rows(1)), options);
  EXPECT_EQ(count(page, "<section id=\"replays\""), 1u);
  EXPECT_EQ(count(page, "G1 was left out."), 1u);
  const std::size_t expected = viewer_script.empty() ? 0 : 1;
  EXPECT_EQ(count(page, "id=\"plumb-viewer\""), expected);
  EXPECT_EQ(count(page, "class=\"plumb-replay\" data-scene=\"D1 H=10\" data-backend=\"one\" data-hue=\""), expected);
  EXPECT_EQ(count(page, ">Zm9v<"), expected);
  EXPECT_EQ(count(page, "without node"), 1 - expected) << "said in words";
  EXPECT_EQ(page_of(parse_rows(testing::sample_rows(1))).find("id=\"replays\""), std::string::npos)
      << "nothing was recorded";
}

TEST(Page, TravelsPackedAndSaysInWordsWhatCanBeSaid) {
  const std::vector<Json> rows = testing::sample_rows(3);
  const std::string packed = testing::packed_page(parse_rows(rows)), page = page_of(parse_rows(rows));
  for (const char* plain : {"<section id=\"answers\"", "<section id=\"engines\"", "<noscript>"})
    EXPECT_EQ(count(packed, plain), 1u) << plain;
  const std::size_t drawn = has_page_script() ? 1 : 0;
  EXPECT_EQ(count(packed, "\"what accuracy costs"), 0u) << "tables travel packed";
  EXPECT_EQ(count(page, "\"how often each engine reaches an error\""), drawn);
  EXPECT_EQ(count(packed, "built without node and npm"), 1 - drawn) << "said in words";
}

TEST(Page, FiveThousandRowsInSeconds) {
  std::vector<Json> rows;
  while (rows.size() < 5000) {
    for (Json row : testing::sample_rows(15)) {
      row["settings"]["margin"] = static_cast<double>(rows.size() / 1000);
      rows.push_back(std::move(row));
    }
  }
  const auto start = std::chrono::steady_clock::now();
  const std::string page = testing::packed_page(parse_rows(rows));
  // Generous, for sanitizers and busy machines: what it guards against is quadratic work.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_GT(page.size(), 100000u);
  EXPECT_LT(page.size(), 10000000u);
}

}  // namespace
}  // namespace plumb::harness
