// The head of the page: what was compared, on what, and what came out, in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

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

std::string backend_card(const PageContext& context, const BackendOverview& overview) {
  return fmt::format(R"(<article class="card e{}"><h3>{} <small>{}</small></h3>{}<p>{}</p></article>)",
                     context.backend_index(overview.backend), backend_label(context, overview.backend),
                     escape_html(overview.version), verdict_bar(overview),
                     escape_html(describe_backend(overview, context.study.backends.size() == 1)));
}

std::string join_words(const std::vector<std::string>& words) {
  if (words.size() < 2) return words.empty() ? "" : words.front();
  return fmt::format("{} and {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

/// Machines by their facts; several machines get a list each.
std::string machine_facts(const Study& study) {
  std::set<std::string> seen;
  std::vector<const Json*> machines;
  for (const ResultRow& row : study.rows) {
    if (row.machine.empty()) continue;
    if (seen.insert(value_text(row.machine)).second) machines.push_back(&row.machine);
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
  std::string out = R"(<header class="head"><p class="kicker">Plumb report</p><h1>)";
  out += escape_html(context.study.backends.empty() ? std::string("No results") : join_words(context.study.backends));
  out += "</h1>";
  out += fmt::format(
      R"(<p class="lede">{} Error and time in every figure come from the same run with the same settings; errors )"
      R"(are measured )"
      R"(by the harness's own float64 geometry against exact truths.</p>)",
      escape_html(describe_study(context.study)));
  out += R"(<div class="cards">)";
  for (const BackendOverview& overview : context.overviews) out += backend_card(context, overview);
  out += R"(</div><dl class="facts">)";
  if (!context.options.written.empty())
    out += fmt::format("<div><dt>written</dt><dd>{}</dd></div>", escape_html(context.options.written));
  std::string first, last;
  for (const ResultRow& row : context.study.rows) {
    if (row.date.empty()) continue;
    if (first.empty() || row.date < first) first = row.date;
    last = std::max(last, row.date);
  }
  if (!first.empty()) {
    out +=
        fmt::format("<div><dt>ran</dt><dd>{}</dd></div>", escape_html(first == last ? first : first + " to " + last));
  }
  if (!context.options.source.empty())
    out += fmt::format("<div><dt>results</dt><dd>{}</dd></div>", escape_html(context.options.source));
  return out + machine_facts(context.study) + "</dl></header>";
}

}  // namespace plumb::harness
