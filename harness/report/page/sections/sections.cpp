#include "report/page/sections/sections.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/format.hpp"
#include "report/page/parts/markup.hpp"

namespace plumb::harness {
namespace {

constexpr std::size_t most_listed = 12;  ///< statements in a fold; a longer list is drawn when somebody opens it

}  // namespace

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::size_t PageContext::backend_index(const std::string& backend) const {
  return static_cast<std::size_t>(std::find(backends.begin(), backends.end(), backend) - backends.begin());
}

std::string about(std::string_view html) { return fmt::format(R"(<p class="about">{}</p>)", html); }

std::string row_link(const Row& row, std::string_view text) {
  return fmt::format(R"(<a href="#r{}">{}</a>)", row.origin.index, escape_html(text));
}

std::string problem_title(const Row& row) {
  const std::string variant = row.variant();
  return variant.empty() ? row.scene : row.scene + " " + variant;
}

std::string failed_mark(const Row& row) {
  return row.passes() ? "" : fmt::format(R"(<sup title="misses {}">&#8224;</sup>)", escape_html(row.missed()));
}

std::string statement_text(const Statement& statement) {
  // What is only counted is what the fold is called: the text does not say it a second time.
  const std::string rest = fmt::format("and {} more", statement.more.size());
  std::string text = statement.text;
  if (!statement.more.empty() && text.ends_with(rest)) text.resize(text.size() - rest.size());
  std::string out = statement.row ? row_link(*statement.row, text) : escape_html(text);
  if (statement.more.empty()) return out;
  std::string items;
  for (const Statement& more : statement.more) items += fmt::format("<li>{}</li>", statement_text(more));
  std::string list = fmt::format("<ul>{}</ul>", items);
  if (statement.more.size() > most_listed) list = fmt::format("<template>{}</template>", list);
  return fmt::format(R"({} <details class="how"><summary>{}</summary>{}</details>)", out, rest, list);
}

std::string untimed_note(const PageContext& context) {
  const auto contended = std::count_if(context.ordered.rows.begin(), context.ordered.rows.end(),
                                       [](const Row& row) { return row.time.contended.has_value(); });
  if (contended == 0) return "";
  return fmt::format(R"( <b>{} of {} runs</b> were measured while the machine had other work: they have no time that )"
                     R"(counts, and are not among these.)",
                     contended, context.ordered.rows.size());
}

std::string problem_label(const PageContext& context, const Problem& problem) {
  const auto text = context.options.scenes.find(problem.scene);
  std::string out = fmt::format("<b>{}</b>", escape_html(problem.scene));
  if (!problem.variant.empty()) out += fmt::format(R"( <span class="variant">{}</span>)", escape_html(problem.variant));
  const std::string title = text == context.options.scenes.end() ? problem.rows.front()->slug : text->second.title;
  return title.empty() ? out : out + fmt::format(R"( <span class="scene-title">{}</span>)", escape_html(title));
}

std::string filter_key(const PageContext& context, const Problem& problem, std::string_view more) {
  const auto text = context.options.scenes.find(problem.scene);
  return lower(fmt::format("{} {} {} {} {}", problem.scene, problem.variant, problem.group,
                           text == context.options.scenes.end() ? std::string() : text->second.title, more));
}

std::string figure_foot(const PageContext& context, const std::vector<const Row*>& rows, std::string_view filter) {
  if (rows.empty()) return "";
  return fmt::format(R"(<details class="how"><summary><a href="#runs{}" data-show="{}">{} {}</a>, command</summary>)"
                     R"(<code>{}</code></details>)",
                     context.suffix, escape_html(lower(std::string(filter))), rows.size(),
                     rows.size() == 1 ? "run" : "runs", escape_html(context.ordered.commands(rows)));
}

std::string backend_label(const PageContext& context, const std::string& backend) {
  return fmt::format(R"(<span class="backend e{}">{}</span>)", context.backend_index(backend), escape_html(backend));
}

void add_backend_columns(const PageContext& context, Table& table, double width) {
  for (const std::string& backend : context.ordered.backends)
    table.column({backend_label(context, backend), width, Column::Kind::number, context.backend_index(backend)});
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
