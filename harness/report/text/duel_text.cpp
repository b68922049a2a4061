#include "report/text/duel_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "base/format.hpp"
#include "report/text/row_text.hpp"
#include "report/text/text_table.hpp"

namespace plumb::harness {
namespace {

std::string counted_scenes(std::size_t count) { return fmt::format("{} {}", count, count == 1 ? "scene" : "scenes"); }

std::string counted_variants(std::size_t count) {
  return fmt::format("{} {}", count, count == 1 ? "scene variant" : "scene variants");
}

constexpr std::size_t most_silent = 6;  ///< lines on a terminal: the page has them all

/// "unsupported: no height fields"
std::string silence_text(const Row& row) {
  return verdict_prose(row.verdict()) + (row.reason.empty() ? "" : ": " + row.reason);
}

void add_time_sentence(std::vector<std::string>& out, const Duel& duel) {
  if (!duel.time_factor) {
    out.emplace_back("No time of a step can be compared: none was measured on both sides while the machine was calm.");
    return;
  }
  out.push_back(fmt::format("A step of {} takes {} that of {} (median of {} {}).", duel.names[1],
                            ratio_text(*duel.time_factor), duel.names[0], duel.timed,
                            duel.timed == 1 ? "pair of runs" : "pairs of runs"));
}

}  // namespace

std::vector<std::string> describe_duel(const Duel& duel) {
  const auto& [first, second] = duel.names;
  std::vector<std::string> out;
  std::string sum = fmt::format("{} against {}, {}: ", first, second, counted_variants(duel.pairs));
  if (duel.apart.empty()) {
    sum += "nothing tells them apart.";
  } else {
    sum += fmt::format("{} {} them apart. {} is ahead in {}, {} in {}.", counted_scenes(duel.apart.size()),
                       duel.apart.size() == 1 ? "tells" : "tell", first, duel.ahead[0], second, duel.ahead[1]);
  }
  out.push_back(std::move(sum));
  if (!duel.alike.empty()) {
    out.push_back(fmt::format("{} of {} variants do not: the same verdict, and no error {} times the other's.",
                              duel.alike.size(), duel.pairs, shortest_number(telling_factor)));
  }
  add_time_sentence(out, duel);
  if (!duel.without_match.empty()) {
    out.push_back(
        fmt::format("{} runs of one engine have none of the other to be held against: the same variant, step, "
                    "duration and machine.",
                    duel.without_match.size()));
  }
  return out;
}

std::vector<std::string> describe_silence(const Duel& duel) {
  std::vector<std::string> out;
  for (const DuelPair& pair : duel.one_only) {
    const std::size_t silent = says_nothing(pair.rows[0]->verdict()) ? 0 : 1;
    out.push_back(fmt::format("Only {} runs {} ({}: {}).", duel.names[1 - silent], pair.title(), duel.names[silent],
                              silence_text(*pair.rows[silent])));
  }
  for (const DuelPair& pair : duel.neither) {
    out.push_back(fmt::format("Neither runs {} ({}: {}; {}: {}).", pair.title(), duel.names[0],
                              silence_text(*pair.rows[0]), duel.names[1], silence_text(*pair.rows[1])));
  }
  return out;
}

std::string side_text(const Row& row, const std::string& name) {
  std::string text = verdict_prose(row.verdict());
  const MetricResult* metric = row.completed() && !name.empty() ? row.metric(name) : nullptr;
  if (metric) text += " " + (metric->error ? short_number(*metric->error) : "not finite");
  return text;
}

std::string advantage_text(const DuelFinding& finding) {
  if (finding.metric.empty()) return finding.apart == Apart::passes ? "passes" : "comes through";
  if (std::isinf(finding.factor)) return finding.metric;
  return fmt::format("{} {}", ratio_text(finding.factor), finding.metric);
}

void print_duel(std::ostream& out, const Duel& duel, int terminal_width, bool colour) {
  TextTable table({{"scene", false, true},
                   {printable(duel.names[0]), false, false},
                   {"ms/step", true, false},
                   {printable(duel.names[1]), false, false},
                   {"ms/step", true, false},
                   {"ahead", false, true},
                   {"by", false, true}});
  for (const DuelScene& scene : duel.apart) {
    const DuelFinding& best = scene.best;
    std::vector<TextCell> line{{printable(best.pair.title())}};
    for (const Row* row : best.pair.rows) {
      line.push_back({printable(side_text(*row, best.metric)), colour_of(row->verdict())});
      line.push_back({ms_text(*row), dim});
    }
    line.push_back({printable(duel.names[best.ahead])});
    line.push_back({printable(advantage_text(best))});
    table.add(std::move(line));
  }
  if (!duel.apart.empty()) {
    table.print(out, terminal_width, colour);
    out << '\n';
  }
  for (const std::string& sentence : describe_duel(duel)) out << printable(sentence) << '\n';
  const std::vector<std::string> silence = describe_silence(duel);
  for (std::size_t i = 0; i < std::min(most_silent, silence.size()); ++i) out << printable(silence[i]) << '\n';
  if (silence.size() > most_silent)
    out << "And " << silence.size() - most_silent << " more that not both can run: the page has them.\n";
}

}  // namespace plumb::harness
