#include "report/page/duel_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "base/format.hpp"
#include "report/page/parts/assets.hpp"
#include "report/page/parts/bundled_scripts.hpp"
#include "report/page/parts/looks.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"
#include "report/text/duel_text.hpp"
#include "report/text/row_text.hpp"

namespace plumb::harness {
namespace {

std::string engine_label(const Duel& duel, std::size_t side) {
  return fmt::format(R"(<span class="backend e{}">{}</span>)", side, escape_html(duel.names[side]));
}

std::string chip(const Row& row) {
  return fmt::format(R"(<span class="chip {}">{}</span>)", verdict_word(row.verdict()), verdict_title(row.verdict()));
}

std::string duel_scene_label(const DuelPageOptions& options, const DuelPair& pair) {
  const auto text = options.page.scenes.find(pair.rows[0]->scene);
  const std::string title = text == options.page.scenes.end() ? pair.rows[0]->slug : text->second.title;
  return fmt::format(R"(<b>{}</b> <span class="variant">{}</span> <span class="scene-title">{}</span>)",
                     escape_html(pair.rows[0]->scene), escape_html(pair.rows[0]->variant()), escape_html(title));
}

/// A card's place on the page.
std::string anchor(std::size_t rank) { return fmt::format("scene{}", rank + 1); }

std::string number_or(const std::optional<double>& number, std::string_view otherwise) {
  return number ? short_number(*number) : std::string(otherwise);
}

// ---- the table of all ----

std::string side_cells(const Row& row, const std::string& name) {
  const MetricResult* metric = row.completed() && !name.empty() ? row.metric(name) : nullptr;
  return fmt::format(R"(<td>{}</td><td class="number">{}</td><td class="number quiet">{}</td>)", chip(row),
                     metric ? number_or(metric->error, "not finite") : std::string(no_value), ms_text(row));
}

std::string ranked_row(const Duel& duel, const DuelPageOptions& options, std::size_t rank) {
  const DuelFinding& best = duel.apart[rank].best;
  return fmt::format(
      R"(<tr><td class="number quiet">{}</td><td><a href="#{}">{}</a></td><td>{}</td>{}{}<td>{} {}</td></tr>)",
      rank + 1, anchor(rank), duel_scene_label(options, best.pair), escape_html(best.metric),
      side_cells(*best.pair.rows[0], best.metric), side_cells(*best.pair.rows[1], best.metric),
      engine_label(duel, best.ahead), escape_html(advantage_text(best)));
}

std::string ranked_table(const Duel& duel, const DuelPageOptions& options) {
  if (duel.apart.empty()) return "";
  std::string rows;
  for (std::size_t rank = 0; rank < duel.apart.size(); ++rank) rows += ranked_row(duel, options, rank);
  return fmt::format(
      R"(<section id="ranked"><h2>What tells them apart</h2>{})"
      R"(<div class="duel-table"><table><thead><tr><th></th><th>scene</th><th>metric</th>)"
      R"(<th>{}</th><th class="number">error</th><th class="number">ms/step</th>)"
      R"(<th>{}</th><th class="number">error</th><th class="number">ms/step</th>)"
      R"(<th>ahead</th></tr></thead><tbody>{}</tbody></table></div></section>)",
      about("First the scenes that one passes and the other does not, then other verdicts, then errors, "
            "the largest factor first; of a scene the variant that tells most. Error and time are of "
            "the same run. Errors below a thousandth of their limit count as equally good. Times in brackets: the "
            "machine had other work, and they count nowhere."),
      engine_label(duel, 0), engine_label(duel, 1), rows);
}

// ---- a card a scene ----

std::string metric_row(const DuelMetric& metric, const std::string& telling) {
  std::string cells;
  for (const MetricResult* of : metric.of) {
    const std::string text = of ? number_or(of->error, "not finite") : std::string(no_value);
    const char* style = of && of->pass == false ? "number missed" : "number";
    cells += fmt::format(R"(<td class="{}">{}</td>)", style, text);
  }
  const MetricResult& any = metric.of[0] ? *metric.of[0] : *metric.of[1];
  const std::string limit = any.threshold ? limit_text(*any.threshold) : std::string(no_value),
                    gold = any.gold ? limit_text(*any.gold) : std::string(no_value);
  const std::string factor = std::isfinite(metric.factor) && metric.factor > 1 ? ratio_text(metric.factor) : "";
  return fmt::format(R"(<tr{}><td>{} <small>{}</small></td>{}<td class="number quiet">{}</td>)"
                     R"(<td class="number quiet">{}</td><td class="number">{}</td></tr>)",
                     metric.name == telling ? R"( class="telling")" : "", escape_html(metric.name),
                     escape_html(metric.unit), cells, limit, gold, factor);
}

std::string time_row(const DuelPair& pair) {
  const std::optional<double> factor = time_factor_of(pair);
  return fmt::format(
      R"(<tr><td>time of a step <small>ms</small></td><td class="number">{}</td><td class="number">{}</td>)"
      R"(<td></td><td></td><td class="number">{}</td></tr>)",
      ms_text(*pair.rows[0]), ms_text(*pair.rows[1]), factor ? ratio_text(std::max(*factor, 1 / *factor)) : "");
}

std::string metric_table(const Duel& duel, const DuelFinding& finding) {
  std::string rows;
  for (const DuelMetric& metric : duel_metrics(finding.pair)) rows += metric_row(metric, finding.metric);
  return fmt::format(R"(<table class="duel-metrics"><thead><tr><th>error of</th><th class="number">{}</th>)"
                     R"(<th class="number">{}</th><th class="number">threshold</th><th class="number">gold</th>)"
                     R"(<th class="number">factor</th></tr></thead><tbody>{}{}</tbody></table>)",
                     engine_label(duel, 0), engine_label(duel, 1), rows, time_row(finding.pair));
}

/// Why a side did not come through.
std::string reasons(const Duel& duel, const DuelPair& pair) {
  std::string out;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!pair.rows[side]->completed() && !pair.rows[side]->reason.empty())
      out += fmt::format("<p class=\"why\">{}: {}</p>", engine_label(duel, side), escape_html(pair.rows[side]->reason));
  }
  return out;
}

