#include "report/findings/curves.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "page_reader.hpp"
#include "sample_rows.hpp"

namespace plumb::harness {
namespace {

using testing::count;
using testing::page_of;

/// A row whose engine has the knobs "passes" (10) and "parts" (4) and the choice "way" (soft).
Json row(const char* way, int passes, int parts, double error, double ms, const std::string& hash) {
  Json json = testing::sample_row("S", "b", error, ms);
  json["settings"] = {{"way", way}, {"passes", passes}, {"parts", parts}};
  json["knobs"] = {"passes", "parts"};
  json["defaults"] = Json::object();
  if (std::string(way) != "soft") json["defaults"]["way"] = "soft";
  if (passes != 10) json["defaults"]["passes"] = 10;
  if (parts != 4) json["defaults"]["parts"] = 4;
  json["hash"] = hash;
  return json;
}

/// Passes move "hard", parts move "soft"; each has a probe of the other knob.
std::vector<Json> turned_rows() {
  return {row("hard", 20, 4, 0.004, 2, "h20"), row("hard", 10, 4, 0.02, 1, "h10"), row("hard", 10, 2, 0.02, 1, "h10"),
          row("hard", 5, 4, 0.3, 0.6, "h5"),   row("soft", 10, 4, 0.002, 3, "s4"), row("soft", 5, 4, 0.002, 3, "s4"),
          row("soft", 10, 8, 0.001, 6, "s8")};
}

/// A section of the page.
std::string section(const std::string& page, const std::string& id) {
  const std::size_t at = page.find("<section id=\"" + id + "\"");
  return at == std::string::npos ? "" : page.substr(at, page.find("</section>", at) - at);
}

bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

TEST(Curves, RunAlongTheKnobsThatDoSomething) {
  const OrderedRows ordered(parse_rows(turned_rows()));
  const CurveSet curves(ordered);
  ASSERT_EQ(curves.problems.size(), 1u);
  ASSERT_EQ(curves.methods.size(), 2u);
  EXPECT_EQ(curves.methods[0].label, "way hard");
  EXPECT_EQ(curves.methods[1].label, "way soft");
  const MethodCurves& hard = curves.problems[0].methods[0];
  ASSERT_EQ(hard.curves.size(), 1u);
  EXPECT_EQ(hard.curves[0].knob, "passes");
  std::vector<Json> passes;
  for (const Row* at : hard.curves[0].rows) passes.push_back(at->settings["passes"]);
  EXPECT_EQ(passes, (std::vector<Json>{5, 10, 20})) << "by value";
  EXPECT_EQ(hard.idle, (std::vector<std::string>{"parts"}));
  const MethodCurves& soft = curves.problems[0].methods[1];
  ASSERT_EQ(soft.curves.size(), 1u);
  EXPECT_EQ(soft.curves[0].knob, "parts");
  EXPECT_EQ(soft.idle, (std::vector<std::string>{"passes"}));
}

TEST(Curves, AKnobWithoutAStateIsNotCalledIdle) {
  std::vector<Json> rows = turned_rows();
  for (Json& at : rows) at["hash"] = "";
  const OrderedRows ordered(parse_rows(rows));
  const CurveSet curves(ordered);
  for (const MethodCurves& method : curves.problems.at(0).methods) EXPECT_TRUE(method.idle.empty());
}

TEST(Curves, OtherTimesAndProfilesAreOtherCurves) {
  std::vector<Json> rows = turned_rows();
  rows[0]["dt"] = 0.005;
  rows[6]["profile"] = "matched";
  const OrderedRows ordered(parse_rows(rows));
  const CurveSet curves(ordered);
  for (const MethodCurves& method : curves.problems.at(0).methods) {
    for (const Curve& curve : method.curves) {
      for (const Row* at : curve.rows) {
        EXPECT_EQ(at->dt, curve.rows.front()->dt);
        EXPECT_EQ(at->profile, curve.rows.front()->profile);
      }
    }
  }
  EXPECT_EQ(curves.methods.size(), 3u);
  EXPECT_EQ(curves.methods.back().label, "matched, way soft");
}

TEST(Curves, LeaveOutWhatDeclaredMoreThanItsScene) {
  std::vector<Json> rows = turned_rows();
  rows.push_back(rows.front());
  rows.back()["needs"] = "all";
  const OrderedRows both(parse_rows(rows));
  EXPECT_EQ(CurveSet(both).methods.size(), 2u);
  for (Json& at : rows) at["needs"] = "all";
  const OrderedRows all(parse_rows(rows));
  EXPECT_EQ(CurveSet(all).methods.size(), 2u) << "where nothing else was run, that is the question";
}

TEST(Curves, NeedAKnobThatWasTurned) {
  const OrderedRows one(parse_rows({row("soft", 10, 4, 0.1, 1, "a"), row("hard", 10, 4, 0.1, 1, "b")}));
  EXPECT_TRUE(CurveSet(one).problems.empty()) << "methods alone are none";
  std::vector<Json> old = turned_rows();
  for (Json& at : old) {
    at.erase("knobs");
    at.erase("defaults");
  }
  const OrderedRows without(parse_rows(old));
  EXPECT_TRUE(CurveSet(without).problems.empty()) << "rows of programs that did not tell";
  const std::string page = page_of(parse_rows(old));
  EXPECT_EQ(section(page, "curves"), "");
  EXPECT_FALSE(has(page, "href=\"#curves\""));
}

TEST(Curves, EnginesWithoutKnobsStandBesideThemAsPoints) {
  std::vector<Json> rows = turned_rows();
  rows.push_back(testing::sample_row("S", "other", 0.05, 2));
  const OrderedRows ordered(parse_rows(rows));
  const CurveSet curves(ordered);
  ASSERT_EQ(curves.methods.size(), 3u);
  EXPECT_EQ(curves.methods.back().label, "other");
  EXPECT_EQ(curves.methods.front().label, "b, way hard");
  EXPECT_EQ(curves.methods[1].label, "b") << "soft is its own way";
  const MethodCurves& other = curves.problems[0].methods.back();
  ASSERT_EQ(other.curves.size(), 1u);
  EXPECT_EQ(other.curves[0].knob, "");
}

TEST(Curves, TheEnginesOwnSettingsAreKnownEvenWhereNoCellHasThem) {
  const std::vector<Json> rows{row("hard", 5, 4, 0.3, 1, "a"), row("hard", 20, 4, 0.1, 2, "b")};
  const OrderedRows ordered(parse_rows(rows));
  EXPECT_FALSE(ordered.is_default(ordered.rows[0]));
  EXPECT_EQ(ordered.configuration(ordered.rows[0]), "1/100 s, way hard, passes 5");
}

TEST(CurvesPage, HasALineAMethodAndMarksWhatShips) {
  const std::string text = section(page_of(parse_rows(turned_rows())), "curves");
  EXPECT_EQ(count(text, "\"series\":"), 1u) << "one graded metric";
  EXPECT_EQ(count(text, "\"line\":"), 2u);
  EXPECT_EQ(count(text, "\"marked\":true"), 1u) << "soft, 10, 4";
  EXPECT_TRUE(has(text, "parts changes nothing with way hard."));
  EXPECT_TRUE(has(text, "passes changes nothing with way soft."));
  EXPECT_TRUE(has(text, "threshold 0.01"));
  EXPECT_TRUE(has(text, "{\"x\":200,\"y\":0.004,\"r\":0}")) << "20 passes: 200 ms per simulated second, row 0";
}

TEST(CurvesPage, TurnedRowsAreNotAmongThoseOfWorkAndPrecision) {
  const std::string text = section(page_of(parse_rows(turned_rows())), "precision");
  EXPECT_EQ(count(text, "\"r\":"), 2u) << "way hard and way soft, knobs as they are" << text;
}

TEST(CurvesPage, RunsThatMissAYesNoQuestionAreCrossedOut) {
  std::vector<Json> rows = turned_rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double error = i == 1 ? 1 : 0;
    rows[i]["metrics"]["stands"] = {{"value", 1 - error}, {"unit", "1"},     {"truth", 1},        {"error", error},
                                    {"threshold", 0},     {"gold", nullptr}, {"pass", error == 0}};
    rows[i]["metrics"]["optional"] = {{"value", nullptr}, {"unit", "1"}, {"error", nullptr}, {"threshold", 1}};
  }
  const std::string text = section(page_of(parse_rows(rows)), "curves");
  EXPECT_EQ(count(text, "\"series\":"), 1u) << "no diagram of yes and no, nor of what nobody measured";
  EXPECT_EQ(count(text, "\"failed\":\"stands\""), 1u) << text;
}

TEST(CurvesPage, ErrorsThatAreNotFiniteLieBeyondTheFrame) {
  std::vector<Json> rows = turned_rows();
  rows[3]["metrics"]["error_of_it"]["error"] = nullptr;
  rows[3]["metrics"]["error_of_it"]["pass"] = false;
  const std::string text = section(page_of(parse_rows(rows)), "curves");
  EXPECT_EQ(count(text, "\"y\":null"), 1u) << text;
  EXPECT_EQ(count(section(page_of(parse_rows(turned_rows())), "curves"), "\"r\":"), count(text, "\"r\":"));
}

TEST(CurvesPage, CellsThatDidNotComeThroughAreNamed) {
  std::vector<Json> rows = turned_rows();
  Json refused = row("odd", 10, 4, 1, 1, "");
  refused["status"] = "unsupported";
  refused["reason"] = "joints of <kind> ball";
  rows.push_back(refused);
  const std::string text = section(page_of(parse_rows(rows)), "curves");
  EXPECT_TRUE(std::regex_search(
      text, std::regex("No point of way odd \\([^)]*way odd\\): <a href=..#r7..>unsupported</a>, joints of "
                       "&lt;kind&gt; ball\\.")))
      << text;
  rows.erase(rows.begin(), rows.end() - 1);
  EXPECT_EQ(section(page_of(parse_rows(rows)), "curves"), "")
      << "one method that did not come through is no lack of curves";
  rows.push_back(row("soft", 10, 4, 1, 1, ""));
  rows.back()["status"] = "unsupported";
  EXPECT_EQ(count(section(page_of(parse_rows(rows)), "curves"), "No point of"), 2u) << "none of two is";
  EXPECT_EQ(count(text, "#r7\\\""), 1u) << "and have no point, whatever was measured before they ended";
}

}  // namespace
}  // namespace plumb::harness
