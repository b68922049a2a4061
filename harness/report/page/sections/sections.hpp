// The sections of the page, in its order, and what they share.
#pragma once

#include <string>
#include <vector>

#include "report/findings/curves.hpp"
#include "report/findings/facts.hpp"
#include "report/findings/front.hpp"
#include "report/findings/overview.hpp"
#include "report/ordered/cost.hpp"
#include "report/ordered/ordered_rows.hpp"
#include "report/ordered/sample.hpp"
#include "report/page/parts/blocks.hpp"
#include "report/page/parts/page_options.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

/// A section: what is said in words, which can be read without the script, and what the script draws from data.
struct PageSection {
  std::string id, title;  ///< the title is HTML
  std::string words;      ///< HTML
  Json blocks = Json::array();

  [[nodiscard]] bool empty() const { return words.empty() && blocks.empty(); }
};

/// What all sections draw on; lives as long as a page is written.
struct PageContext {
  const OrderedRows& ordered;
  const std::vector<CostLine>& costs;
  const std::vector<BackendOverview>& overviews;
  const CurveSet& curves;
  const std::vector<Front>& fronts;
  const PageOptions& options;
  const std::vector<std::string>& backends;  ///< of all machines: those of `ordered` among them
  std::string machine = {};  ///< its name, where the page has several: no figure shows runs of two of them
  std::string suffix = {};   ///< of the sections' ids; "" for the first machine

  [[nodiscard]] std::size_t backend_index(const std::string& backend) const;
};

[[nodiscard]] std::string head_section(const PageContext& context);
/// What people ask first, a picture of speed against error, and a place for a replay. "" where nothing can be answered
/// or drawn.
[[nodiscard]] std::string first_screen(const PageContext& context);
/// A card an engine: verdicts, where it is best, where it breaks.
[[nodiscard]] PageSection engines_section(const PageContext& context);
/// Every engine's defaults in one picture: time over that of the fastest engine that passes, error over the scene's
/// threshold. null where no engine has both.
[[nodiscard]] Json speed_figure(const PageContext& context);
/// Sections are empty where there is nothing to show.
[[nodiscard]] PageSection against_section(const PageContext& context);
/// Engines by group of scenes relative to the best, with what changed since the baseline where there is one.
[[nodiscard]] PageSection scorecard_section(const PageContext& context);
[[nodiscard]] PageSection costs_section(const PageContext& context);
/// Which configurations no other one beats, and which are beaten by whom.
[[nodiscard]] PageSection fronts_section(const PageContext& context);
/// Dolan-More profiles.
[[nodiscard]] PageSection profiles_section(const PageContext& context);
[[nodiscard]] PageSection matrix_section(const PageContext& context);
[[nodiscard]] PageSection precision_section(const PageContext& context);
[[nodiscard]] PageSection curves_section(const PageContext& context);
[[nodiscard]] PageSection scaling_section(const PageContext& context);
[[nodiscard]] PageSection times_section(const PageContext& context);
[[nodiscard]] PageSection robustness_section(const PageContext& context);
[[nodiscard]] PageSection distributions_section(const PageContext& context);
[[nodiscard]] PageSection needs_section(const PageContext& context);
[[nodiscard]] PageSection rows_section(const PageContext& context);
/// Times and errors of machines beside each other, for what ran on at least two.
[[nodiscard]] PageSection machines_section(const std::vector<PageContext>& machines);
/// The recorded scenes and the viewer that plays them; "" where nothing was recorded.
[[nodiscard]] std::string replays_place(const PageOptions& options);
/// A page that does nothing but play.
[[nodiscard]] std::string replay_page(const std::vector<PageReplay>& replays);
/// A page that runs scenes itself.
[[nodiscard]] std::string live_page(const PageWorlds& worlds);

/// A figure as a link to the row that it comes from: <a href="#r12">text</a>. The text is escaped here; what a hover
/// says of the row, the script knows.
[[nodiscard]] std::string row_link(const Row& row, std::string_view text);
/// A dagger behind a figure of a run that fails its scene; what it misses is its title. "" for one that passes.
[[nodiscard]] std::string failed_mark(const Row& row);
/// A statement with a link to its run, and what it only counts as a list that opens.
[[nodiscard]] std::string statement_text(const Statement& statement);
/// A sentence for figures that need times: how many runs have none that counts; "" where all have.
[[nodiscard]] std::string untimed_note(const PageContext& context);
/// A problem's scene, variant and title.
[[nodiscard]] std::string problem_label(const PageContext& context, const Problem& problem);
/// What the page's filter finds an element by: lower case.
[[nodiscard]] std::string filter_key(const PageContext& context, const Problem& problem, std::string_view more = "");
/// Below a figure: the runs that it shows, and what makes them again. `filter` finds them among all.
[[nodiscard]] std::string figure_foot(const PageContext& context, const std::vector<const Row*>& rows,
                                      std::string_view filter);
/// The name of a backend with its marker.
[[nodiscard]] std::string backend_label(const PageContext& context, const std::string& backend);
/// A column for each backend of the rows.
void add_backend_columns(const PageContext& context, Table& table, double width);
/// <p class="about">...</p>
[[nodiscard]] std::string about(std::string_view html);
/// A group's name as a heading: "Stacking"; "Other" for none.
[[nodiscard]] std::string group_title(const std::string& group);
[[nodiscard]] std::string verdict_title(Verdict verdict);  ///< "out of memory"
[[nodiscard]] std::string lower(std::string text);         ///< ASCII letters
[[nodiscard]] std::string problem_title(const Row& row);

}  // namespace plumb::harness
