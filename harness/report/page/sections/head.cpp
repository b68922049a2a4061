// The head of the page: what was compared, on what, and what came out, in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "base/format.hpp"
#include "report/findings/summary.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

/// The verdicts of a backend as one bar, each part as wide as its share.
std::string verdict_bar(const BackendOverview& overview) {
  std::string parts, legend;
  for (std::size_t v = 0; v < verdict_count; ++v) {
    if (overview.counts[v] == 0) continue;
    const std::string word(verdict_word(static_cast<Verdict>(v))), title = verdict_title(static_cast<Verdict>(v));
    parts += fmt::format(R"(<span class="{}" style="flex-grow:{}" title="{} {}"></span>)", word, overview.counts[v],
                         overview.counts[v], title);
    legend += fmt::format(R"(<li><i class="{}"></i>{} {}</li>)", word, overview.counts[v], title);
  }
  return fmt::format(R"(<div class="bar" role="img" aria-label="verdicts">{}</div><ul class="bar-legend">{}</ul>)",
                     parts, legend);
}

std::string statements(const char* title, const char* style, const std::vector<Statement>& list) {
  if (list.empty()) return "";
  std::string items;
  for (const Statement& statement : list) items += fmt::format("<li>{}</li>", statement_text(statement));
  return fmt::format(R"(<h4>{}</h4><ul class="{}">{}</ul>)", title, style, items);
}

std::string backend_card(const PageContext& context, const BackendOverview& overview) {
  const Summary summary = summary_of(context.ordered, context.costs, context.fronts, overview);
  const std::string elsewhere = elsewhere_text(overview);
  return fmt::format(R"(<article class="card of{0} e{0}"><h3>{1} <small>{2}</small></h3>{3}{4}{5}{6}</article>)",
                     context.backend_index(overview.backend), backend_label(context, overview.backend),
                     escape_html(overview.version), verdict_bar(overview),
                     elsewhere.empty() ? "" : fmt::format(R"(<p class="elsewhere">{}</p>)", elsewhere),
                     statements("Best", "best-at", summary.best), statements("Breaks", "breaks-at", summary.breaks));
}

std::string join_words(const std::vector<std::string>& words) {
  if (words.size() < 2) return words.empty() ? "" : words.front();
  return fmt::format("{} and {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

/// Machines by their facts; several machines get a list each.
std::string machine_facts(const OrderedRows& ordered) {
  std::set<std::string> seen;
  std::vector<const Json*> machines;
  for (const Row& row : ordered.rows) {
    if (row.origin.machine.empty()) continue;
    if (seen.insert(value_text(row.origin.machine)).second) machines.push_back(&row.origin.machine);
  }
  std::string out;
  for (const Json* machine : machines) {
    for (const auto& [name, value] : machine->items()) {
      std::string words = name;
      for (char& c : words) c = c == '_' ? ' ' : c;
      out += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", escape_html(words), escape_html(value_text(value)));
    }
  }
  return out;
}

}  // namespace

std::string head_section(const PageContext& context) {
  std::string out = R"(<header class="head"><p class="kicker">Plumb report)";
  if (!context.machine.empty()) out += " &#183; " + escape_html(context.machine);
  out += "</p><h1>";
  out +=
      escape_html(context.ordered.backends.empty() ? std::string("No results") : join_words(context.ordered.backends));
  out += "</h1>";
  out += fmt::format(
      R"(<p class="lede">{} Error and time in every figure come from the same run with the same settings; errors )"
      R"(are measured )"
      R"(by the harness's own float64 geometry against exact truths.</p>)",
      escape_html(describe_study(context.ordered)));
  out += R"(<details class="how"><summary>machine, dates and command</summary><dl class="facts">)";
  if (!context.options.written.empty())
    out += fmt::format("<div><dt>written</dt><dd>{}</dd></div>", escape_html(context.options.written));
  std::string first, last;
  for (const Row& row : context.ordered.rows) {
    if (row.origin.date.empty()) continue;
    if (first.empty() || row.origin.date < first) first = row.origin.date;
    last = std::max(last, row.origin.date);
  }
  if (!first.empty()) {
    out +=
        fmt::format("<div><dt>ran</dt><dd>{}</dd></div>", escape_html(first == last ? first : first + " to " + last));
  }
  for (const StudyText& study : context.options.studies) {
    out += fmt::format("<div><dt>study {}</dt><dd><code>{}</code></dd></div>", escape_html(study.name),
                       escape_html(study.command));
  }
  if (!context.options.source.empty())
    out += fmt::format("<div><dt>results</dt><dd>{}</dd></div>", escape_html(context.options.source));
  return out + machine_facts(context.ordered) + "</dl></details></header>";
}

PageSection engines_section(const PageContext& context) {
  PageSection section{"engines", "Engines in words", ""};
  if (context.overviews.empty()) return section;
  std::string cards;
  for (const BackendOverview& overview : context.overviews) cards += backend_card(context, overview);
  section.words =
      about(
          "Where each is best and where it breaks, made from the numbers; what is underlined leads to a run "
          "that shows it.") +
      fmt::format(R"(<div class="cards">{}</div>)", cards);
  return section;
}

}  // namespace plumb::harness
