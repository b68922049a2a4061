#include "report/findings/answers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>

#include "base/format.hpp"
#include "report/findings/overview.hpp"

namespace plumb::harness {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

std::string list_of(const std::vector<std::string>& names) {
  if (names.size() < 2) return names.empty() ? "nobody" : names.front();
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::vector<std::string> good_ones(const std::vector<AnswerLine>& lines) {
  std::vector<std::string> names;
  for (const AnswerLine& line : lines) {
    if (line.good) names.push_back(line.backend);
  }
  return names;
}

/// The scene's problem whose parameter is nearest to the value, else its first; null without the scene.
const Problem* problem_of(const OrderedRows& ordered, const std::string& slug, const std::string& parameter,
                          double value) {
  const Problem* nearest = nullptr;
  double least = never;
  for (const Problem& problem : ordered.problems) {
    const Row& row = *problem.rows.front();
    if (row.slug != slug) continue;
    const auto found = row.params.find(parameter);
    // Of equals the one with the fewest other parameters is the plain one.
    const double distance =
        found != row.params.end() && found->is_number() ? std::abs(found->get<double>() - value) : 1e9;
    const double penalty = 1e-6 * static_cast<double>(row.params.size());
    if (distance + penalty < least) {
      least = distance + penalty;
      nearest = &problem;
    }
  }
  return nearest;
}

/// What a line's configuration costs, and which it is.
std::string price(const OrderedRows& ordered, const Reached& reached) {
  const std::string with = " with " + ordered.configuration(*reached.row);
  if (!reached.ms) return "at a cost that is not known, the machine having had other work," + with;
  std::string out =
      fmt::format("{}{} ms per simulated second", reached.untimed > 0 ? "at most " : "", short_number(*reached.ms));
  if (reached.band)
    out += fmt::format(" (95 %: {} to {})", short_number(reached.band->low), short_number(reached.band->high));
  out += with;
  if (reached.untimed > 0)
    out += fmt::format("; {} that reach it, too, were measured while the machine had other work", reached.untimed);
  return out;
}

/// What a backend's line says of a target, and whether it is reached by a run that passes.
AnswerLine cost_line(const OrderedRows& ordered, const CostLine& line, std::size_t target) {
  if (line.at[target]) return {line.backend, {{price(ordered, *line.at[target]), line.at[target]->row}}, true};
  Statement statement;
  if (const auto& failing = line.failing[target]) {
    statement = {fmt::format("not in a run that passes; with {} it misses {}", ordered.configuration(*failing->row),
                             failing->row->missed()),
                 failing->row};
  } else if (line.floor && line.floor->error < 1) {
    statement = {fmt::format("never; its best is {} with {}", percent_text(line.floor->error),
                             ordered.configuration(*line.floor->row)),
                 line.floor->row};
    if (!line.floor->row->passes()) statement.text += ", which misses " + line.floor->row->missed();
  } else {
    const Row& row = *line.representative;
    statement = {row.completed() ? "never, in any configuration here" : "did not come through: " + row.missed(), &row};
  }
  return {line.backend, {statement}, false};
}

/// What reaching the target on the problem's metric costs, the cheapest first, then those whose cost is not known, then
/// who never does.
AnsweredQuestion cost_answer(const OrderedRows& ordered, const std::vector<CostTest>& tests, const Problem& problem,
                             const std::string& metric, std::size_t target, const std::string& question,
                             const std::string& verb) {
  AnsweredQuestion answer{question, "", {}, "cost"};
  const auto test = std::find_if(tests.begin(), tests.end(), [&](const CostTest& candidate) {
    return candidate.lines.front().problem == &problem && candidate.lines.front().metric == metric;
  });
  if (test == tests.end()) return answer;
  const auto cost = [&](const CostLine* line) {
    const auto& reached = line->at[target];
    return std::pair(!reached, reached && reached->ms ? *reached->ms : never);
  };
  std::vector<const CostLine*> lines;
  for (const CostLine& line : test->lines) lines.push_back(&line);
  std::stable_sort(lines.begin(), lines.end(), [&](const CostLine* a, const CostLine* b) { return cost(a) < cost(b); });
  for (const CostLine* line : lines) answer.lines.push_back(cost_line(ordered, *line, target));
  std::vector<std::string> good = good_ones(answer.lines);
  if (good.empty()) {
    answer.verdict = fmt::format("Nobody {} here in a run that passes the scene.", verb);
  } else if (test->cheapest(target)) {
    answer.verdict = fmt::format("{}, at {}.", good.front(), price(ordered, *lines.front()->at[target]));
  } else {
    std::sort(good.begin(), good.end(), natural_less);
    answer.verdict = fmt::format(
        "{} can. Who is cheapest is not known: runs were measured while the machine had other "
        "work, and their times do not count.",
        list_of(good));
  }
  return answer;
}

AnsweredQuestion energy_answer(const OrderedRows& ordered) {
  AnsweredQuestion answer{"Who conserves energy?", "", {}, "robust"};
  std::vector<std::pair<double, AnswerLine>> lines;
  for (const std::string& backend : ordered.backends) {
    const EnergyFacts facts = energy_of(ordered, backend);
    const Statement statement = energy_statement(facts);
    if (statement.text.empty()) continue;
    lines.push_back({facts.lost > 0 ? never : facts.worst_drift, {backend, {statement}, facts.conserves()}});
  }
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [worst, line] : lines) answer.lines.push_back(std::move(line));
  if (answer.lines.empty()) return answer;
  const std::vector<std::string> good = good_ones(answer.lines);
  answer.verdict = good.empty()
                       ? fmt::format("At their defaults nobody within {}; {} comes closest.", percent_text(conserving),
                                     answer.lines.front().backend)
                       : fmt::format("{}, within {} at their defaults, wherever a scene has a threshold for it.",
                                     list_of(good), percent_text(conserving));
  return answer;
}

AnsweredQuestion friction_answer(const OrderedRows& ordered) {
  AnsweredQuestion answer{"Whose friction is a pyramid instead of a cone?", "", {}, "matrix"};
  std::vector<std::pair<double, AnswerLine>> lines;
  std::vector<std::string> pyramids;
  for (const std::string& backend : ordered.backends) {
    const FrictionFacts facts = friction_of(ordered, backend);
    if (!facts.row) continue;
    std::string text = fmt::format("{}: stopping distances differ by {} with the heading ({})",
                                   facts.pyramid()               ? "a pyramid"
                                   : facts.spread <= cone_spread ? "a cone"
                                                                 : "nearly a cone",
                                   percent_text(facts.spread), row_title(*facts.row));
    if (facts.spread > cone_spread && facts.best_row && facts.best_spread <= cone_spread) {
      text += fmt::format("; {} with {}", percent_text(facts.best_spread), ordered.configuration(*facts.best_row));
    }
    if (!facts.row->passes()) text += "; that run misses " + facts.row->missed();
    if (facts.pyramid()) pyramids.push_back(backend);
    lines.push_back({facts.spread, {backend, {{text, facts.row}}, facts.row->passes()}});
  }
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& [spread, line] : lines) answer.lines.push_back(std::move(line));
  if (answer.lines.empty()) return answer;
  answer.verdict = fmt::format("{}{}. Of an ideal four-sided pyramid the distances differ by {}.",
                               pyramids.empty() ? "Nobody's" : "That of " + list_of(pyramids), " at the defaults",
                               percent_text(ideal_pyramid));
  return answer;
}

