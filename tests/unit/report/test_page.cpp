#include "report/page/page.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <regex>
#include <set>

#include "page_reader.hpp"
#include "report/page/base64.hpp"
#include "report/page/markup.hpp"
#include "report/page/viewer_script.hpp"
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

TEST(Markup, ScriptDataCannotEndItsElement) {
  const Json hostile{{"</script><script>alert(1)</script>", "<!-- \u2028 \"'"}};
  const std::string text = script_json(hostile);
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(Json::parse(text), hostile) << "and still says the same";
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
  const std::string page = page_of(rows);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("\"><script>alert"), std::string::npos);
  EXPECT_EQ(count(page, "<script"), 3u) << "theme, data and page script";
  EXPECT_EQ(count(page, "</script"), 3u);
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
  const std::string page = page_of(rows);
  EXPECT_EQ(count(page, "<div class=\"machine\""), 2u) << "one row has lost its machine";
  EXPECT_EQ(count(page, "id=\"cost\""), 1u);
  EXPECT_EQ(count(page, "id=\"cost-1\""), 1u);
  EXPECT_EQ(page.find(">nan<"), std::string::npos);
  EXPECT_EQ(count(page_of({}), "id=\"cost\""), 1u) << "no rows at all";
}

TEST(Page, EveryFigureLinksToARowThatIsThere) {
  const std::string page = page_of(testing::sample_rows(3));
  std::set<std::string> rows;
  const std::regex id("<tr id=\"(r[0-9]+)\""), link("href=\"#(r[0-9]+)\"");
  for (std::sregex_iterator at(page.begin(), page.end(), id), end; at != end; ++at) rows.insert((*at)[1]);
  std::size_t links = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at, ++links) {
    ASSERT_TRUE(rows.count((*at)[1])) << (*at)[1];
  }
  EXPECT_EQ(rows.size(), testing::sample_rows(3).size());
  EXPECT_GT(links, rows.size());
}

TEST(Page, AsksForNothingFromOutside) {
  const std::string page = page_of(testing::sample_rows(1));
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
  const std::string page = page_of(testing::sample_rows(1), options);
  EXPECT_EQ(count(page, "<section id=\"replays\""), 1u);
  EXPECT_EQ(count(page, "G1 was left out."), 1u);
  const std::size_t expected = viewer_script.empty() ? 0 : 1;
  EXPECT_EQ(count(page, "id=\"plumb-viewer\""), expected);
  EXPECT_EQ(count(page, "class=\"plumb-replay\" data-scene=\"D1 H=10\" data-backend=\"one\">Zm9vYmFy<"), expected);
  EXPECT_EQ(count(page, "data-backend=\"&quot;two&quot;\">Zm9v<"), expected);
  EXPECT_EQ(count(page, "without node"), 1 - expected) << "said in words";
  EXPECT_EQ(page_of(testing::sample_rows(1)).find("id=\"replays\""), std::string::npos) << "nothing was recorded";
}

TEST(Page, TravelsPackedAndSaysInWordsWhatCanBeSaid) {
  const std::vector<Json> rows = testing::sample_rows(3);
  const std::string packed = testing::packed_page(rows), page = page_of(rows);
  EXPECT_LT(3 * packed.size(), page.size());
  for (const char* plain : {"<section id=\"answers\"", "<section id=\"engines\"", "<noscript>"})
    EXPECT_EQ(count(packed, plain), 1u) << plain;
  EXPECT_EQ(count(packed, "<section id=\"cost\""), 0u);
  EXPECT_EQ(count(page, "<section id=\"cost\""), 1u);
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
  const std::string page = testing::packed_page(rows);
  // Generous, for sanitizers and busy machines: what it guards against is quadratic work.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_GT(page.size(), 100000u);
  EXPECT_LT(page.size(), 10000000u);
}

}  // namespace
}  // namespace plumb::harness