std::string other_variants(const Duel& duel, const DuelScene& scene) {
  if (scene.others.empty()) return "";
  std::string items;
  for (const DuelFinding& other : scene.others) {
    items += fmt::format("<li>{}: {} {}</li>", escape_html(other.pair.title()), engine_label(duel, other.ahead),
                         escape_html(advantage_text(other)));
  }
  return fmt::format(
      R"(<details class="how"><summary>{} more {} it that tell them apart</summary><ul>{}</ul></details>)",
      scene.others.size(), scene.others.size() == 1 ? "variant of" : "variants of", items);
}

bool has_replay(const DuelPageOptions& options, const std::string& title) {
  return std::any_of(options.page.replays.begin(), options.page.replays.end(),
                     [&](const PageReplay& replay) { return replay.scene == title; });
}

std::string replay_place(const DuelPageOptions& options, const DuelPair& pair) {
  const std::string title = pair.title();
  const auto moment = options.moments.find(title);
  std::string text = moment == options.moments.end() ? "" : about(escape_html(moment->second.text));
  if (!has_viewer() || !has_replay(options, title)) return text;
  const std::string at =
      moment == options.moments.end() ? "" : fmt::format(R"( data-at="{}")", shortest_number(moment->second.seconds));
  return text + fmt::format(R"(<div data-plumb-replay="{}"{}></div>)", escape_html(title), at);
}

std::string scene_card(const Duel& duel, const DuelPageOptions& options, std::size_t rank) {
  const DuelScene& scene = duel.apart[rank];
  const DuelFinding& best = scene.best;
  return fmt::format(R"(<article class="card duel e{}" id="{}"><h3>{}. {}</h3><p>{} {}, {} {}: {}. )"
                     R"(<b>{}</b> is ahead.</p>{}{}{}{}</article>)",
                     best.ahead, anchor(rank), rank + 1, duel_scene_label(options, best.pair), engine_label(duel, 0),
                     chip(*best.pair.rows[0]), engine_label(duel, 1), chip(*best.pair.rows[1]), apart_text(best.apart),
                     escape_html(duel.names[best.ahead]), reasons(duel, best.pair), replay_place(options, best.pair),
                     metric_table(duel, best), other_variants(duel, scene));
}