AnsweredQuestion reach_answer(const std::vector<BackendOverview>& overviews) {
  AnsweredQuestion answer{"Who gets within 1 % most often, and who is cheapest there?", "", {}, "cost"};
  std::vector<std::pair<ReachCount, AnswerLine>> lines;
  for (const BackendOverview& overview : overviews) {
    const ReachCount& count = overview.reach[one_percent];
    if (count.tests > 0) lines.push_back({count, {overview.backend, {{reach_text(count, false)}}}});
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.first.reached > b.first.reached; });
  if (lines.size() < 2) return answer;
  const std::size_t most = lines.front().first.reached;
  std::vector<std::string> first;
  for (auto& [count, line] : lines) {
    line.good = most > 0 && count.reached == most;
    if (line.good) first.push_back(line.backend);
    answer.lines.push_back(std::move(line));
  }
  if (first.empty()) {
    answer.verdict = "Nobody does.";
    return answer;
  }
  answer.verdict = fmt::format("{}: {}.", list_of(first), answer.lines.front().statements.front().text);
  const auto cheapest = std::max_element(
      lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first.cheapest < b.first.cheapest; });
  if (const ReachCount& count = cheapest->first; count.cheapest > lines.front().first.cheapest) {
    const ReachCount& front = lines.front().first;
    answer.verdict = fmt::format(
        "{} most often, in {} of {} metrics; the cheapest most often is {}, in {} of {}{}.", list_of(first),
        front.reached, front.tests, answer.lines[static_cast<std::size_t>(cheapest - lines.begin())].backend,
        count.cheapest, count.compared, count.compared == count.reached ? "" : " with known costs");
  }
  return answer;
}

