// Two engines against each other: which scenes tell them apart, in which order, and who is ahead.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "base/format.hpp"
#include "report/findings/duel.hpp"
#include "report/page/duel_page.hpp"
#include "report/text/duel_text.hpp"
#include "sample_rows.hpp"

namespace plumb::harness::testing {
namespace {

const std::array<std::string, 2> names{"alpha", "omega"};

/// Errors of one metric with threshold 0.01 and gold 1e-4, by scene.
struct Ran {
  const char* scene;
  double first, second;
  double first_ms = 1, second_ms = 2;
};

/// A duel points into the rows.
struct Made {
  std::vector<Row> first, second;
  [[nodiscard]] Duel duel() const { return duel_of(names, first, second); }
};

Made made(const std::vector<Ran>& runs) {
  Made made;
  for (const Ran& run : runs) {
    made.first.push_back(parse_row(sample_row(run.scene, "alpha", run.first, run.first_ms), made.first.size()));
    made.second.push_back(parse_row(sample_row(run.scene, "omega", run.second, run.second_ms), made.second.size()));
  }
  return made;
}

std::vector<std::string> titles(const Duel& duel) {
  std::vector<std::string> out;
  for (const DuelScene& scene : duel.apart) out.push_back(scene.best.pair.title());
  return out;
}

TEST(Duel, ranks_passing_before_verdicts_before_errors_before_what_is_wrong_in_both) {
  const Made rows = made({{"W", 0.02, 2.0},       // both fail
                          {"E", 0.002, 0.006},    // both pass, 3 times
                          {"F", 0.0002, 0.008},   // both pass, 40 times
                          {"G", 0.00005, 0.001},  // gold, pass
                          {"P", 0.5, 0.001}});    // fails, passes
  const Duel duel = rows.duel();
  EXPECT_EQ(titles(duel), (std::vector<std::string>{"P", "G", "F", "E", "W"}));
  EXPECT_EQ(duel.apart[0].best.apart, Apart::passes);
  EXPECT_EQ(duel.apart[0].best.ahead, 1u);
  EXPECT_EQ(duel.apart[1].best.apart, Apart::verdict);
  EXPECT_EQ(duel.apart[2].best.apart, Apart::error);
  EXPECT_NEAR(duel.apart[2].best.factor, 40, 1e-9);
  EXPECT_EQ(duel.apart[4].best.apart, Apart::wrong);
  EXPECT_EQ(duel.ahead, (std::array<std::size_t, 2>{4, 1}));
}

TEST(Duel, errors_that_differ_by_less_than_the_telling_factor_tell_nothing) {
  const Made rows = made({{"A", 0.004, 0.0079}, {"B", 0.004, 0.0081}});
  const Duel duel = rows.duel();
  EXPECT_EQ(titles(duel), std::vector<std::string>{"B"});
  ASSERT_EQ(duel.alike.size(), 1u);
  EXPECT_EQ(duel.alike[0].title(), "A");
}

TEST(Duel, errors_far_below_their_limit_are_equally_good) {
  // A thousandth of the threshold 0.01 is 1e-5: both are gold, and rounding decides nothing.
  const Made rows = made({{"A", 1e-17, 1e-12}, {"B", 1e-12, 9e-5}});
  const Duel duel = rows.duel();
  EXPECT_EQ(titles(duel), std::vector<std::string>{"B"});
  EXPECT_NEAR(duel.apart[0].best.factor, 9, 1e-9);
}

TEST(Duel, who_does_not_come_through_loses_to_who_fails) {
  Made rows = made({{"A", 0.5, 0.5}, {"B", 0.001, 0.001}});
  for (Row& row : rows.second) {
    row.status = "crashed";
    row.reason = "SIGSEGV in step 10";
    row.metrics.clear();
  }
  const Duel duel = rows.duel();
  EXPECT_EQ(titles(duel), (std::vector<std::string>{"B", "A"}));
  EXPECT_EQ(duel.apart[0].best.apart, Apart::passes);
  EXPECT_EQ(duel.apart[1].best.apart, Apart::verdict);
  EXPECT_EQ(duel.ahead, (std::array<std::size_t, 2>{2, 0}));
  EXPECT_EQ(duel.apart[0].best.metric, "");
  EXPECT_EQ(advantage_text(duel.apart[0].best), "passes");
  EXPECT_EQ(advantage_text(duel.apart[1].best), "comes through");
  EXPECT_FALSE(duel.time_factor) << "half a run has no time";
}

TEST(Duel, what_an_engine_cannot_run_is_no_loss) {
  Made rows = made({{"A", 0.001, 0.5}, {"B", 0.001, 0.5}});
  for (Row* row : {&rows.second[0], &rows.second[1], &rows.first[1]}) {
    row->status = "unsupported";
    row->reason = "no height fields";
  }
  const Duel duel = rows.duel();
  EXPECT_TRUE(duel.apart.empty());
  EXPECT_EQ(duel.one_only.size(), 1u);
  EXPECT_EQ(duel.neither.size(), 1u);
  const std::vector<std::string> lines = describe_silence(duel);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "Only alpha runs A (omega: unsupported: no height fields).");
  EXPECT_EQ(lines[1], "Neither runs B (alpha: unsupported: no height fields; omega: unsupported: no height fields).");
}

TEST(Duel, a_scene_stands_once_by_the_variant_that_tells_most) {
  Made rows = made({{"D1", 0.001, 0.003}, {"D1", 0.001, 0.5}, {"D1", 0.001, 0.001}});
  for (std::vector<Row>* side : {&rows.first, &rows.second}) {
    for (std::size_t i = 0; i < side->size(); ++i) (*side)[i].params = {{"H", 10 * (i + 1)}};
  }
  const Duel duel = rows.duel();
  EXPECT_EQ(titles(duel), std::vector<std::string>{"D1 H=20"});
  ASSERT_EQ(duel.apart[0].others.size(), 1u);
  EXPECT_EQ(duel.apart[0].others[0].pair.title(), "D1 H=10");
  EXPECT_EQ(duel.alike.size(), 1u);
  EXPECT_EQ(duel.pairs, 3u);
}

TEST(Duel, rows_of_other_machines_steps_and_variants_are_not_held_against_each_other) {
  Made rows = made({{"A", 0.001, 0.5}, {"B", 0.001, 0.5}, {"C", 0.001, 0.5}, {"D", 0.001, 0.5}});
  rows.second[0].origin.machine = {{"cpu", "another"}};
  rows.second[1].dt = 0.02;
  rows.second[2].params = {{"H", 3}};
  const Duel duel = rows.duel();
  EXPECT_EQ(titles(duel), std::vector<std::string>{"D"});
  EXPECT_EQ(duel.without_match.size(), 6u);
}

TEST(Duel, times_are_of_calm_runs) {
  Made rows = made({{"A", 0.001, 0.001, 1, 3}, {"B", 0.001, 0.001, 1, 5}, {"C", 0.001, 0.001, 1, 400}});
  rows.second[2].time.contended = Contention{4.0, "busy"};
  const Duel duel = rows.duel();
  ASSERT_TRUE(duel.time_factor);
  EXPECT_DOUBLE_EQ(*duel.time_factor, 4);
  EXPECT_EQ(duel.timed, 2u);
}

TEST(Duel, terminal_says_verdicts_errors_times_and_who_is_ahead) {
  std::ostringstream out;
  print_duel(out, made({{"A", 0.001, 0.5, 0.25, 7.5}}).duel(), 0, false);
  EXPECT_NE(out.str().find("A      pass 0.00100    0.250  failed 0.500     7.50  alpha  500\u00d7 error_of_it\n"),
            std::string::npos)
      << out.str();
  EXPECT_NE(out.str().find("1 scene tells them apart. alpha is ahead in 1, omega in 0."), std::string::npos)
      << out.str();
  for (const int width : {40, 60, 80}) {
    std::ostringstream narrow;
    print_duel(narrow, made({{"A", 0.001, 0.5, 0.25, 7.5}}).duel(), width, false);
    const std::string table = narrow.str().substr(0, narrow.str().find("\n\n"));
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(text_width(line), static_cast<std::size_t>(width)) << line;
  }
}

TEST(DuelPage, has_a_card_a_scene_with_metrics_times_and_the_moment) {
  const Made rows = made({{"A", 0.001, 0.5, 0.25, 7.5}, {"B", 0.001, 0.003}, {"C", 0.001, 0.001}});
  DuelPageOptions options;
  options.page.scenes["A"] = {"A <tower>", ""};
  options.page.replays = {{"A", "alpha", "bundle", 1}, {"A", "omega", "bundle", 2}};
  options.moments["A"] = {1.25, "They part at 1.25 s"};
  options.command = "plumb duel alpha omega";
  std::ostringstream out;
  write_duel_page(out, rows.duel(), options);
  const std::string page = out.str();
  for (const char* part : {"<h1>", "id=\"scene1\"", "id=\"scene2\"", "href=\"#scene1\"", "A &lt;tower&gt;",
                           "They part at 1.25 s", "plumb duel alpha omega", "7.50", "500\u00d7", "1 alike", "</html>"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("id=\"scene3\""), std::string::npos);
  for (const char* asks : {"src=\"http", "href=\"http"}) EXPECT_EQ(page.find(asks), std::string::npos) << asks;
}

TEST(DuelPage, engines_never_have_the_same_colour) {
  EXPECT_NE(duel_colours({"alpha", "alpha"})[0], duel_colours({"alpha", "alpha"})[1]);
  EXPECT_NE(duel_colours({"impulse", "bullet"})[0], duel_colours({"impulse", "bullet"})[1]);
}

}  // namespace
}  // namespace plumb::harness::testing
