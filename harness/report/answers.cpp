#include "report/answers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>

#include "report/format.hpp"

namespace plumb::harness {
namespace {

constexpr std::size_t one_percent = 1, one_per_mille = 2;  ///< places in target_errors
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
const Problem* problem_of(const Study& study, const std::string& slug, const std::string& parameter, double value) {
  const Problem* nearest = nullptr;
  double least = never;
  for (const Problem& problem : study.problems) {
    const ResultRow& row = *problem.rows.front();
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

std::string price(const Study& study, const Reached& reached) {
  std::string out = fmt::format("{} ms per simulated second", short_number(reached.ms));
  if (reached.band)
    out += fmt::format(" (95 %: {} to {})", short_number(reached.band->low), short_number(reached.band->high));
  return out + " with " + study.configuration(*reached.row);
}

/// What reaching the target on the problem's metric costs, the cheapest first, then who never does.
AnsweredQuestion cost_answer(const Study& study, const std::vector<CostLine>& costs, const Problem& problem,
                             const std::string& metric, std::size_t target, const std::string& question,
                             const std::string& verb) {
  AnsweredQuestion answer{question, "", {}, "cost"};
  std::vector<const CostLine*> lines;
  for (const CostLine& line : costs) {
    if (line.problem == &problem && line.metric == metric && !line.contended) lines.push_back(&line);
  }
  std::stable_sort(lines.begin(), lines.end(), [&](const CostLine* a, const CostLine* b) {
    return (a->at[target] ? a->at[target]->ms : never) < (b->at[target] ? b->at[target]->ms : never);
  });
  for (const CostLine* line : lines) {
    Statement statement;
    if (line->at[target]) {
      statement = {price(study, *line->at[target]), line->at[target]->row};
      const MetricResult* worst = statement.row->worst();
      if (statement.row->verdict() == Verdict::failed && worst && worst->name != metric)
        statement.text += fmt::format(", yet it misses {} ({})", worst->name, short_number(worst->error));
    } else if (line->floor && line->floor->error < 1) {
      statement = {fmt::format("never; its best is {} at {} ms", percent_text(line->floor->error),
                               short_number(line->floor->ms)),
                   line->floor->row};
    } else {
      const ResultRow& row = *line->representative;
      statement = {row.completed() ? "never, in any configuration here" : "did not come through: " + row.reason, &row};
    }
    answer.lines.push_back({line->backend, statement, line->at[target].has_value()});
  }
  if (answer.lines.empty()) return answer;
  const std::vector<std::string> good = good_ones(answer.lines);
  answer.verdict = good.empty() ? fmt::format("Nobody {} here.", verb)
                                : fmt::format("{}, at {}.", good.front(), price(study, *lines.front()->at[target]));
  return answer;
}

AnsweredQuestion energy_answer(const Study& study) {
  AnsweredQuestion answer{"Who conserves energy?", "", {}, "robust"};
  std::vector<std::pair<double, AnswerLine>> lines;
  for (const std::string& backend : study.backends) {
    const EnergyFacts facts = energy_of(study, backend);
    const Statement statement = energy_statement(facts);
    if (statement.text.empty()) continue;
    const bool good = facts.worst_drift <= conserving && facts.worst_injection <= injecting;
    lines.push_back({std::max(facts.worst_drift, facts.worst_injection), {backend, statement, good}});
  }
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [worst, line] : lines) answer.lines.push_back(std::move(line));
  if (answer.lines.empty()) return answer;
  const std::vector<std::string> good = good_ones(answer.lines);
  answer.verdict = good.empty()
                       ? fmt::format("At their defaults nobody within {}; {} comes closest.", percent_text(conserving),
                                     answer.lines.front().backend)
                       : fmt::format("{}, within {} at their defaults.", list_of(good), percent_text(conserving));
  return answer;
}

AnsweredQuestion friction_answer(const Study& study) {
  AnsweredQuestion answer{"Whose friction is a pyramid instead of a cone?", "", {}, "matrix"};
  std::vector<std::pair<double, AnswerLine>> lines;
  std::vector<std::string> pyramids;
  for (const std::string& backend : study.backends) {
    const FrictionFacts facts = friction_of(study, backend);
    if (!facts.row) continue;
    std::string text = fmt::format("{}: stopping distances differ by {} with the heading ({})",
                                   facts.pyramid()               ? "a pyramid"
                                   : facts.spread <= cone_spread ? "a cone"
                                                                 : "nearly a cone",
                                   percent_text(facts.spread), row_title(*facts.row));
    if (facts.spread > cone_spread && facts.best_row && facts.best_spread <= cone_spread) {
      text += fmt::format("; {} with {}", percent_text(facts.best_spread), study.configuration(*facts.best_row));
    }
    if (facts.pyramid()) pyramids.push_back(backend);
    lines.push_back({facts.spread, {backend, {text, facts.row}, !facts.pyramid()}});
  }
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& [spread, line] : lines) answer.lines.push_back(std::move(line));
  if (answer.lines.empty()) return answer;
  answer.verdict = fmt::format("{}{}. Of an ideal four-sided pyramid the distances differ by {}.",
                               pyramids.empty() ? "Nobody's" : "That of " + list_of(pyramids), " at the defaults",
                               percent_text(ideal_pyramid));
  return answer;
}

AnsweredQuestion reach_answer(const Study& study, const std::vector<CostLine>& costs) {
  AnsweredQuestion answer{"Who gets within 1 % most often, and who is cheapest there?", "", {}, "profiles"};
  std::vector<std::pair<std::size_t, AnswerLine>> lines;
  for (const std::string& backend : study.backends) {
    std::size_t ran = 0, reached = 0;
    for (const CostLine& line : costs) {
      if (line.backend != backend || line.contended) continue;
      ++ran;
      reached += line.at[one_percent].has_value();
    }
    if (ran == 0) continue;
    const std::size_t beaten = beaten_at(costs, backend, one_percent).size();
    lines.push_back(
        {reached,
         {backend,
          {fmt::format("within 1 % in {} of {} metrics, the cheapest in {} of them", reached, ran, reached - beaten),
           nullptr},
          false}});
  }
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& [reached, line] : lines) answer.lines.push_back(std::move(line));
  if (answer.lines.size() < 2) return {};
  answer.verdict = fmt::format("{}: {}.", answer.lines.front().backend, answer.lines.front().statement.text);
  answer.lines.front().good = true;
  return answer;
}

std::string names_of(const std::vector<const CostLine*>& lines) {
  constexpr std::size_t most = 3;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i)
    names.push_back(lines[i]->problem->title() + " " + lines[i]->metric);
  std::string out = fmt::format("{}", fmt::join(names, ", "));
  if (lines.size() > most) out += fmt::format(" and {} more", lines.size() - most);
  return out;
}

