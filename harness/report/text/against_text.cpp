#include "report/text/against_text.hpp"

#include <fmt/format.h>

#include <ostream>

#include "base/format.hpp"
#include "report/text/markdown.hpp"
#include "report/text/text_table.hpp"

namespace plumb::harness {
namespace {

constexpr Sense senses[]{Sense::worse, Sense::better, Sense::changed};

std::string title_of(const Row& row) {
  const std::string variant = row.variant();
  return variant.empty() ? row.scene : row.scene + " " + variant;
}

std::string texts_of(const CellChange& cell) {
  std::string out;
  // What decided stands first.
  for (const bool deciding : {true, false}) {
    for (const Change& change : cell.changes) {
      if ((change.sense == cell.sense) != deciding) continue;
      out += (out.empty() ? "" : "; ") + change.text;
      if (!deciding && change.sense != Sense::changed) out += fmt::format(" ({})", sense_word(change.sense));
    }
  }
  return out;
}

const char* colour_of(Sense sense) { return sense == Sense::worse ? "31" : sense == Sense::better ? "32" : "33"; }

void print_only(std::ostream& out, const char* heading, const std::vector<const Row*>& rows, const OrderedRows& ordered,
                int terminal_width, bool colour) {
  if (rows.empty()) return;
  TextTable table({{heading, false, false}, {"backend", false, false}, {"settings", false, true}});
  for (const Row* row : rows)
    table.add({{printable(title_of(*row))}, {printable(row->backend)}, {printable(ordered.configuration(*row))}});
  table.print(out, terminal_width, colour);
  out << '\n';
}

Json identity(const Row& row) {
  return {{"scene", row.scene},
          {"params", row.params},
          {"backend", row.backend},
          {"profile", row.profile},
          {"dt", row.dt ? Json(*row.dt) : Json()},
          {"threads", row.threads ? Json(*row.threads) : Json()},
          {"settings", row.settings}};
}

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

}  // namespace

std::vector<std::string> describe_comparison(const Comparison& comparison, const std::string& baseline,
                                             const AgainstLimits& limits) {
  std::vector<std::string> out;
  const std::size_t same = comparison.both - comparison.cells.size();
  out.push_back(
      fmt::format("Against {}: {} cells in both, {} worse, {} better, {} changed, {} the same; {} only there, {} "
                  "only here.",
                  baseline, comparison.both, comparison.count(Sense::worse), comparison.count(Sense::better),
                  comparison.count(Sense::changed), same, comparison.only_before.size(), comparison.only_after.size()));
  std::string counts =
      fmt::format("Errors of runs that repeat themselves count beyond {} relative; ", limit_text(limits.error));
  counts += limits.times_count()
                ? fmt::format(
                      "times where intervals do not overlap by {:.0f} % or more, or beyond {:.0f} % where one "
                      "side ran once.",
                      100 * limits.time, 100 * limits.single_time)
                : "times do not count.";
  out.push_back(std::move(counts));
  if (comparison.noisy > 0) {
    out.push_back(fmt::format("{} cells do not repeat themselves: of their errors only crossed thresholds count.",
                              comparison.noisy));
  }
  if (!limits.times_count()) return out;
  if (comparison.other_machine > 0) {
    out.push_back(fmt::format("Times of {} cells are not compared: other machines ({}; here {}).",
                              comparison.other_machine, comparison.machine_before, comparison.machine_after));
  }
  if (comparison.contended > 0) {
    out.push_back(
        fmt::format("Times of {} cells are not compared: measured while the machine had more to do than cores.",
                    comparison.contended));
  }
  return out;
}

void print_against(std::ostream& out, const Comparison& comparison, const OrderedRows& before, const OrderedRows& after,
                   const std::string& baseline, const AgainstLimits& limits, int terminal_width, bool colour) {
  for (const Sense sense : senses) {
    if (comparison.count(sense) == 0) continue;
    TextTable table({{std::string(sense_word(sense)), false, false},
                     {"backend", false, false},
                     {"settings", false, true},
                     {"what", false, true}});
    for (const CellChange& cell : comparison.cells) {
      if (cell.sense != sense) continue;
      table.add({{printable(title_of(*cell.after)), colour_of(sense)},
                 {printable(cell.after->backend)},
                 {printable(after.configuration(*cell.after))},
                 {printable(texts_of(cell))}});
    }
    table.print(out, terminal_width, colour);
    out << '\n';
  }
  print_only(out, "only there", comparison.only_before, before, terminal_width, colour);
  print_only(out, "only here", comparison.only_after, after, terminal_width, colour);
  for (const std::string& sentence : describe_comparison(comparison, baseline, limits))
    out << printable(sentence) << '\n';
}

void write_against_markdown(std::ostream& out, const Comparison& comparison, const OrderedRows& before,
                            const OrderedRows& after, const std::string& baseline, const AgainstLimits& limits) {
  out << "# Plumb against a baseline\n\n";
  for (const std::string& sentence : describe_comparison(comparison, baseline, limits))
    out << markdown_text(sentence) << '\n';
  for (const Sense sense : senses) {
    if (comparison.count(sense) == 0) continue;
    out << "\n## " << static_cast<char>(sense_word(sense).front() - 'a' + 'A') << sense_word(sense).substr(1)
        << "\n\n| scene | backend | settings | what |\n|---|---|---|---|\n";
    for (const CellChange& cell : comparison.cells) {
      if (cell.sense != sense) continue;
      out << "| " << markdown_text(title_of(*cell.after)) << " | " << markdown_text(cell.after->backend) << " | "
          << markdown_text(after.configuration(*cell.after)) << " | " << markdown_text(texts_of(cell)) << " |\n";
    }
  }
  const auto only = [&](const char* heading, const std::vector<const Row*>& rows, const OrderedRows& ordered) {
    if (rows.empty()) return;
    out << "\n## " << heading << "\n\n";
    for (const Row* row : rows)
      out << "- " << markdown_text(fmt::format("{}, {}, {}", title_of(*row), row->backend, ordered.configuration(*row)))
          << '\n';
  };
  only("Only there", comparison.only_before, before);
  only("Only here", comparison.only_after, after);
}

Json against_json(const Comparison& comparison, const std::string& baseline, const AgainstLimits& limits) {
  Json out{{"against", baseline},
           {"both", comparison.both},
           {"times_compared", comparison.times},
           {"times_of_other_machines", comparison.other_machine},
           {"times_contended", comparison.contended},
           {"limits", {{"error", limits.error}, {"time", limits.time}, {"single_time", limits.single_time}}}};
  for (const Sense sense : senses) out[std::string(sense_word(sense))] = Json::array();
  for (const CellChange& cell : comparison.cells) {
    Json entry = identity(*cell.after);
    entry["changes"] = Json::array();
    for (const Change& change : cell.changes) {
      entry["changes"].push_back({{"what", change.what},
                                  {"sense", sense_word(change.sense)},
                                  {"before", number(change.before)},
                                  {"after", number(change.after)},
                                  {"text", change.text}});
    }
    out[std::string(sense_word(cell.sense))].push_back(std::move(entry));
  }
  out["only_before"] = out["only_after"] = Json::array();
  for (const Row* row : comparison.only_before) out["only_before"].push_back(identity(*row));
  for (const Row* row : comparison.only_after) out["only_after"].push_back(identity(*row));
  return out;
}

}  // namespace plumb::harness
