#include "report/page/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/plot.hpp"

namespace plumb::harness {
namespace {

std::string metric_line(const MetricResult& metric) {
  std::string line = fmt::format("{}: {}", metric.name, metric.value ? short_number(*metric.value, 6) : "not finite");
  if (!metric.unit.empty() && metric.unit != "1") line += fmt::format(" {}", metric.unit);
  if (metric.truth) line += fmt::format(", truth {}", short_number(*metric.truth, 6));
  line += fmt::format(", error {}", metric.error ? short_number(*metric.error) : "not finite");
  if (metric.threshold) line += fmt::format(", threshold {}", limit_text(*metric.threshold));
  if (metric.gold) line += fmt::format(", gold {}", limit_text(*metric.gold));
  if (metric.scored()) line += metric.is_gold ? ": gold" : metric.pass.value_or(true) ? ": pass" : ": failed";
  if (!metric.note.empty()) line += fmt::format(" ({})", metric.note);
  return line;
}

}  // namespace

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::size_t PageContext::backend_index(const std::string& backend) const {
  return static_cast<std::size_t>(std::find(backends.begin(), backends.end(), backend) - backends.begin());
}

std::size_t PageContext::method_index(std::size_t method) const {
  constexpr std::size_t round = std::lcm(page_hues, marker_shapes);
  return (backends.size() + round - 1) / round * round + first_method + method;
}

std::string section_start(const PageContext& context, std::string_view id, std::string_view title) {
  const std::string of = context.machine.empty() ? "" : fmt::format(" <small>{}</small>", escape_html(context.machine));
  return fmt::format(R"(<section id="{}{}"><h2>{}{}</h2>)", id, context.suffix, title, of);
}

std::string row_link(const ResultRow& row, std::string_view text, std::string_view title) {
  return fmt::format(R"(<a href="#r{}" title="{}">{}</a>)", row.index, escape_html(title), escape_html(text));
}

std::string problem_title(const ResultRow& row) {
  const std::string variant = row.variant();
  return variant.empty() ? row.scene : row.scene + " " + variant;
}

std::string row_hover(const PageContext& context, const ResultRow& row) {
  std::string out = fmt::format("{} on {}, {}", problem_title(row), row.backend, verdict_title(row.verdict()));
  if (const std::string configuration = context.study.configuration(row); !configuration.empty())
    out += fmt::format("\n{}", configuration);
  if (row.median_ms) {
    out += fmt::format("\n{} ms per step", short_number(*row.median_ms));
    if (row.min_ms && row.max_ms)
      out += fmt::format(" ({} to {})", short_number(*row.min_ms), short_number(*row.max_ms));
  }
  if (!row.reason.empty()) out += fmt::format("\n{}", row.reason);
  for (const MetricResult& metric : row.metrics) out += fmt::format("\n{}", metric_line(metric));
  return out;
}

std::string problem_header(const PageContext& context, const Problem& problem) {
  const auto text = context.options.scenes.find(problem.scene);
  std::string out = R"(<th scope="row" class="problem">)";
  out += fmt::format("<b>{}</b>", escape_html(problem.scene));
  if (!problem.variant.empty()) out += fmt::format(R"( <span class="variant">{}</span>)", escape_html(problem.variant));
  if (text == context.options.scenes.end()) {
    const std::string& slug = problem.rows.front()->slug;
    if (!slug.empty()) out += fmt::format(R"( <span class="scene-title">{}</span>)", escape_html(slug));
  } else {
    out += fmt::format(R"( <span class="scene-title" title="{}">{}</span>)", escape_html(text->second.doc),
                       escape_html(text->second.title));
  }
  return out + "</th>";
}

std::string filter_key(const PageContext& context, const Problem& problem, std::string_view more) {
  const auto text = context.options.scenes.find(problem.scene);
  const std::string key = fmt::format("{} {} {} {} {}", problem.scene, problem.variant, problem.group,
                                      text == context.options.scenes.end() ? std::string() : text->second.title, more);
  return fmt::format(R"(data-k="{}")", escape_html(lower(key)));
}

std::string figure_foot(const PageContext& context, const std::vector<const ResultRow*>& rows,
                        std::string_view filter) {
  if (rows.empty()) return "";
  return fmt::format(R"(<details class="how"><summary><a href="#runs{}" data-show="{}">{} {}</a>, command</summary>)"
                     R"(<code>{}</code></details>)",
                     context.suffix, escape_html(lower(std::string(filter))), rows.size(),
                     rows.size() == 1 ? "run" : "runs", escape_html(context.study.commands(rows)));
}

std::string backend_label(const PageContext& context, const std::string& backend) {
  return fmt::format(R"(<span class="backend">{}{}</span>)", render_marker(context.backend_index(backend), true),
                     escape_html(backend));
}

std::string group_title(const std::string& group) {
  std::string out = group.empty() ? "other" : group;
  if (out.front() >= 'a' && out.front() <= 'z') out.front() = static_cast<char>(out.front() - 'a' + 'A');
  return out;
}

std::string verdict_title(Verdict verdict) {
  std::string word(verdict_word(verdict));
  std::replace(word.begin(), word.end(), '_', ' ');
  return word;
}

}  // namespace plumb::harness