AnsweredQuestion losing_answer(const Study& study, const std::vector<CostLine>& costs) {
  AnsweredQuestion answer{"Where does each engine lose?", "", {}, "matrix"};
  for (const std::string& backend : study.backends) {
    const bool took_part =
        std::any_of(costs.begin(), costs.end(), [&](const CostLine& line) { return line.backend == backend; });
    if (!took_part) continue;
    std::vector<std::string> parts;
    const ResultRow* shown = nullptr;
    const std::vector<const CostLine*> missed = never_reached(costs, backend, one_percent);
    if (!missed.empty()) {
      parts.push_back(fmt::format("never within 1 %, where another engine is: {}", names_of(missed)));
      shown = missed.front()->representative;
    }
    const std::vector<Beaten> beaten = beaten_at(costs, backend, one_percent);
    if (!beaten.empty() && beaten.front().factor > 1.05) {
      const Beaten& worst = beaten.front();
      parts.push_back(fmt::format("pays up to {} what {} does for 1 % ({} {})", ratio_text(worst.factor),
                                  worst.by->backend, worst.line->problem->title(), worst.line->metric));
      if (!shown) shown = worst.line->at[one_percent]->row;
    }
    if (parts.empty()) parts.push_back("nowhere in these results");
    answer.lines.push_back({backend, {fmt::format("{}", fmt::join(parts, "; ")), shown}, false});
  }
  if (answer.lines.size() < 2) answer.lines.clear();
  return answer;
}

}  // namespace

std::vector<AnsweredQuestion> answers(const Study& study, const std::vector<CostLine>& costs) {
  std::vector<AnsweredQuestion> all;
  const auto add = [&](AnsweredQuestion answer) {
    if (!answer.lines.empty()) all.push_back(std::move(answer));
  };
  if (const Problem* tower = problem_of(study, "tower", "H", 50)) {
    // A tower on its way down stands until it has sunk by a tenth: one that stands is at rest, too.
    const bool tells_rest = std::any_of(costs.begin(), costs.end(), [&](const CostLine& line) {
      return line.problem == tower && line.metric == "kinetic_energy";
    });
    add(cost_answer(study, costs, *tower, tells_rest ? "kinetic_energy" : "stands",
                    tells_rest ? one_percent : one_per_mille,
                    fmt::format("Which engine stands the tower of {} cubes cheapest?",
                                value_text(tower->rows.front()->params.value("H", Json(10)))),
                    "makes it stand"));
  }
  add(energy_answer(study));
  add(friction_answer(study));
  if (const Problem* pendulum = problem_of(study, "pendulum", "amplitude", 90)) {
    add(cost_answer(study, costs, *pendulum, "period", one_per_mille,
                    fmt::format("What does 0.1 % on the pendulum's period cost ({})?",
                                pendulum->variant.empty() ? "from 90 degrees" : pendulum->variant),
                    "gets there"));
  }
  add(reach_answer(study, costs));
  add(losing_answer(study, costs));
  return all;
}

}  // namespace plumb::harness