/// What an engine fails, what it never gets right, and where it pays most.
AnsweredQuestion losing_answer(const std::vector<CostTest>& tests, const std::vector<BackendOverview>& overviews) {
  AnsweredQuestion answer{"Where does each engine lose?", "", {}, "matrix"};
  for (const BackendOverview& overview : overviews) {
    std::vector<Statement> parts;
    if (const std::size_t lost = overview.lost.size(); lost > 0) {
      std::vector<Statement> names;
      for (const auto* rows : {&overview.broken, &overview.failures}) {
        for (const Row* row : *rows) names.push_back({row_title(*row), row});
      }
      parts.push_back(
          name_some(fmt::format("fails {} of {} scene variants at its defaults:", lost, overview.problems), names));
    }
    if (const std::vector<Statement> missed = names_of(never_reached(tests, overview.backend, one_percent));
        !missed.empty())
      parts.push_back(name_some("never passes within 1 %, where another engine does:", missed));
    const std::vector<Beaten> beaten = beaten_at(tests, overview.backend, one_percent);
    if (!beaten.empty() && beaten.front().factor > 1.05) {
      const Beaten& worst = beaten.front();
      parts.push_back({fmt::format("pays up to {} what {} does for 1 % ({} {})", ratio_text(worst.factor),
                                   worst.by->backend, worst.line->problem->title(), worst.line->metric),
                       worst.line->at[one_percent]->row});
    }
    if (parts.empty()) parts.push_back({"nowhere in these results"});
    const ReachCount& count = overview.reach[one_percent];
    if (count.compared < count.reached)
      parts.push_back(
          {fmt::format("where it is dearer is known of {} of {} metrics only", count.compared, count.reached)});
    answer.lines.push_back({overview.backend, std::move(parts)});
  }
  if (answer.lines.size() < 2) answer.lines.clear();
  std::vector<const BackendOverview*> order;
  for (const BackendOverview& overview : overviews) order.push_back(&overview);
  std::stable_sort(order.begin(), order.end(),
                   [](const BackendOverview* a, const BackendOverview* b) { return a->lost.size() < b->lost.size(); });
  std::vector<std::string> counts;
  for (const BackendOverview* overview : order) {
    if (overview->problems > 0)
      counts.push_back(fmt::format("{} {} of {}", overview->backend, overview->lost.size(), overview->problems));
  }
  if (!counts.empty()) answer.verdict = fmt::format("Scene variants failed at the defaults: {}.", list_of(counts));
  return answer;
}

}  // namespace

std::vector<AnsweredQuestion> answers(const OrderedRows& ordered, const std::vector<CostLine>& costs) {
  std::vector<AnsweredQuestion> all;
  const auto add = [&](AnsweredQuestion answer) {
    if (!answer.lines.empty()) all.push_back(std::move(answer));
  };
  const std::vector<CostTest> tests = tests_of(costs);
  const std::vector<BackendOverview> backends = overviews(ordered, costs);
  if (const Problem* tower = problem_of(ordered, "tower", "H", 50)) {
    add(cost_answer(ordered, tests, *tower, "stands", one_per_mille,
                    fmt::format("Which engine stands the tower of {} cubes cheapest?",
                                value_text(tower->rows.front()->params.value("H", Json(10)))),
                    "makes it stand"));
  }
  add(energy_answer(ordered));
  add(friction_answer(ordered));
  if (const Problem* pendulum = problem_of(ordered, "pendulum", "amplitude", 90)) {
    add(cost_answer(ordered, tests, *pendulum, "period", one_per_mille,
                    fmt::format("What does 0.1 % on the pendulum's period cost ({})?",
                                pendulum->variant.empty() ? "from 90 degrees" : pendulum->variant),
                    "gets there"));
  }
  add(reach_answer(backends));
  add(losing_answer(tests, backends));
  return all;
}

}  // namespace plumb::harness
