// What the report says of the results that are committed: the same whatever else the machine did, of runs that pass
// alone, from one count each. And what stands beside those results and in the README is what they say.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>
#include <numeric>
#include <regex>
#include <sstream>

#include "page_reader.hpp"
#include "report/findings/answers.hpp"
#include "report/findings/distributions.hpp"
#include "report/findings/front.hpp"
#include "report/findings/needs.hpp"
#include "report/findings/overview.hpp"
#include "report/findings/profile.hpp"
#include "report/findings/robustness.hpp"
#include "report/findings/summary.hpp"
#include "report/ordered/machine_rows.hpp"
#include "report/text/failures.hpp"
#include "report/text/markdown.hpp"
#include "rows/results_reader.hpp"

namespace plumb::harness {
namespace {

const std::filesystem::path results = PLUMB_RESULTS_FOLDER;
constexpr std::array folders{"xeon-16-cores", "h200"};

const std::vector<Row>& committed(std::string_view folder) {
  static std::map<std::string, std::vector<Row>, std::less<>> read;
  const auto known = read.find(folder);
  return known != read.end() ? known->second : read.emplace(folder, read_results(results / folder).rows).first->second;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Every row, or every third one, as a busy machine would have marked it.
std::vector<Row> marked(std::vector<Row> rows, std::size_t every) {
  for (std::size_t i = 0; i < rows.size(); i += every) rows[i].time.contended = Contention{3.1, "load 3.1 on 2 cores"};
  return rows;
}

/// Everything that a machine's rows are made into.
struct Told {
  OrderedRows ordered;
  std::vector<CostLine> costs;
  std::vector<CostTest> tests;
  std::vector<BackendOverview> overviews;
  std::vector<Front> fronts;
  std::vector<AnsweredQuestion> answers;

  explicit Told(const std::vector<Row>& rows)
      : ordered(rows),
        costs(cost_of_accuracy(ordered)),
        tests(tests_of(costs)),
        overviews(harness::overviews(ordered, costs)),
        fronts(pareto_fronts(ordered)),
        answers(harness::answers(ordered, costs)) {}
};

/// All that is said of errors: nothing here may hang on a time.
std::vector<std::string> verdicts(const Told& told) {
  std::vector<std::string> out;
  for (const BackendOverview& overview : told.overviews) {
    out.push_back(overview.backend + describe_counts(overview));
    for (std::size_t t = 0; t < target_errors.size(); ++t) {
      out.push_back(fmt::format("{} {}: {} of {}", overview.backend, target_errors[t], overview.reach[t].reached,
                                overview.reach[t].tests));
      for (const CostLine* line : never_reached(told.tests, overview.backend, t))
        out.push_back(fmt::format("{} never {}: {} {}", overview.backend, target_errors[t], line->problem->title(),
                                  line->metric));
      for (const ProfileCurve& curve : cost_profile(told.ordered, told.costs, "", t).curves)
        out.push_back(fmt::format("{} solves {}", curve.backend, curve.reliability()));
    }
    out.push_back(energy_statement(energy_of(told.ordered, overview.backend)).text);
    const FrictionFacts friction = friction_of(told.ordered, overview.backend);
    out.push_back(fmt::format("{} {} {}", friction.spread, friction.best_spread, friction.pyramid()));
  }
  for (const CostLine& line : told.costs)
    out.push_back(fmt::format("{} {} {}: {}", line.problem->title(), line.metric, line.backend,
                              line.floor ? line.floor->error : -1));
  for (const AnsweredQuestion& answer : told.answers) {
    std::vector<std::string> good;
    for (const AnswerLine& line : answer.lines) {
      if (line.good) good.push_back(line.backend);
    }
    std::sort(good.begin(), good.end());
    out.push_back(fmt::format("{} {}", answer.question, fmt::join(good, ",")));
  }
  for (const ProfileCurve& curve : error_profile(told.ordered, told.costs, "").curves)
    out.push_back(fmt::format("{} {} {}", curve.backend, curve.at(0.01), curve.reliability()));
  for (const RobustnessLine& line : robustness(told.ordered)) {
    for (const auto& cell : line.cells) {
      if (cell) out.push_back(fmt::format("{} {} {} {}", line.metric, cell->runs, cell->beyond, cell->worst));
    }
  }
  for (const DistributionLine& line : distributions(told.ordered)) {
    for (const auto& cell : line.cells) {
      if (cell) out.push_back(fmt::format("{} {} {}", line.metric, cell->runs, cell->passed));
    }
  }
  return out;
}

class Verdicts : public ::testing::TestWithParam<const char*> {};

TEST_P(Verdicts, AreThoseOfAnIdleMachine) {
  const std::vector<Row>& rows = committed(GetParam());
  const Told idle(rows);
  const std::vector<std::string> expected = verdicts(idle);
  ASSERT_GT(expected.size(), 500u);
  for (const std::size_t every : {std::size_t{1}, std::size_t{3}}) {
    const Told busy(marked(rows, every));
    EXPECT_EQ(verdicts(busy), expected) << "every " << every;
    // A price is the idle machine's, or it is called an upper bound, or there is none.
    ASSERT_EQ(busy.costs.size(), idle.costs.size());
    for (std::size_t i = 0; i < idle.costs.size(); ++i) {
      for (std::size_t t = 0; t < target_errors.size(); ++t) {
        const auto &of_busy = busy.costs[i].at[t], &of_idle = idle.costs[i].at[t];
        if (!of_busy || !of_busy->ms) continue;
        EXPECT_GE(*of_busy->ms, of_idle->ms.value());
        EXPECT_TRUE(!of_busy->priced() || *of_busy->ms == *of_idle->ms);
      }
    }
  }
}

TEST_P(Verdicts, WithoutATimeNobodyIsCheapestAndThatIsSaid) {
  const Told busy(marked(committed(GetParam()), 1));
  for (const CostLine& line : busy.costs) {
    for (const auto& reached : line.at) EXPECT_FALSE(reached && reached->ms);
  }
  EXPECT_TRUE(busy.fronts.empty());
  EXPECT_TRUE(costs_of_needs(busy.ordered).empty());
  for (const BackendOverview& overview : busy.overviews) {
    for (const ReachCount& count : overview.reach) EXPECT_EQ(count.compared + count.cheapest, 0u);
    EXPECT_TRUE(beaten_at(busy.tests, overview.backend, 1).empty());
  }
  std::size_t told = 0;
  for (const AnsweredQuestion& answer : busy.answers) {
    if (answer.section != "cost") continue;
    ++told;
    EXPECT_NE(answer.verdict.find("not known"), std::string::npos) << answer.question << ' ' << answer.verdict;
    EXPECT_EQ(answer.verdict.find(" ms "), std::string::npos) << answer.verdict;
  }
  EXPECT_EQ(told, 3u);
}

TEST_P(Verdicts, NameAsWinnersOnlyRunsThatPass) {
  const Told told(committed(GetParam()));
  std::size_t winners = 0;
  for (const CostLine& line : told.costs) {
    for (const auto& reached : line.at) {
      EXPECT_TRUE(!reached || reached->row->passes()) << line.problem->title() << line.metric << line.backend;
    }
    for (const auto& reached : line.failing) {
      EXPECT_TRUE(!reached || !reached->row->missed().empty()) << line.problem->title() << line.metric;
    }
  }
  for (const Front& front : told.fronts) {
    for (const FrontPoint& point : front.best) EXPECT_TRUE(point.sample.row().passes()) << front.problem->title();
  }
  for (const AnsweredQuestion& answer : told.answers) {
    for (const AnswerLine& line : answer.lines) {
      for (const Statement& statement : line.statements) {
        if (!line.good || !statement.row) continue;
        ++winners;
        EXPECT_TRUE(statement.row->passes()) << answer.question << ' ' << line.backend << ": " << statement.text;
      }
    }
  }
  EXPECT_GT(winners, 5u);
  for (const BackendOverview& overview : told.overviews) {
    for (const Beaten& beaten : beaten_at(told.tests, overview.backend, 1))
      EXPECT_TRUE(beaten.by->at[1]->row->passes() && beaten.line->at[1]->row->passes());
    const FrictionFacts friction = friction_of(told.ordered, overview.backend);
    EXPECT_TRUE(!friction.best_row || friction.best_row->passes());
  }
}

/// Calls `look` for each table, in groups and beside them.
template <typename Look>
void over_tables(const Json& blocks, const Look& look) {
  for (const Json& block : blocks) {
    if (block.contains("table")) look(block["table"]);
    if (block.contains("blocks")) over_tables(block["blocks"], look);
  }
}

/// Cells that are set off as the best, by the run that they or the cell before them link to.
TEST_P(Verdicts, ThePageSetsOffOnlyRunsThatPass) {
  const std::vector<Row>& rows = committed(GetParam());
  const std::vector<Row>& parsed = rows;
  const std::string link = "href=\"#r";
  std::size_t found = 0;
  for (const Json& section : testing::packed_data(rows)) {
    over_tables(section, [&](const Json& table) {
      const std::string label = table["label"];
      if (label != "times side by side" && !label.starts_with("what accuracy costs")) return;
      for (const Json& line : table["rows"]) {
        std::size_t row = parsed.size();
        for (const Json& cell : line["c"]) {
          const std::string html = cell.is_array() ? cell[0] : cell;
          if (const std::size_t at = html.find(link); at != std::string::npos)
            row = std::stoul(html.substr(at + link.size()));
          if (!cell.is_array() || cell[2] != "best") continue;
          ++found;
          EXPECT_TRUE(parsed.at(row).passes()) << label << ' ' << parsed.at(row).scene << parsed.at(row).backend;
        }
      }
    });
  }
  EXPECT_GT(found, 500u);
}

/// What is called the engine's own was run with its own settings, at the scene's step.
TEST_P(Verdicts, OfDefaultsAreOfRunsAtTheDefaults) {
  const Told told(committed(GetParam()));
  std::size_t elsewhere = 0;
  for (const BackendOverview& overview : told.overviews) {
    for (const auto* rows : {&overview.failures, &overview.broken, &overview.unsupported}) {
      for (const Row* row : *rows)
        EXPECT_TRUE(row->engine.defaults.empty() && row->profile == "default" && row->own_needs())
            << row->backend << ' ' << row->scene << ' ' << told.ordered.configuration(*row);
    }
    EXPECT_EQ(static_cast<std::size_t>(overview.problems + overview.elsewhere),
              static_cast<std::size_t>(std::count_if(
                  told.ordered.problems.begin(), told.ordered.problems.end(), [&](const Problem& problem) {
                    return told.ordered.representative(problem, overview.backend) != nullptr;
                  })));
    elsewhere += static_cast<std::size_t>(overview.elsewhere);
  }
  EXPECT_GT(elsewhere, 0u) << "nothing here would tell";
}

TEST_P(Verdicts, SumsAddUp) {
  const Told told(committed(GetParam()));
  for (const BackendOverview& overview : told.overviews) {
    EXPECT_EQ(std::accumulate(overview.counts.begin(), overview.counts.end(), 0), overview.problems);
    const auto of = [&](Verdict verdict) { return static_cast<std::size_t>(overview.count(verdict)); };
    EXPECT_EQ(overview.failures.size(), of(Verdict::failed));
    EXPECT_EQ(overview.broken.size(),
              of(Verdict::crashed) + of(Verdict::timeout) + of(Verdict::out_of_memory) + of(Verdict::error));
    EXPECT_EQ(overview.lost.size(), overview.failures.size() + overview.broken.size());
    EXPECT_EQ(overview.unsupported.size(), of(Verdict::unsupported));
    EXPECT_EQ(overview.unjudged.size(), of(Verdict::unjudged));
    EXPECT_EQ(of(Verdict::gold) + of(Verdict::pass) + of(Verdict::ran) + overview.lost.size() +
                  overview.unsupported.size() + overview.unjudged.size(),
              static_cast<std::size_t>(overview.problems));
    for (std::size_t t = 0; t < target_errors.size(); ++t) {
      const ReachCount& count = overview.reach[t];
      EXPECT_LE(count.reached, count.tests);
      EXPECT_LE(count.compared, count.reached);
      EXPECT_LE(count.cheapest, count.compared);
      EXPECT_TRUE(t == 0 || count.reached <= overview.reach[t - 1].reached) << "who gets to 1 % gets to 10 %";
    }
  }
}

/// What is said twice is one number: card, table and answer.
TEST_P(Verdicts, OneFigureHasOneSource) {
  const std::vector<Row>& rows = committed(GetParam());
  const Told told(rows);
  const std::string page = testing::page_of(rows);
  std::size_t fronts = 0;
  for (const BackendOverview& overview : told.overviews) {
    const FrontCount count = count_fronts(told.fronts, overview.backend);
    fronts += count.cheapest;
    std::string card;
    const Summary summary = summary_of(told.ordered, told.costs, told.fronts, overview);
    for (const auto* list : {&summary.best, &summary.breaks}) {
      for (const Statement& statement : *list) card += statement.text + "\n";
    }
    const bool said = card.find(fmt::format("On {} of {} Pareto fronts", count.on, count.ran)) != std::string::npos;
    EXPECT_EQ(said, count.ran > 0) << card;
    EXPECT_NE(page.find(fmt::format(R"("{}","{}","{}","{}","{}")", count.ran, count.on, count.alone, count.cheapest,
                                    count.most_exact)),
              std::string::npos);
    const std::string reach = reach_text(overview.reach[1], false);
    EXPECT_EQ(testing::count(page, reach) >= 1, true) << reach;
    EXPECT_NE(describe_backend(overview, false).find(reach), std::string::npos);
    for (const RobustnessLine& line : robustness(told.ordered)) {
      if (line.metric != "energy_injected") continue;
      const auto place = static_cast<std::size_t>(&overview - told.overviews.data());
      const RobustnessCell& cell = line.cells.at(place).value();
      const std::string share = fmt::format("in {} of {}", cell.beyond, cell.runs);
      EXPECT_NE(card.find(share), std::string::npos) << share << card;
      EXPECT_NE(page.find("beyond " + share), std::string::npos) << share;
    }
  }
  const auto all = static_cast<std::size_t>(std::count_if(told.fronts.begin(), told.fronts.end(), says_something));
  EXPECT_GE(fronts, all) << "each front has a cheapest point";
}

/// "and 16 more" leads to the 16.
TEST_P(Verdicts, WhatIsOnlyCountedCanBeOpened) {
  const Told told(committed(GetParam()));
  const std::regex counted("and (\\d+) more");
  std::size_t found = 0;
  const auto check = [&](const Statement& statement) {
    std::smatch match;
    if (!std::regex_search(statement.text, match, counted)) return;
    ++found;
    EXPECT_EQ(statement.more.size(), std::stoul(match[1])) << statement.text;
    for (const Statement& more : statement.more) EXPECT_NE(more.row, nullptr) << more.text;
  };
  for (const AnsweredQuestion& answer : told.answers) {
    for (const AnswerLine& line : answer.lines) std::for_each(line.statements.begin(), line.statements.end(), check);
  }
  for (const BackendOverview& overview : told.overviews) {
    const Summary summary = summary_of(told.ordered, told.costs, told.fronts, overview);
    for (const auto* list : {&summary.best, &summary.breaks}) std::for_each(list->begin(), list->end(), check);
  }
  EXPECT_GT(found, 3u);
}

TEST_P(Verdicts, WhatFailsIsListedBesideTheRows) {
  std::ostringstream out;
  write_failures(out, committed(GetParam()));
  EXPECT_EQ(text_of(results / GetParam() / "failures.md"), out.str())
      << "plumb report harness/results/" << GetParam() << " --failures > harness/results/" << GetParam()
      << "/failures.md";
}

INSTANTIATE_TEST_SUITE_P(Committed, Verdicts, ::testing::ValuesIn(folders), [](const auto& folder) {
  std::string name = folder.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// The lines of the README's table that the rows alone decide.
TEST(Readme, SaysOfTheCommittedRowsWhatTheySay) {
  const std::string readme = text_of(results.parent_path().parent_path() / "README.md");
  const std::vector<Row>& rows = committed("xeon-16-cores");
  const Told told(rows);
  for (const BackendOverview& overview : told.overviews) {
    const std::string cells =
        fmt::format("| {} | {} | {} | {} | {} |", overview.count(Verdict::gold), overview.count(Verdict::pass),
                    overview.failures.size(), overview.broken.size(), overview.unsupported.size());
    EXPECT_TRUE(std::regex_search(readme, std::regex("\n\\| " + overview.backend + " [0-9.]+ " +
                                                     std::regex_replace(cells, std::regex("\\|"), "\\|"))))
        << overview.backend << ' ' << cells;
  }
  EXPECT_NE(readme.find("(6,036 cells"), std::string::npos);
  EXPECT_EQ(rows.size(), 6036u);
  EXPECT_NE(readme.find("harness/results/xeon-16-cores/failures.md"), std::string::npos);
}

}  // namespace
}  // namespace plumb::harness
