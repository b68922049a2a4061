// The scorecard: engines by group of scenes, relative to the best, and the scenes where each is best and breaks.
#include "report/findings/scorecard.hpp"

#include <fmt/format.h>

#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"
#include "report/text/scorecard_text.hpp"

namespace plumb::harness {
namespace {

/// The best has its ground, unless it stands for few of what others reach.
Json relative_cell(const RelativeScore& score) {
  const bool best = score.factor && *score.factor < 1.005 && 2 * score.reached >= score.tests;
  return cell(escape_html(score_text(score)), score.factor, best ? "best" : "");
}

Json passed_cell(const GroupScore& score) {
  if (score.scored == 0) return cell(passed_text(score), {}, "quiet");
  return cell(passed_text(score), static_cast<double>(score.passed) / score.scored,
              score.passed == score.scored ? "best" : "");
}

/// A line an engine; group: none: of all together.
void add_group(const PageContext& context, Table& table, const std::vector<EngineScore>& scores,
               const std::optional<Comparison>& comparison, const std::optional<std::size_t>& group) {
  const std::string* name = group ? &context.ordered.groups[*group] : nullptr;
  for (const EngineScore& engine : scores) {
    const GroupScore& score = group ? engine.groups[*group] : engine.all;
    Json cells = Json::array({name ? fmt::format("<b>{}</b>", escape_html(group_title(*name))) : "<b>All</b>",
                              backend_label(context, engine.backend), passed_cell(score), relative_cell(score.error),
                              relative_cell(score.cost)});
    if (comparison) cells.push_back(escape_html(change_text(score_change(*comparison, engine.backend, name))));
    table.row(std::move(cells), lower(fmt::format("{} {}", name ? *name : "all", engine.backend)),
              context.backend_index(engine.backend));
  }
}

std::string scene_list(const char* title, const char* style, const std::vector<Statement>& list) {
  std::string items;
  for (const Statement& statement : list) items += fmt::format("<li>{}</li>", statement_text(statement));
  return items.empty() ? "" : fmt::format(R"(<h4>{}</h4><ul class="{}">{}</ul>)", title, style, items);
}

std::string score_cards(const PageContext& context, const std::vector<EngineScore>& scores) {
  std::string cards;
  for (const EngineScore& engine : scores) {
    cards +=
        fmt::format(R"(<article class="card of{0} e{0}"><h3>{1}</h3>{2}{3}</article>)",
                    context.backend_index(engine.backend), backend_label(context, engine.backend),
                    scene_list("Best in", "best-at", engine.best), scene_list("Breaks in", "breaks-at", engine.breaks));
  }
  return fmt::format(R"(<div class="cards">{}</div>)", cards);
}

}  // namespace

PageSection scorecard_section(const PageContext& context) {
  PageSection section{"scorecard", "Scorecard", ""};
  if (context.ordered.backends.size() < 2) return section;
  std::optional<Comparison> comparison;
  if (const auto& against = context.options.against)
    comparison = compare_results(against->rows, context.ordered.rows, against->limits);
  const std::vector<EngineScore> scores = scorecard(context.ordered, context.costs, context.overviews);
  section.words = about(escape_html(about_scorecard())) + score_cards(context, scores);
  Table table("the scorecard");
  table.column({"group", 7, Column::Kind::name, {}, true});
  table.column({"engine", 7, Column::Kind::name});
  table.column({"passes", 6});
  table.column({"error, &times; best", 9});
  table.column({"cost of 1 %, &times; cheapest", 9});
  if (comparison) table.column({"since the baseline", 7, Column::Kind::text, {}, false, "cells better and worse"});
  for (std::size_t group = 0; group < context.ordered.groups.size(); ++group)
    add_group(context, table, scores, comparison, group);
  if (context.ordered.groups.size() > 1) add_group(context, table, scores, comparison, std::nullopt);
  section.blocks.push_back(table.block());
  return section;
}

}  // namespace plumb::harness