std::string scene_cards(const Duel& duel, const DuelPageOptions& options) {
  std::string cards;
  for (std::size_t rank = 0; rank < duel.apart.size(); ++rank) cards += scene_card(duel, options, rank);
  return cards.empty() ? "" : fmt::format(R"(<section id="scenes"><h2>Scene by scene</h2>{}</section>)", cards);
}

// ---- what does not tell ----

std::string fold(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string items;
  for (const std::string& line : lines) items += fmt::format("<li>{}</li>", escape_html(line));
  return fmt::format(R"(<details class="how"><summary>{}</summary><ul>{}</ul></details>)", escape_html(title), items);
}

std::string the_rest(const Duel& duel) {
  std::vector<std::string> alike, alone;
  for (const DuelPair& pair : duel.alike) {
    alike.push_back(
        fmt::format("{}: {} and {}", pair.title(), side_text(*pair.rows[0], ""), side_text(*pair.rows[1], "")));
  }
  for (const Row* row : duel.without_match) alone.push_back(fmt::format("{}, {}", problem_title(*row), row->backend));
  const std::string text = fold(fmt::format("{} alike", alike.size()), alike) +
                           fold(fmt::format("{} that not both can run", duel.one_only.size() + duel.neither.size()),
                                describe_silence(duel)) +
                           fold(fmt::format("{} without a match", alone.size()), alone);
  return text.empty() ? "" : fmt::format(R"(<section id="rest"><h2>The others</h2>{}</section>)", text);
}

std::string duel_head(const Duel& duel, const DuelPageOptions& options) {
  std::string sentences;
  for (const std::string& sentence : describe_duel(duel)) sentences += about(escape_html(sentence));
  std::string facts;
  const auto fact = [&](const char* name, const std::string& value) {
    if (!value.empty()) facts += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, escape_html(value));
  };
  fact("written", options.page.written);
  fact("results", options.page.source);
  fact("command", options.command);
  return fmt::format(R"(<header class="head"><p class="kicker">Plumb duel</p><h1>{} against {}</h1>{})"
                     R"(<details class="how"><summary>results and command</summary><dl class="facts">{}</dl></details>)"
                     "</header>",
                     engine_label(duel, 0), engine_label(duel, 1), sentences, facts);
}

std::string duel_style(const Duel& duel) {
  std::string out;
  const std::array<std::size_t, 2> colours = duel_colours(duel.names);
  for (std::size_t side = 0; side < 2; ++side)
    out += fmt::format(".e{0}{{--c:var(--hue{1});--m:var(--mark{0})}}", side, colours[side]);
  return out;
}

}  // namespace

std::array<std::size_t, 2> duel_colours(const std::array<std::string, 2>& names) {
  const std::size_t first = look_of(names[0]).colour(), second = look_of(names[1]).colour();
  return {first, first == second ? (first + 1) % page_hues : second};
}

void write_duel_page(std::ostream& out, const Duel& duel, const DuelPageOptions& options) {
  out << "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width,initial-scale=1\">"
      // Nothing is asked of a network, and the browser sees to it.
      << "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
         "style-src 'unsafe-inline'; img-src data: blob:\"><meta name=\"color-scheme\" content=\"light dark\"><title>"
      << escape_html(fmt::format("{} against {}", duel.names[0], duel.names[1])) << "</title><style>" << page_style
      << duel_style(duel) << "</style><script>" << page_theme_script << "</script></head><body>\n<main>"
      << duel_head(duel, options) << ranked_table(duel, options) << scene_cards(duel, options) << the_rest(duel)
      << replays_place(options.page) << "</main></body></html>\n";
}

}  // namespace plumb::harness
